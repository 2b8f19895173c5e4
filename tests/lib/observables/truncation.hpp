#pragma once

#include "volume.hpp"

namespace truncation {

/// Random structures with a Bouc-Wen element.
inline constexpr Volume bouc_wen{"ARCSLIP_BOUC_WEN", 10, 300};

}  // namespace truncation
