#pragma once
// A key of a scene file: of a study, or an option of a part.

#include <limits>
#include <string>
#include <vector>

namespace arcslip::scene {

/// What the value of a key is.
enum class KeyType {
  number,
  whole,
  text,
  word,        // one of a few
  frequency,   // in the scene's unit
  window,      // [lower, upper] of frequencies
  parameter,   // the name of one
  value,       // of the parameter that the key "over" names
  parameters,  // a list of names
  followed,    // the name of a parameter over a range
  other        // lists and objects
};

/// The keys beside one of this type without which it says nothing: "bounds", pairs [lower, upper] of
/// parameters; "from" and "to" of one that is followed.
std::vector<std::string> keys_beside(KeyType type);

/// One key, as a scene file, an option of a command, a page of documentation and a JSON Schema have it.
struct Key {
  std::string name;
  KeyType type = KeyType::other;
  std::string unit;     // "s", "-"; "frequency", "parameter": that of the scene's frequencies, of a parameter
  std::string allowed;  // "an integer from 1 to 10000000"
  std::string otherwise;  // the default, as JSON; "": the key is required, or what it says is not there
  bool required = false;
  std::string help;
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;           // of numbers: the lower bound itself is not allowed
  std::vector<std::string> words{};  // of KeyType::word
  std::string schema{};              // of KeyType::other: the JSON Schema of its value
};

}  // namespace arcslip::scene
