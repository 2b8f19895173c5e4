#pragma once
// The keys of a study as options of a verb.

#include "options.hpp"

#include <arcslip/scene/study_type.hpp>

#include <string>
#include <vector>

namespace arcslip::app {

/// A key and the raw texts of its option, which has the name of the key.
struct KeyOption {
  scene::Key key;
  std::vector<std::string> texts{};

  std::string name() const { return "--" + key.name; }
  std::string type_name() const;  // "NAME.FIELD"
  std::string help() const;
  /// The value given by the user. Throws UsageError if the texts are not a valid value.
  GivenKey given() const;
};

/// The keys that have an option: all except lists and objects.
std::vector<KeyOption> options_of(const std::vector<scene::Key>& keys);

}  // namespace arcslip::app
