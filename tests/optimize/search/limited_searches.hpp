#pragma once
// How many random searches with limits the tests run. Also in docs/robustness.md.

#include "volume.hpp"

namespace limited_searches {

inline constexpr Volume number{"ARCSLIP_SEARCHES", 6, 1000};

/// Their seeds, from ARCSLIP_FIRST_SEARCH or 0 on: with ARCSLIP_SEARCHES=1 a single one.
struct Seeds {
  std::uint64_t first, end;
};

inline Seeds seeds() {
  const std::uint64_t first = Volume{"ARCSLIP_FIRST_SEARCH", 0, 0}.count();
  return {first, first + number.count()};
}

}  // namespace limited_searches
