#include "catch.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/stationary.hpp>

#include <numbers>

using namespace problems;

namespace {

constexpr int mu = 0, lambda = 1;

// The curve of folds in mu through a fold of the branch at lambda = 1, over lambda.
Branch fold_curve(const MakeLinearSolver& solver = {}) {
  const auto problem = cusp();
  const Vector p = Vector{{-1.0, 1.0}};
  const Branch branch =
      trace(problem, {Vector::Constant(1, -1.3), p, mu, 1}, window(-1, 1), {fold_monitor()});
  REQUIRE(events_named(branch, "fold").size() == 2);
  Options options = window(-1, 2);
  return trace(folds(problem, mu, solver), {with_parameter(branch.events[0].point), p, lambda, -1}, options,
               {cusp_monitor()});
}

}  // namespace

TEST_CASE("the folds of mu + lambda x - x^3 lie on mu^2 = 4/27 lambda^3, and turn at a cusp at 0") {
  const Branch curve = fold_curve();
  REQUIRE(curve.stop.reason == StopReason::boundary);
  REQUIRE(curve.points.size() > 20);
  for (const Point& point : curve.points) {
    const double x = point.u[0];
    CHECK(std::abs(point.parameter - 3 * x * x) < 1e-10);
    CHECK(std::abs(point.u[1] + 2 * x * x * x) < 1e-10);
  }
  CHECK(curve.points.back().parameter == Approx(2).margin(1e-12));
  const auto cusps = events_named(curve, "cusp");
  REQUIRE(cusps.size() == 1);
  CHECK(std::abs(cusps[0].point.u[0]) < 1e-8);
  CHECK(std::abs(cusps[0].point.parameter) < 1e-10);
}
