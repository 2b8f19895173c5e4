#pragma once
// Text for messages. Not installed.

#include <sstream>
#include <string>

namespace arcslip::optimize {

/// The parts one after the other, numbers with ten digits.
template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  out.precision(10);
  (out << ... << parts);
  return out.str();
}

}  // namespace arcslip::optimize
