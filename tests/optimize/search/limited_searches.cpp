// Random searches with limits next to other algorithms and designs over all the bounds.

#include "catch.hpp"

#include "optimize/search/limited_searches.hpp"
#include "optimize/search/random_limits.hpp"

#include <arcslip/optimize/evaluation/reasons.hpp>

#include <chrono>
#include <iostream>

using namespace arcslip;

namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

optimize::Optimum search_from(random_limits::Search& search, const std::vector<double>& design) {
  for (std::size_t k = 0; k < design.size(); ++k)
    scene::set(search.scene, search.problem.over[k].name, design[k]);
  return optimize::optimum(search.scene, search.problem, {.certificate = false, .starts = 1});
}

}  // namespace

// A line for each, so that a long run that is cut short is not lost.
TEST_CASE("random searches with limits: none is complete where another way comes to a lower design") {
  const auto [first, end] = limited_searches::seeds();
  std::uint64_t searched = 0, complete = 0;
  for (std::uint64_t seed = first; seed < end; ++seed) {
    const auto search = random_limits::make(seed);
    if (search.problem.limits.empty() && search.problem.linear_limits.empty()) continue;
    ++searched;
    const auto found = optimize::optimum(search.scene, search.problem, {.certificate = false});
    const auto begin = std::chrono::steady_clock::now();
    const double excess = found.feasible ? random_limits::excess(search, found.design) : HUGE_VAL;
    random_limits::Lowest other = random_limits::from_grid(search, seed, 40);
    std::cout << "seed " << seed << ", " << search.problem.over.size()
              << " parameters: " << name(found.status) << ' ' << found.stop.reason << ", "
              << found.evaluations.size() << " evaluations, " << found.work.responses << " responses, "
              << found.seconds << " s, others " << seconds_since(begin) << " s, above them by "
              << (found.feasible ? found.amplitude / other.amplitude - 1 : HUGE_VAL) << " (" << other.by
              << "), limits exceeded by " << excess << std::endl;
    CAPTURE(seed, found.design, found.amplitude, found.stop.message);
    if (found.feasible) CHECK(excess <= 1e-6);
    const bool at_end = found.stop.reason == optimize::reasons::end_of_window;
    if (found.status != observables::Status::complete && !at_end) continue;
    ++complete;
    CHECK(found.feasible);
    if (at_end) continue;  // stopped: a wider window is asked for, and no lowest amplitude is promised
    CAPTURE(other.amplitude, other.by, other.design);
    CHECK(found.amplitude <= other.amplitude * (1 + 1e-6));
  }
  CHECK(2 * complete >= searched);
}

TEST_CASE("where the best design is next to others with one more peak, beyond a limit, the end says so") {
  const auto search = random_limits::make(16);
  const auto found = optimize::optimum(search.scene, search.problem, {.certificate = false, .starts = 1});
  CAPTURE(found.stop.message);
  REQUIRE(found.feasible);
  CHECK(random_limits::excess(search, found.design) <= 1e-6);
  CHECK(found.stop.reason == optimize::reasons::not_stationary);
  const std::string beyond = "a peak appears at which a limit is exceeded by 0.00380";
  CHECK(found.stop.message.find(beyond) != std::string::npos);
}

TEST_CASE("where a limit has another gradient next to the best design, the end says so") {
  auto search = random_limits::make(340);
  const auto found = search_from(search, {});
  CAPTURE(found.design, found.stop.message);
  REQUIRE(found.feasible);
  CHECK(random_limits::excess(search, found.design) <= 1e-6);
  CHECK(found.stop.reason == optimize::reasons::not_stationary);
  CHECK(found.stop.message.find("against its gradient") != std::string::npos);
}

TEST_CASE("a search that loses a peak next to its best design goes on from a design close by") {
  auto search = random_limits::make(885);
  const auto found = search_from(search, {3.939, 8.5564});
  CAPTURE(found.design, found.stop.message);
  CHECK(found.stop.reason ==
        optimize::reasons::not_stationary);  // next to the peak, where a limit is exceeded
  REQUIRE(found.feasible);
  CHECK(random_limits::excess(search, found.design) <= 1e-6);
  CHECK(found.amplitude <= 0.00033819059 * (1 + 1e-6));  // 0.0003596 where both dampers stick
}

TEST_CASE("a search ends at no higher design than the best of which a response was known") {
  auto search = random_limits::make(906);
  const auto found = search_from(search, {0.7037480849, 0.1387453255, 0.09646341362, 573686.5866});
  CAPTURE(found.design, found.stop.message);
  REQUIRE(found.feasible);
  CHECK(random_limits::excess(search, found.design) <= 1e-6);
  CHECK(found.evaluations[0].amplitude == Approx(0.00039140375));
  CHECK(found.amplitude <= found.evaluations[0].amplitude * (1 + 1e-7));
}

TEST_CASE("a limit that is kept is kept at peaks that have just come up, too") {
  auto search = random_limits::make(822);
  const auto found = search_from(search, {90000});
  CAPTURE(found.design, found.stop.message);
  REQUIRE(found.feasible);
  CHECK(random_limits::excess(search, found.design) <= 1e-6);
  CHECK(found.amplitude <= 0.00021543642 * (1 + 1e-6));
}

TEST_CASE("a lower amplitude outside the limits is no gain: the search looks for designs within them") {
  auto search = random_limits::make(309);
  const auto found = search_from(search, {});
  CAPTURE(found.design, found.stop.message);
  CHECK(found.status == observables::Status::complete);
  CHECK(found.amplitude <= 0.00033571063 * (1 + 1e-6));  // by LD_MMA from one of forty designs
}

TEST_CASE("of several minima the search finds the one that few starts come to") {
  const auto [seed, known] = GENERATE(table<std::uint64_t, double>({
      {209, 0.000288806017},  // by LN_COBYLA from two of forty designs
      {546, 2.79964235e-06},  // by LD_SLSQP from one of forty, the others come to 2.8646e-6
  }));
  const auto search = random_limits::make(seed);
  const auto found = optimize::optimum(search.scene, search.problem, {.certificate = false});
  CAPTURE(seed, found.design, found.stop.message);
  // Their windows end on the flank of a resonance, where the least amplitude is.
  REQUIRE(found.stop.reason == optimize::reasons::end_of_window);
  CHECK(found.amplitude <= known * (1 + 1e-6));
}
