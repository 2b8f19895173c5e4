#pragma once
// A key of a scene file: of a study, or an option of a part.

#include <limits>
#include <string>
#include <vector>

namespace arcslip::scene {

/// The type of a key's value.
enum class KeyType {
  number,
  whole,
  text,
  word,        // one of a few
  frequency,   // in the scene's unit
  window,      // [lower, upper] of frequencies
  parameter,   // the name of one
  value,       // of the parameter named by the key "over"
  parameters,  // a list of names
  followed,    // the name of a continuation parameter with a range
  other        // lists, objects, true or false
};

/// The further keys that a key of this type requires: "bounds", pairs [lower, upper] of parameters; "from"
/// and "to" of a continuation parameter.
std::vector<std::string> keys_next_to(KeyType type);

/// One key, for scene files, command line options, the documentation and the JSON Schema.
struct Key {
  std::string name;
  KeyType type = KeyType::other;
  std::string unit;     // "s", "-"; "frequency", "parameter": that of the scene's frequencies, of a parameter
  std::string allowed;  // "an integer from 1 to 10000000"
  std::string otherwise;  // the default, as JSON; "": the key is required, or has no default
  bool required = false;
  std::string help;
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;           // of numbers: the lower bound itself is not allowed
  std::vector<std::string> words{};  // of KeyType::word
  std::string schema{};              // of KeyType::other: the JSON Schema of its value
};

}  // namespace arcslip::scene
