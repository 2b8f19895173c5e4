#pragma once

#include "volume.hpp"

namespace responses_at {

/// Frequencies next to folds of random Duffing oscillators.
inline constexpr Volume near_folds{"ARCSLIP_NEAR_FOLDS", 40, 1000};

/// Windows that begin or end within the hysteresis of one.
inline constexpr Volume within_hystereses{"ARCSLIP_WITHIN_HYSTERESES", 20, 1000};

}  // namespace responses_at
