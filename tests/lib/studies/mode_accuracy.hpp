#pragma once

#include "volume.hpp"

namespace mode_accuracy {

/// Random conservative oscillators over four decades of amplitude.
inline constexpr Volume conservative{"ARCSLIP_CONSERVATIVE_MODES", 5, 50};
/// With friction and damping.
inline constexpr Volume damped{"ARCSLIP_DAMPED_MODES", 8, 300};
/// The same with a second mass.
inline constexpr Volume two_masses{"ARCSLIP_TWO_MASS_MODES", 4, 100};

}  // namespace mode_accuracy
