// What is reported of starts and ends that have a cause of their own, and not another one.

#include "catch.hpp"
#include "contains.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/special_points/stationary.hpp>

using namespace problems;

TEST_CASE("a kink without `piece` and without a Jacobian: `piece` is asked for, and no Jacobian was given") {
  // u - 3 max(0, u - 1) = p: a nonsmooth fold at p = 1
  const auto problem = from_functions(
      1, {{"p", "", -1}}, [](In u, In p, Out F) { F[0] = u[0] - 3 * std::max(0.0, u[0] - 1) - p[0]; });
  const Branch branch =
      trace(problem, {.u = Vector{{-1.0}}, .p = Vector{{-1.0}}}, window(-2, 2), {fold_monitor()});
  CAPTURE(branch.stop.message);
  CHECK(branch.stop.reason != StopReason::wrong_jacobian);
  CHECK_FALSE(contains(branch.stop.message, "is given as"));
  CHECK_FALSE(contains(branch.stop.message, "the Jacobian is wrong"));
  CHECK(contains(branch.stop.message, "give `piece`"));
  for (const std::string& warning : branch.warnings) CHECK_FALSE(contains(warning, "is given as"));
}

TEST_CASE("a step that an option holds below the smallest one ends with the option, and no rejections") {
  // u = p^3 / (1 + p^3) from 1e-6 in a window to 1e6
  const auto problem = from_functions(
      1, {{"p", "", 1e-6}}, [](In u, In p, Out F) { F[0] = u[0] - 1 / (1 + std::pow(p[0], -3)); }, {},
      [](In, In p, int, Out dF) {
        const double q = std::pow(p[0], -3);
        dF[0] = -3 * q / p[0] / ((1 + q) * (1 + q));
      });
  Options options = window(1e-6, 1e6);
  options.step.relative_parameter = 0.5;
  const Branch branch = trace(problem, {.u = Vector{{0.0}}, .p = Vector{{1e-6}}}, options);
  CAPTURE(branch.stop.message);
  CHECK(branch.stop.reason == StopReason::step_too_small);
  CHECK(branch.counts.rejected_steps == 0);
  CHECK_FALSE(contains(branch.stop.message, "after rejections"));
  CHECK(contains(branch.stop.message, "the step that `step.relative_parameter` allows at 1e-06, 5e-13"));
  CHECK(contains(branch.stop.message, "`scale`"));
}

TEST_CASE("the index of a parameter that there is not is reported as an index from 0") {
  const auto one = from_functions(1, {{"p", ""}}, [](In u, In p, Out F) { F[0] = u[0] - p[0]; });
  CHECK_THROWS_WITH(trace(one, {.u = Vector{{0.0}}, .p = Vector{{0.0}}, .free = 1}, window(0, 1)),
                    "the free parameter has index 1, but the problem has 1 parameter, with index 0");
}

TEST_CASE("a start on a branch point is reported to be one, with a tangent or without") {
  // 0.1 (1 - S) - R S I, R S I - I: transcritical at R = 1, S = 1, I = 0
  const auto epidemic = from_functions(2, {{"R", "", 1}}, [](In u, In p, Out F) {
    F << 0.1 * (1 - u[0]) - p[0] * u[0] * u[1], p[0] * u[0] * u[1] - u[1];
  });
  for (const Vector& tangent : {Vector(), Vector{{0.0, 0.0, 1.0}}, Vector{{1.0, -0.1, 1.0}}}) {
    const Branch branch =
        trace(epidemic, {.u = Vector{{1.0, 0.0}}, .p = Vector{{1.0}}, .tangent = tangent}, window(0.5, 2));
    CAPTURE(branch.stop.message);
    CHECK(branch.stop.reason == StopReason::start_failed);
    CHECK(contains(branch.stop.message, "it is a branch point"));
    CHECK(contains(branch.stop.message, "start next to it"));
    CHECK_FALSE(contains(branch.stop.message, "needs a tangent"));
  }
  const Branch nearby = trace(epidemic, {.u = Vector{{1.0, 0.0}}, .p = Vector{{0.7}}}, window(0.5, 2),
                              {branch_point_monitor()});
  REQUIRE(nearby.events.size() == 1);
  CHECK(std::abs(nearby.events[0].point.parameter - 1) < 1e-9);
}

TEST_CASE("sums that are conserved are named, one or two") {
  const auto exchange = from_functions(
      2, {{"k", "", 1}}, [](In u, In p, Out F) { F << -p[0] * u[0] + 2 * u[1], p[0] * u[0] - 2 * u[1]; });
  for (const double b : {1.0, 1.3}) {
    const Branch branch = trace(exchange, {.u = Vector{{2.0, b}}, .p = Vector{{1.0}}}, window(0.5, 2));
    CAPTURE(b, branch.stop.message);
    CHECK(branch.stop.reason != StopReason::boundary);
    CHECK(contains(branch.stop.message, "F[0] + F[1] = 0 for all u and p around"));
    CHECK(contains(branch.stop.message, "a set of 1 dimension more than a branch"));
    CHECK(contains(branch.stop.message, "conserved"));
    CHECK_FALSE(contains(branch.stop.message, "needs a tangent"));
  }
  // Michaelis and Menten's cycle: the sums of enzyme, E + C, and of substrate, S + C + P
  const auto enzyme = from_functions(4, {{"k", "", 1}}, [](In x, In p, Out F) {
    const double a = p[0] * x[0] * x[1], b = x[2], c = 0.5 * x[2], d = 0.3 * x[3];
    F << -a + b + d, -a + b + c, a - b - c, c - d;
  });
  const Branch branch = trace(enzyme, {.u = Vector{{1, 1, 1, 1}}, .p = Vector{{1.0}}}, window(0.5, 2));
  CAPTURE(branch.stop.message);
  CHECK(branch.stop.reason != StopReason::boundary);
  CHECK(contains(branch.stop.message, "a set of 2 dimensions more than a branch"));
  CHECK(contains(branch.stop.message, "F[1] + F[2] = 0"));
  CHECK_FALSE(contains(branch.stop.message, "needs a tangent"));
  // with the values of the sums in their places all is right: C = E0 - E, S = S0 - C - P
  const auto held = from_functions(4, {{"k", "", 1}}, [](In x, In p, Out F) {
    const double a = p[0] * x[0] * x[1], b = x[2], c = 0.5 * x[2], d = 0.3 * x[3];
    F << -a + b + d, x[1] + x[2] - 2, x[0] + x[2] + x[3] - 3, c - d;
  });
  CHECK(trace(held, {.u = Vector{{1, 1, 1, 1}}, .p = Vector{{1.0}}}, window(0.5, 2)).stop.reason ==
        StopReason::boundary);
}

TEST_CASE("a symmetry is no conserved sum, and a fold no branch point") {
  const auto ring = from_functions(
      2, {{"mu", "", 1}}, [](In x, In p, Out F) { F = (p[0] - x.squaredNorm()) * x; },
      [](In x, In p, Eigen::Ref<Matrix> J) {
        J = -2 * x * x.transpose();
        J.diagonal().array() += p[0] - x.squaredNorm();
      });
  const Branch branch = trace(ring, {.u = Vector{{1.0, 0.0}}, .p = Vector{{1.0}}}, window(0.5, 2));
  CAPTURE(branch.stop.message);
  CHECK(contains(branch.stop.message, "phase condition"));
  CHECK_FALSE(contains(branch.stop.message, "conserved"));
  const auto parabola = from_functions(1, {{"p", ""}}, [](In u, In p, Out F) { F[0] = p[0] - u[0] * u[0]; });
  const Branch fold = trace(parabola, {.u = Vector{{0.0}}, .p = Vector{{0.0}}}, window(-1, 1));
  CAPTURE(fold.stop.message);
  CHECK(contains(fold.stop.message, "needs a tangent"));
  CHECK_FALSE(contains(fold.stop.message, "branch point, where"));
}

TEST_CASE("a parameter among the unknowns of a curve is refused as the free one, whatever its scale") {
  const auto problem = from_functions(1, {{"mu", ""}, {"lambda", "", 1}}, [](In u, In p, Out F) {
    F[0] = p[0] + p[1] * u[0] - std::pow(u[0], 3);
  });
  CHECK_THROWS_WITH(
      trace(folds(problem, 0), {Vector{{0.5, -0.25}}, Vector{{0.0, 0.75}}, 0, 1}, window(-1, 1)),
      "the parameter \"mu\" is among the unknowns of this problem: another one has to be free");
}

TEST_CASE("a start on a fold is not reported to be a branch point where equations have other units") {
  // p = u0^2 in N, and a second equation in units a billion times larger
  const auto units = from_functions(
      2, {{"p", "", 0}}, [](In u, In p, Out F) { F << p[0] - u[0] * u[0], 1e-9 * (u[1] - 2 * p[0]); },
      [](In u, In, Eigen::Ref<Matrix> J) { J << -2 * u[0], 0, 0, 1e-9; });
  const Branch branch = trace(units, {.u = Vector{{0.0, 0.0}}, .p = Vector{{0.0}}}, window(-1, 1));
  CAPTURE(branch.stop.message);
  CHECK(branch.stop.reason == StopReason::start_failed);
  CHECK_FALSE(contains(branch.stop.message, "branch point, where"));
  CHECK(contains(branch.stop.message, "needs a tangent"));
}
