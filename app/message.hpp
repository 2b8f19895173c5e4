#pragma once

#include <string_view>

namespace arcslip::app {

/// A line on standard error, with "arcslip: " before it. What cannot be written there is lost.
void tell(std::string_view message) noexcept;

/// Text on standard error as it is.
void tell_plainly(std::string_view text) noexcept;

}  // namespace arcslip::app
