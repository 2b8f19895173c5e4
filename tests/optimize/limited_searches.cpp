// Random searches with limits beside other algorithms and designs over all the bounds.

#include "catch.hpp"

#include "optimize/limited_searches.hpp"
#include "optimize/random_limits.hpp"

using namespace arcslip;

TEST_CASE("random searches with limits: none is complete where another way comes to a lower design") {
  const std::uint64_t searches = limited_searches::number.count();
  std::uint64_t complete = 0;
  for (std::uint64_t seed = 0; seed < searches; ++seed) {
    const auto search = random_limits::make(seed);
    const auto found = optimize::optimum(search.scene, search.problem, {.certificate = false});
    if (found.feasible) {
      CAPTURE(seed, found.design, found.stop.message);
      CHECK(random_limits::excess(search, found.design) <= 1e-6);
    }
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

TEST_CASE("where the best design is beside others with one more peak, beyond a limit, the end says so") {
  const auto search = random_limits::make(16);
  const auto found =
      optimize::optimum(search.scene, search.problem, {.certificate = false, .elsewhere = false});
  CAPTURE(found.stop.message);
  REQUIRE(found.feasible);
  CHECK(random_limits::excess(search, found.design) <= 1e-6);
  CHECK(found.stop.reason == "not_stationary");
  const std::string beyond = "a peak comes up at which a limit is exceeded by 0.00380";
  CHECK(found.stop.message.find(beyond) != std::string::npos);
}
