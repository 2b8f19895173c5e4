// What is told of starts and ends that have a cause of their own, and not another one.

#include "catch.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/special_points/stationary.hpp>

using namespace problems;

namespace {

bool says(const std::string& message, const char* what) {
  return message.find(what) != std::string::npos;
}

}  // namespace

TEST_CASE("a kink without `piece` and without a Jacobian: `piece` is asked for, and no Jacobian was given") {
  // u - 3 max(0, u - 1) = p: a nonsmooth fold at p = 1
  const auto problem = from_functions(1, {{"p", "", -1}}, [](In u, In p, Out F) {
    F[0] = u[0] - 3 * std::max(0.0, u[0] - 1) - p[0];
  });
  const Branch branch =
      trace(problem, {.u = Vector{{-1.0}}, .p = Vector{{-1.0}}}, window(-2, 2), {fold_monitor()});
  CAPTURE(branch.stop.message);
  CHECK(branch.stop.reason != StopReason::wrong_jacobian);
  CHECK_FALSE(says(branch.stop.message, "is given as"));
  CHECK_FALSE(says(branch.stop.message, "the Jacobian is wrong"));
  CHECK(says(branch.stop.message, "give `piece`"));
  for (const std::string& warning : branch.warnings) CHECK_FALSE(says(warning, "is given as"));
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
  CHECK_FALSE(says(branch.stop.message, "after rejections"));
  CHECK(says(branch.stop.message, "the step that `step.relative_parameter` allows at 1e-06, 5e-13"));
  CHECK(says(branch.stop.message, "`scale`"));
}

TEST_CASE("the index of a parameter that there is not is told as an index from 0") {
  const auto one = from_functions(1, {{"p", ""}}, [](In u, In p, Out F) { F[0] = u[0] - p[0]; });
  CHECK_THROWS_WITH(trace(one, {.u = Vector{{0.0}}, .p = Vector{{0.0}}, .free = 1}, window(0, 1)),
                    "the free parameter has index 1, but the problem has 1 parameter, with index 0");
}

TEST_CASE("a parameter among the unknowns of a curve is refused as the free one, whatever its scale") {
  const auto problem = from_functions(1, {{"mu", ""}, {"lambda", "", 1}}, [](In u, In p, Out F) {
    F[0] = p[0] + p[1] * u[0] - std::pow(u[0], 3);
  });
  CHECK_THROWS_WITH(
      trace(folds(problem, 0), {Vector{{0.5, -0.25}}, Vector{{0.0, 0.75}}, 0, 1}, window(-1, 1)),
      "the parameter \"mu\" is among the unknowns of this problem: another one has to be free");
}
