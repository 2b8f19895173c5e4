#pragma once
// The keys of a study as options of a verb.

#include "options.hpp"

#include <arcslip/scene/study_type.hpp>

#include <string>
#include <vector>

namespace arcslip::app {

/// "--most-branches", of the key "most_branches".
std::string option_of(const std::string& key);

/// A key and the raw texts of its option, which has the name of the key.
struct KeyOption {
  scene::Key key;
  std::vector<std::string> texts{};

  std::string name() const { return option_of(key.name); }
  std::string names() const;      // with underscores as well
  bool is_flag() const;           // true or false, and further words as --stability=hill
  std::string type_name() const;  // "NAME.FIELD"
  std::string help() const;
  /// The value given by the user. Throws UsageError if the texts are not a valid value.
  GivenKey given() const;
};

/// An option for each key, but for those that another one gives with its own (scene::keys_next_to()), and
/// for "for_each".
std::vector<KeyOption> options_of(const std::vector<scene::Key>& keys);

}  // namespace arcslip::app
