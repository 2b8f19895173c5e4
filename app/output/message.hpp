#pragma once

#include <string_view>

namespace arcslip::app {

/// Prints lines on standard error, with characters unsafe for a terminal escaped (results/text.hpp). Write
/// errors are ignored.
void tell_line(std::string_view text);

/// The same with the prefix "arcslip: ".
void tell(std::string_view message);

/// Prints trusted text unchanged, without a line break.
void put(std::string_view text);

}  // namespace arcslip::app
