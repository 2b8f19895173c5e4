#pragma once

#include <string_view>

namespace arcslip::app {

/// Lines on standard error, with what a terminal must not get escaped (results/text.hpp). What cannot be
/// written there is lost.
void tell_line(std::string_view text);

/// The same with "arcslip: " before it.
void tell(std::string_view message);

/// Text of the program's own as it is, without a line break.
void put(std::string_view text);

}  // namespace arcslip::app
