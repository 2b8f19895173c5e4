// Branches that cross others, and other places that are hard to pass.

#include "catch.hpp"

#include "continuation/suite/cases.hpp"

#include <cmath>

using namespace suite;
using arcslip::continuation::branch_point_monitor;
using arcslip::continuation::fold_monitor;
using arcslip::continuation::from_functions;
using arcslip::continuation::Point;
using arcslip::continuation::StopReason;

TEST_CASE("a simple branch point is passed straight ahead on the trivial branch, without an event") {
  for (double lambda : {-1.0, -0.9, -0.7}) {
    for (int n : {1, 2, 5}) {
      const Branch branch =
          arcslip::continuation::trace(turned_pitchfork(n, 0), {Vector::Zero(n), Vector{{lambda, 0.0}}, 0, 1},
                                       window(-1, 1), {fold_monitor()});
      CHECK(branch.stop.reason == StopReason::boundary);
      CHECK(branch.points.back().parameter == 1);
      CHECK(branch.events.empty());
      for (const Point& point : branch.points) REQUIRE(point.u.norm() < 1e-12);
    }
    const Branch diagonal = arcslip::continuation::trace(
        transcritical(), {Vector::Constant(1, lambda), Vector{{lambda, 0.0}}, 0, 1}, window(-1, 1),
        {fold_monitor()});
    CHECK(diagonal.stop.reason == StopReason::boundary);
    CHECK(diagonal.events.empty());
    for (const Point& point : diagonal.points) REQUIRE(std::abs(point.u[0] - point.parameter) < 1e-9);
  }
}

TEST_CASE("the parabola of the pitchfork is followed through its vertex, a branch point and no fold") {
  for (double lambda : {1.0, 0.9, 0.7}) {
    const Branch branch = arcslip::continuation::trace(
        pitchfork(), {Vector::Constant(1, std::sqrt(lambda)), Vector{{lambda, 0.0}}, 0, -1}, window(-1, 1),
        {fold_monitor(), branch_point_monitor()});
    CHECK(branch.points.back().parameter == 1);
    CHECK(std::abs(branch.points.back().u[0] + 1) < 1e-12);
    REQUIRE(branch.events.size() == 1);
    CHECK(branch.events[0].monitor == "branch_point");
    CHECK(std::abs(branch.events[0].point.parameter) < 1e-15);
    CHECK(std::abs(branch.events[0].point.u[0]) < 1e-15);
  }
}

TEST_CASE("equal cells are followed through all eight branch points and both folds") {
  const Branch branch = trace(named("cell_kinetics"));
  REQUIRE(branch.stop.reason == StopReason::boundary);
  const auto found = folds(branch);
  REQUIRE(found.size() == 2);
  CHECK(std::abs(found[0].point.parameter - 34.3569249985262) < 1e-10);
  CHECK(std::abs(found[1].point.parameter - 18.8870676579243) < 1e-10);
}

TEST_CASE("a singular start is not said to be one that cannot be evaluated") {
  CHECK(trace(named("powell_4")).stop.reason == StopReason::start_failed);
}

TEST_CASE("no step on the slipping Duffing oscillator's branch over its normal load is rejected") {
  const Branch branch = trace(named("duffing_jenkins_Fn_low"));
  REQUIRE(branch.stop.reason == StopReason::boundary);
  CHECK(branch.counts.rejected_steps == 0);
}

TEST_CASE("u = lambda e^u has one fold, at lambda = 1/e, however far its tail is followed") {
  const auto problem = from_functions(
      1, {parameter("lambda", 0)}, [](In u, In p, Out F) { F[0] = u[0] - p[0] * std::exp(u[0]); },
      [](In u, In p, MatrixOut J) { J(0, 0) = 1 - p[0] * std::exp(u[0]); },
      [](In u, In, int, Out dF) { dF[0] = -std::exp(u[0]); });
  const auto found = folds(arcslip::continuation::trace(problem, {Vector::Zero(1), Vector::Zero(1), 0, 1},
                                                        window(0, 1), {fold_monitor()}));
  REQUIRE(found.size() == 1);
  CHECK(std::abs(found[0].point.parameter - std::exp(-1.0)) < 1e-12);
}

TEST_CASE(
    "the tail of u = lambda e^u, where lambda falls below its rounding, does not end on another branch") {
  const auto problem = from_functions(1, {parameter("lambda", 0)},
                                      [](In u, In p, Out F) { F[0] = u[0] - p[0] * std::exp(u[0]); });
  const Branch branch =
      arcslip::continuation::trace(problem, {Vector::Zero(1), Vector::Zero(1), 0, 1}, window(0, 1));
  CAPTURE(branch.stop.message);
  double last = 0;
  for (const Point& point : branch.points) {
    CHECK(point.u[0] >= last);  // and not at lambda = 0, where u = 0 is the only solution
    last = point.u[0];
    CHECK(std::abs(point.parameter - last * std::exp(-last)) < 1e-15);
  }
  CHECK(last > 20);
}
