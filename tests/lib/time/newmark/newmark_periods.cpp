// Newmark's method over whole periods: the derivative of its map, its multipliers, transients.

#include "catch.hpp"
#include "lib/analyses/responses/reference.hpp"
#include "lib/time/newmark/newmark_systems.hpp"

#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <algorithm>
#include <complex>

using namespace time_test;

TEST_CASE("the derivative of the map over a period is that of differences") {
  EquationOfMotion equation = oscillator(1, 0, 1, 0, 1.3);
  equation.M = Matrix{{1, 0.1, 0}, {0.1, 2, 0}, {0, 0, 0}};
  equation.C = Matrix{{0.2, -0.1, 0}, {-0.1, 0.15, 0}, {0, 0, 0}};
  equation.K = Matrix{{3, -1, 0}, {-1, 4, -2}, {0, -2, 2.5}};
  equation.forces = {{vector({1, 0.3, 0.2}), 1, 1.5, 0.4}, {vector({0, 1, 0}), 2, 0, 0.3}};
  equation.response = vector({1, 0, 0});
  add_damper(equation, vector({1, -1, 0}), 2, 0.4);
  add_damper(equation, vector({0, 0, 1}), 3, 0.3);
  add_damper(equation, vector({1, 0, 0}), 0.5, 100);  // rests
  add_cubic(equation, vector({0, 1, 0}), 0.8);
  Newmark newmark(equation, 60);
  MotionState start = newmark_periods(newmark, at_rest(equation), 25, false, true).end;
  const PeriodMap map = newmark_map(newmark, start);
  REQUIRE(map.done);
  REQUIRE(map.resting.size() == 1);
  CHECK(map.resting[0].slider == 2);
  const auto changed = [&](Eigen::Index i, double by) {
    MotionState state = start;
    if (i < 3) state.x[i] += by;
    if (i >= 3 && i < 6) state.v[i - 3] += by;
    if (i >= 6) state.z[i - 6] += by;
    return newmark_map(newmark, state);
  };
  const auto stacked = [](const MotionState& state) {
    Vector y(state.x.size() + state.v.size() + state.z.size());
    y << state.x, state.v, state.z;
    return y;
  };
  const double step = 1e-6;
  for (Eigen::Index i = 0; i < 9; ++i) {
    CAPTURE(i);
    const PeriodMap above = changed(i, step), below = changed(i, -step);
    const Vector difference = (stacked(above.end) - stacked(below.end)) / (2 * step);
    CHECK((difference - map.monodromy.col(i)).cwiseAbs().maxCoeff() < 1e-7);
    CHECK((above.resting[0].offset - below.resting[0].offset) / (2 * step) ==
          Approx(map.resting[0].derivative[i]).margin(1e-7));
  }
}

TEST_CASE("Floquet multipliers of the discrete map come to those of the motion, one of them to zero",
          "[numbers]") {
  // By differences of the exact motion: 0.84767, 0.81154 and 0 for the paper's oscillator at 20 Hz and 3 N.
  // At first order only: a slider that begins to slip within a step takes on dq from the end of the step.
  const auto equation = paper(20, 3);
  for (const long steps : {200L, 800L, 3200L, 12800L}) {
    CAPTURE(steps);
    Newmark newmark(equation, steps);
    const MotionState start = newmark_periods(newmark, at_rest(equation), 200, false, true).end;
    const PeriodMap map = newmark_map(newmark, start);
    const Eigen::VectorXcd values = arcslip::continuation::eigenvalues(map.monodromy);
    std::vector<double> sizes;
    for (const auto& value : values) sizes.push_back(std::abs(value));
    std::sort(sizes.begin(), sizes.end());
    CHECK(sizes[0] < 1e-12);
    CHECK(std::abs(sizes[1] - 0.81154) < 10.0 / static_cast<double>(steps) + 1e-5);
    CHECK(std::abs(sizes[2] - 0.84767) < 10.0 / static_cast<double>(steps) + 1e-5);
  }
}

TEST_CASE("a transient ends where it is steady, at its limit, or as asked, and records its last periods") {
  const auto equation = paper(20, 3);
  Newmark newmark(equation, 100);
  const Periods integrate = [&](const MotionState& start, long count, bool with_history) {
    return newmark_periods(newmark, start, count, with_history, false);
  };
  const auto steady =
      transient(integrate, at_rest(equation), equation.omega, {.periods = 1000, .recorded = 2});
  CHECK(steady.reason == TransientEnd::steady);
  CHECK(steady.change <= 1e-9);
  // multiplier 0.84767: 1e-9 after some 125 periods
  CHECK(steady.periods > 60);
  CHECK(steady.periods < 160);
  REQUIRE(steady.motion.history.time.size() == 201);
  CHECK(std::abs(steady.motion.history.displacement.front() - steady.motion.history.displacement.back()) <
        2e-9 * steady.motion.amplitude);

  const auto limited =
      transient(integrate, at_rest(equation), equation.omega, {.periods = 10, .tolerance = 0});
  CHECK(limited.reason == TransientEnd::period_limit);
  CHECK(limited.periods == 9);
  CHECK(limited.motion.time == Approx(equation.period()).epsilon(1e-14));
  const auto all = transient(integrate, at_rest(equation), equation.omega, {.periods = 3, .recorded = 5});
  CHECK(all.periods == 0);
  CHECK(all.motion.history.time.size() == 501);

  const auto stopped = transient(integrate, at_rest(equation), equation.omega, {},
                                 [](long periods, double) { return periods < 7; });
  CHECK(stopped.reason == TransientEnd::user);
  CHECK(stopped.periods == 7);

  auto runaway = oscillator(1, 0, -10, 1, 1);
  Newmark grows(runaway, 100);
  const Periods explode = [&](const MotionState& start, long count, bool with_history) {
    return newmark_periods(grows, start, count, with_history, false);
  };
  const auto failed = transient(explode, at_rest(runaway), 1, {});
  CHECK(failed.reason == TransientEnd::failed);
  CHECK(failed.motion.failure == reasons::not_finite);
  CHECK(failed.motion.history.time.size() > 1);
  CHECK(failed.periods > 10);
}
