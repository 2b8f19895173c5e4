#pragma once

#include "volume.hpp"

namespace tolerance_ranges {

/// Random linear absorbers, optimized over one parameter or two.
inline constexpr Volume absorbers{"ARCSLIP_ABSORBERS", 12, 500};

}  // namespace tolerance_ranges
