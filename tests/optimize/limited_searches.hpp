#pragma once
// How many random searches with limits the tests run.

#include "volume.hpp"

namespace limited_searches {

inline constexpr Volume number{"ARCSLIP_SEARCHES", 12, 1000};

}  // namespace limited_searches
