#pragma once
// The keys of a study as options of a verb.

#include "options.hpp"

#include <arcslip/scene/study_type.hpp>

#include <string>
#include <vector>

namespace arcslip::app {

/// A key and what stands behind its option, which has the name of the key, as texts until all is read.
struct KeyOption {
  scene::Key key;
  std::vector<std::string> texts{};

  std::string name() const { return "--" + key.name; }
  std::string type_name() const;  // "NAME.FIELD"
  std::string help() const;
  /// What the user gave. Throws UsageError for texts that are no such value.
  GivenKey given() const;
};

/// Those of the keys that have an option: all but lists and objects.
std::vector<KeyOption> options_of(const std::vector<scene::Key>& keys);

}  // namespace arcslip::app
