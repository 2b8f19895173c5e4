#pragma once
// Reading of single values and of the keys of an object, with a fault for everything invalid.

#include <arcslip/formula/formula.hpp>
#include <arcslip/scene/faults.hpp>
#include <arcslip/scene/keys/enum_words.hpp>
#include <arcslip/scene/keys/json_tree.hpp>
#include <arcslip/scene/scene.hpp>

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace arcslip::scene::file {

/// A value and its JSON pointer; `node` is null if the value is missing.
struct Location {
  const Node* node = nullptr;
  std::string pointer;
};

/// Explains a key that is not allowed: "which belongs to studies of kind "frf"", or "".
using Elsewhere = std::function<std::string(std::string_view)>;

/// An object whose keys are not names may have a comment under this one.
inline constexpr std::string_view comment_key = "comment";

/// The keys of an object. A wrong type, duplicate keys and unknown keys are reported at once; an empty list
/// of allowed keys allows every key. Of duplicates the first counts.
class Keys {
 public:
  Keys(const Location& place, std::vector<std::string> allowed, Faults& faults,
       const Elsewhere& elsewhere = {});
  bool is_object() const { return object_ != nullptr; }
  bool has(std::string_view key) const { return find(key).node != nullptr; }
  const std::string& pointer() const { return pointer_; }
  /// The value of an optional key.
  Location find(std::string_view key) const;
  /// The value of a required key; what: the expected value. A fault if it is absent.
  Location require(std::string_view key, const std::string& what, Faults& faults) const;

 private:
  const Node::Object* object_;
  std::string pointer_;
};

/// What a JSON pointer names within a value; nothing if it is not there.
Location at_pointer(const Location& root, std::string_view pointer);

/// A field that allows every finite number.
inline constexpr Field any_number{.name = "value",
                                  .unit = "-",
                                  .lower = -std::numeric_limits<double>::infinity(),
                                  .upper = std::numeric_limits<double>::infinity()};

inline constexpr Field above_0{.name = "value",
                               .unit = "-",
                               .lower = 0,
                               .upper = std::numeric_limits<double>::infinity(),
                               .lower_open = true};

/// A number as it stands in a file: plain, "0.2 mm" with a unit, or a formula, "2*pi*47".
struct GivenNumber {
  double value = 0;      // in the unit of its field
  std::string text{};    // empty: plain
  bool follows = false;  // it is a formula of parameters, whose value is not known
};
/// A fault and nothing if the number is absent or invalid.
std::optional<GivenNumber> read_given_number(const Location& place, const Field& bounds, Faults& faults);
/// A fault where a text is no unit in which formulas take a value.
void check_coherent_unit(const std::string& unit, const std::string& pointer, Faults& faults);
/// A fault of a formula; names: what it may name.
void add_formula_fault(const formula::FormulaError& error, const std::string& pointer,
                       std::vector<std::string> names, Faults& faults);

/// These report a fault and return nothing if the value is absent or invalid. A number may have a unit, and
/// be a formula without parameters.
std::optional<double> read_number(const Location& place, const Field& bounds, Faults& faults);
/// `why` follows the bounds in a message.
std::optional<int> read_integer(const Location& place, int lower, int upper, Faults& faults,
                                std::string_view why = {});
std::optional<std::string> read_string(const Location& place, std::string_view what, Faults& faults);
const Node::List* read_list(const Location& place, std::string_view what, Faults& faults);
/// A list of so many numbers; what: "a factor for each sector".
std::optional<std::vector<double>> read_factors(const Location& place, int count, const Field& bounds,
                                                const std::string& what, Faults& faults);

/// The members of an object whose keys are names; duplicates are reported. None if there is no object.
std::vector<const Member*> members(const Location& place, Faults& faults);

/// "found 3 (a number), must be a string".
void add_wrong_type(const Location& place, std::string_view must_be, Faults& faults);

/// One of a few words; absent means `otherwise`.
template <class Words, class Choice>
Choice read_choice(const Location& place, const Words& words, Choice otherwise, Faults& faults) {
  const std::vector<std::string> known = texts(words);
  if (const auto text = read_string(place, "one of " + listed(known), faults)) {
    if (const auto value = value_of<Choice>(words, *text)) return *value;
    faults.add(place.pointer,
               "found " + shown(*text) + ", must be one of " + listed(known) + hint(*text, known));
  }
  return otherwise;
}

}  // namespace arcslip::scene::file
