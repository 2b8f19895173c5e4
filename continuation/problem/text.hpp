#pragma once
// Formatting of messages. Not installed.

#include <cmath>
#include <sstream>
#include <string>
#include <type_traits>

namespace arcslip::continuation {

template <class Part>
void add_text(std::ostream& out, const Part& part) {
  if constexpr (std::is_floating_point_v<Part>) {
    if (std::isnan(part)) {
      out << "not a number";
      return;
    }
  }
  out << part;
}

/// The concatenated parts, numbers with ten digits.
template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  out.precision(10);
  (add_text(out, parts), ...);
  return out.str();
}

/// ": why", or nothing.
inline std::string because(const std::string& why) {
  return why.empty() ? why : ": " + why;
}

}  // namespace arcslip::continuation
