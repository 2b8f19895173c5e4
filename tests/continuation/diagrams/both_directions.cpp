#include "catch.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/diagrams/diagram.hpp>

using namespace problems;

TEST_CASE("a branch is traced from its start in both directions, as one with its events in order") {
  // mu = x^3 - x from its middle: folds at x = -+ 1 / sqrt(3).
  for (const int direction : {1, -1}) {
    const WholeBranch whole = trace_both(cusp(), {Vector{{0.0}}, Vector{{0.0, 1.0}}, 0, direction},
                                         window(-1, 1), {fold_monitor()});
    const auto& points = whole.branch.points;
    CHECK(whole.begin.reason == StopReason::boundary);
    CHECK(whole.branch.stop.reason == StopReason::boundary);
    REQUIRE(points.size() > 10);
    CHECK(points.front().parameter == direction * 1.0);
    CHECK(points.back().parameter == -direction * 1.0);
    CHECK(std::count_if(points.begin(), points.end(), [](const Point& at) { return at.arclength == 0; }) ==
          1);
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      CHECK(points[k].arclength < points[k + 1].arclength);
      CHECK(points[k].tangent.dot(points[k + 1].tangent) > 0);
    }
    REQUIRE(whole.branch.events.size() == 2);
    for (const Event& fold : whole.branch.events) {
      CHECK(std::abs(std::abs(fold.point.u[0]) - 1 / std::sqrt(3.0)) < 1e-9);
      CHECK(points[fold.after].arclength <= fold.point.arclength);
      CHECK(fold.point.arclength <= points[fold.after + 1].arclength);
    }
  }
}

TEST_CASE("a closed branch is traced once, and an observer ends both ways") {
  const WholeBranch loop = trace_both(circle(), {Vector{{0.6}}, Vector{{0.8}}, 0, 1}, window(-2, 2));
  CHECK(loop.branch.stop.reason == StopReason::closed);
  CHECK(loop.begin.reason == StopReason::closed);
  CHECK(loop.branch.points.front().arclength == 0);
  int seen = 0;
  const WholeBranch ended = trace_both(cusp(), {Vector{{0.0}}, Vector{{0.0, 1.0}}, 0, 1}, window(-1, 1), {},
                                       [&](const Accepted&, const Event*) { return ++seen < 3; });
  CHECK(seen == 3);
  CHECK(ended.branch.stop.reason == StopReason::user);
  CHECK(ended.branch.points.size() == 3);
}

TEST_CASE("a start that fails has no way backward") {
  const auto none = from_functions(1, {parameter("p", 0)}, [](In u, In, Out F) { F[0] = u[0] * u[0] + 1; });
  const WholeBranch whole = trace_both(none, {Vector{{1.0}}, Vector{{0.0}}, 0, 1}, window(-1, 1));
  CHECK(whole.branch.points.empty());
  CHECK(whole.begin.reason == StopReason::start_failed);
}

TEST_CASE(
    "the ranges of stability of both directions are those of their points, also where few have a spectrum") {
  // mu = x^3 - x, x' = mu + x - x^3: unstable between its folds.
  for (const SpectrumAt spectra : {SpectrumAt::every_point, SpectrumAt::events})
    for (const double from : {0.0, 0.9}) {
      Options options = window(-1, 1);
      options.stability.emplace();
      options.stability->at = spectra;
      const WholeBranch whole =
          trace_both(cusp(), {Vector{{from}}, Vector{{from * from * from - from, 1.0}}, 0, 1}, options,
                     {fold_monitor()});
      const auto ranges = stability_ranges(whole.branch);
      REQUIRE(ranges.size() == 3);
      CHECK(ranges.front().first == 0);
      CHECK(ranges.back().last == whole.branch.points.size() - 1);
      for (const StabilityRange& range : ranges) {
        CHECK(range.complete);
        for (std::size_t i = range.first; i <= range.last; ++i) {
          CAPTURE(i, whole.branch.points[i].u[0]);
          CHECK(range.unstable == (std::abs(whole.branch.points[i].u[0]) < 1 / std::sqrt(3.0) ? 1 : 0));
        }
      }
    }
}
