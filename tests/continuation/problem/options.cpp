#include "catch.hpp"

#include <arcslip/continuation/problem/problem_from_functions.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>

#include <functional>
#include <string>

using namespace arcslip::continuation;

TEST_CASE("every option out of bounds is refused with its value and its bound") {
  struct Row {
    std::function<void(Options&)> change;
    std::string message;
  };
  const std::vector<Row> rows = {
      {[](Options& o) { o.lower = std::nan(""); }, "options.lower"},
      {[](Options& o) { o.upper = -1; }, "options.upper is -1"},
      {[](Options& o) { o.newton.tolerance = 0; }, "newton.tolerance is 0, must be > 0"},
      {[](Options& o) { o.newton.rounding_level = 1e-12; }, "newton.rounding_level"},
      {[](Options& o) { o.newton.iterations = 1; }, "newton.iterations is 1, must be >= 2"},
      {[](Options& o) { o.newton.start_iterations = 1; }, "newton.start_iterations is 1, must be >= 2"},
      {[](Options& o) { o.newton.transient_steps = -1; }, "newton.transient_steps is -1, must be >= 0"},
      {[](Options& o) { o.newton.chord_contraction = 1; }, "newton.chord_contraction is 1"},
      {[](Options& o) { o.step.initial = -1; }, "step.initial"},
      {[](Options& o) { o.step.smallest = 0; }, "step.smallest"},
      {[](Options& o) { o.step.largest_parameter = -1; }, "step.largest_parameter"},
      {[](Options& o) { o.step.relative_parameter = -1; }, "step.relative_parameter"},
      {[](Options& o) { o.step.relative_state = 0; }, "step.relative_state"},
      {[](Options& o) { o.step.angle = 1; }, "step.angle is 1"},
      {[](Options& o) { o.step.largest_angle = 2; }, "step.largest_angle"},
      {[](Options& o) { o.step.contraction = 1; }, "step.contraction"},
      {[](Options& o) { o.points = 0; }, "options.points"},
      {[](Options& o) { o.largest_state = 0; }, "options.largest_state"},
      {[](Options& o) { o.event_tolerance = 0; }, "options.event_tolerance"},
  };
  for (const Row& row : rows) {
    Options options;
    options.lower = 0;
    options.upper = 1;
    CHECK_NOTHROW(check(options));
    row.change(options);
    CHECK_THROWS_WITH(check(options), Catch::Contains(row.message));
  }
}

TEST_CASE("a start that does not fit the problem is refused with both numbers") {
  const auto problem =
      from_functions(2, {{"p", "", 0, 1, -1e300, 1e300}}, [](In u, In p, Out F) { F = u.array() - p[0]; });
  Options options;
  options.lower = 0;
  options.upper = 1;
  const auto begin = [&](Vector u, Vector p) { trace(problem, {u, p, 0, 1}, options); };
  CHECK_THROWS_WITH(begin(Vector::Zero(3), Vector::Zero(1)), "the start has 3 unknowns, the problem 2");
  CHECK_THROWS_WITH(begin(Vector::Zero(2), Vector::Zero(2)), "the start has 2 parameters, the problem 1");
  CHECK_THROWS_WITH(begin(Vector::Constant(2, std::nan("")), Vector::Zero(1)),
                    "the start has non-finite values");
  CHECK_THROWS_WITH(begin(Vector::Zero(2), Vector::Constant(1, 3)),
                    "the start is at 3, outside the window [0, 1]");
}
