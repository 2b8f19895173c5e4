#pragma once
// How many random structures are put through all invariances. Also in docs/robustness.md.

#include "volume.hpp"

namespace structures {

inline constexpr Volume number{"ARCSLIP_STRUCTURES", 12, 2000};
/// One of so many is also integrated in time.
inline constexpr std::uint64_t beside_time = 4;

}  // namespace structures
