// Random searches with limits beside other algorithms and designs over all the bounds.

#include "catch.hpp"

#include "optimize/random_limits.hpp"

#include <cstdlib>

using namespace arcslip;

TEST_CASE("random searches with limits: none is complete where another way comes to a lower design") {
  const int searches = std::getenv("ARCSLIP_FULL") != nullptr ? 1000 : 12;
  int complete = 0;
  for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(searches); ++seed) {
    const auto search = random_limits::make(seed);
    const auto found = optimize::optimum(search.scene, search.problem, {.certificate = false});
    if (found.status != observables::Status::complete) continue;
    ++complete;
    CHECK(found.feasible);
    for (const auto& other :
         {random_limits::other_algorithms(search), random_limits::grid(search, seed, 40)}) {
      CAPTURE(seed, found.amplitude, other.amplitude, other.by, other.design);
      CHECK(found.amplitude <= other.amplitude * (1 + 1e-6));
    }
  }
  CHECK(complete >= searches / 2);
}
