#pragma once

#include <string_view>

namespace arcslip::results {

/// The project's version, "0.1.0".
std::string_view version();

}  // namespace arcslip::results
