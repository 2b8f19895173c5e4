#pragma once
// A scalar of a part of the scene.

#include <limits>
#include <optional>
#include <string_view>

namespace arcslip::scene {

inline constexpr double infinity = std::numeric_limits<double>::infinity();  // as a bound: none

/// One scalar of a part. It is a parameter of the scene under the name "part.field".
struct Field {
  std::string_view name;
  std::string_view unit;                  // SI, "-" for a pure number
  double lower, upper;                    // closed bounds
  bool lower_open = false;                // true: the lower bound itself is not allowed
  std::optional<double> default_value{};  // none: the field is required
  std::string_view help{};
  std::string_view place{};  // of the value in the part of a scene file, a JSON pointer; empty: its name
};

}  // namespace arcslip::scene
