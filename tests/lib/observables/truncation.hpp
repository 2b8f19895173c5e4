#pragma once

#include "volume.hpp"

namespace truncation {

/// Random structures with each of `law_count` laws of force.
inline constexpr Volume each_law{"ARCSLIP_ESTIMATES", 2, 30};
inline constexpr std::uint64_t law_count = 15;

}  // namespace truncation
