#pragma once
// How many random optima the tests look at, and their seeds, from ARCSLIP_FIRST_OPTIMUM or 0 on: with a
// number of 1 a single one. Also in docs/robustness.md.

#include "volume.hpp"

namespace random_optima {

inline constexpr Volume with_ranges{"ARCSLIP_OPTIMA", 6, 500};
inline constexpr Volume with_other_windows{"ARCSLIP_OTHER_WINDOWS", 8, 300};

inline std::uint64_t first() {
  return Volume{"ARCSLIP_FIRST_OPTIMUM", 0, 0}.count();
}

}  // namespace random_optima
