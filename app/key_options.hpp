#pragma once
// The keys of a study as options of a verb.

#include "options.hpp"

#include <arcslip/scene/study_type.hpp>

#include <CLI/CLI.hpp>

#include <string>
#include <utility>
#include <vector>

namespace arcslip::app {

/// Keys and what stands behind their options, as texts until all is read.
using KeyTexts = std::vector<std::pair<scene::Key, std::vector<std::string>>>;

/// Those of the keys that have an option: all but lists and objects. It has the name of the key.
KeyTexts with_options(const std::vector<scene::Key>& keys);

/// Adds an option for each. Refers to the texts, which must stay where they are.
void add_key_options(KeyTexts& keys, CLI::App& verb);

/// Those that the user gave. Throws UsageError for texts that are no such value.
std::vector<GivenKey> given_keys(const KeyTexts& keys, const CLI::App& verb);

}  // namespace arcslip::app
