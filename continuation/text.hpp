#pragma once
// Formatting of numbers in messages.

#include <sstream>
#include <string>

namespace arcslip::continuation {

inline std::string text(double x) {
  std::ostringstream s;
  s.precision(10);
  s << x;
  return s.str();
}

/// ": why", or nothing.
inline std::string because(const std::string& why) {
  return why.empty() ? why : ": " + why;
}

}  // namespace arcslip::continuation
