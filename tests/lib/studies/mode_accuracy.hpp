#pragma once

#include "volume.hpp"

namespace mode_accuracy {

/// Random conservative oscillators over four decades of amplitude.
inline constexpr Volume conservative{"ARCSLIP_CONSERVATIVE_MODES", 5, 50};

}  // namespace mode_accuracy
