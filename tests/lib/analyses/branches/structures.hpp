#pragma once
// How many random structures are put through all invariances. Also in docs/robustness.md.

#include "volume.hpp"

namespace structures {

inline constexpr Volume number{"ARCSLIP_STRUCTURES", 12, 2000};

/// Their seeds, from ARCSLIP_FIRST_STRUCTURE or 0 on: with ARCSLIP_STRUCTURES=1 a single one.
struct Seeds {
  std::uint64_t first, end;
};

inline Seeds seeds() {
  const std::uint64_t first = Volume{"ARCSLIP_FIRST_STRUCTURE", 0, 0}.count();
  return {first, first + number.count()};
}

/// One of so many is also integrated in time.
inline constexpr std::uint64_t near_time = 4;

}  // namespace structures
