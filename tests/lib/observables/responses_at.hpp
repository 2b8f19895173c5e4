#pragma once

#include "volume.hpp"

namespace responses_at {

/// Frequencies beside folds of random Duffing oscillators.
inline constexpr Volume beside_folds{"ARCSLIP_BESIDE_FOLDS", 40, 1000};

}  // namespace responses_at
