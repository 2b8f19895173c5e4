// Curves of zeros of test functions: of g = u_0^2 + u_1 - 1 on the surface u = (a + b^2, a b), where
//
//   a^2 + a (2 b^2 + b) + b^4 - 1 = 0
#include "catch.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/special_points/test_functions.hpp>

#include <cmath>

using namespace problems;

namespace {

constexpr int a_index = 0, b_index = 1;

std::shared_ptr<const Problem> surface(PieceFunction piece = {}) {
  return from_functions({.size = 2,
                         .parameters = {{"a", "", 1}, {"b", "", 0}},
                         .residual =
                             [](In u, In p, Out F) {
                               F[0] = std::exp(u[0] - p[0] - p[1] * p[1]) - 1;
                               F[1] = (u[1] - p[0] * p[1]) * (2 + u[0] * u[0]);
                             },
                         .piece = std::move(piece)});
}

double test_function(In u) {
  return u[0] * u[0] + u[1] - 1;
}

TestFunctions one(std::function<double(In u, In p)> value) {
  return {[value = std::move(value)] {
    return [value](Evaluator&, In u, In p, In, Out g) {
      g[0] = value(u, p);
      return std::isfinite(g[0]);
    };
  }};
}

TestFunctions with_further_unknown() {
  return {[] {
            return [](Evaluator&, In u, In, In k, Out g) {
              g << 2 * u[0] - 2 * k[0], test_function(u);
              return true;
            };
          },
          Vector::Ones(1)};
}

// The larger a at b; the other with the other sign.
double a_of(double b, double sign = 1) {
  const double half = b * b + 0.5 * b;
  return -half + sign * std::sqrt(half * half - (b * b * b * b - 1));
}

const Vector at_start{{1.0, 0.0}};  // both the unknowns and the parameters

Branch curve(const std::shared_ptr<const Problem>& problem, const Vector& x, int direction, Options options,
             std::vector<Monitor> monitors = {}) {
  return trace(problem, {x, at_start, b_index, direction}, options, std::move(monitors));
}

Vector start_of(const Problem& problem) {
  return problem.size() == 3 ? Vector{{1.0, 0.0, 1.0}} : Vector{{1.0, 0.0, 1.0, 1.0}};
}

}  // namespace

TEST_CASE("zeros of a test function are followed on the surface of solutions, round a turn") {
  for (const bool further : {false, true}) {
    const auto problem = test_function_zeros(
        surface(), a_index,
        further ? with_further_unknown() : one([](In u, In) { return test_function(u); }));
    CHECK(problem->size() == (further ? 4 : 3));
    for (const int direction : {1, -1}) {
      const Branch found = curve(problem, start_of(*problem), direction, window(-2, 1.5), {fold_monitor()});
      CAPTURE(further, direction, found.stop.message);
      REQUIRE(found.stop.reason == StopReason::boundary);
      CHECK(found.warnings.empty());
      CHECK(found.points.back().parameter == 1.5);  // also from -1, by the turn
      double sign = 1;
      for (const Point& point : found.points) {
        const double b = point.parameter, a = point.u[2];
        if (!found.events.empty() && point.arclength > found.events[0].point.arclength) sign = -1;
        CHECK(std::abs(a - a_of(b, sign)) < 1e-9 * (1 + std::abs(a) / std::abs(a_of(b) - a_of(b, -1))));
        CHECK(std::abs(point.u[0] - a - b * b) < 1e-11);
        if (further) CHECK(std::abs(point.u[3] - point.u[0]) < 1e-10);
      }
      REQUIRE(found.events.size() == (direction > 0 ? 0 : 1));
      if (direction > 0) continue;
      // 4 b^3 + b^2 + 4 = 0
      const double b = found.events[0].point.parameter;
      CHECK(std::abs(4 * b * b * b + b * b + 4) < 1e-12);
    }
  }
}

TEST_CASE("derivatives of test functions are those of the residual, and the linear solver inverts them") {
  const auto problem = test_function_zeros(surface(), a_index, with_further_unknown());
  const auto at = problem->evaluator(), nearby = problem->evaluator();
  const Vector x{{0.9, 0.3, 0.7, 0.8}}, p{{0.0, 0.4}};
  REQUIRE(at->move_to(x, p, Needs::jacobian) == Evaluated::ok);
  const double h = 1e-6;
  const auto difference = [&](const Vector& dx, const Vector& dp) {
    Vector result(4);
    nearby->move_to(x + h * dx, p + h * dp, Needs::residual);
    result = nearby->residual();
    nearby->move_to(x - h * dx, p - h * dp, Needs::residual);
    return Vector((result - nearby->residual()) / (2 * h));
  };
  Vector found(4);
  for (int i = 0; i < 4; ++i) {
    apply(at->jacobian(), Vector::Unit(4, i), found);
    CHECK((found - difference(Vector::Unit(4, i), Vector::Zero(2))).norm() < 1e-8);
  }
  at->parameter_derivative(b_index, found);
  const Vector by_b = found;
  CHECK((by_b - difference(Vector::Zero(4), Vector::Unit(2, 1))).norm() < 1e-8);
  at->parameter_derivative(a_index, found);
  CHECK(found.isZero(0));  // it is an unknown

  Borders borders(4, 1);
  borders.columns.col(0) = by_b;
  borders.rows.col(0) << 0.2, -0.4, 0.5, 0.7;
  borders.corner(0, 0) = 0.6;
  const auto solver = problem->linear_solver();
  REQUIRE(solver->factorize(at->jacobian(), borders));
  const Vector right{{0.3, -0.2, 0.9, 0.4, 0.1}};
  Vector solution = right;
  solver->solve(solution);
  Vector product(5);
  apply(at->jacobian(), solution.head(4), product.head(4));
  product.head(4) += solution[4] * by_b;
  product[4] = borders.rows.col(0).dot(solution.head(4)) + 0.6 * solution[4];
  CHECK((product - right).norm() < 1e-8);
}

TEST_CASE("a curve of zeros ends where its test function jumps, and passes a kink of it") {
  const auto piece = [](In, In p) { return std::uint64_t{p[1] > 0.5}; };
  const auto jumping = test_function_zeros(
      surface(piece), a_index, one([](In u, In p) { return test_function(u) + (p[1] > 0.5 ? 0.1 : 0); }));
  const Branch ended = curve(jumping, start_of(*jumping), 1, window(-2, 1.5));
  CHECK(ended.stop.reason == StopReason::step_too_small);
  for (const Point& point : ended.points) CHECK(std::abs(point.u[2] - a_of(point.parameter)) < 1e-9);
  CHECK(ended.points.back().parameter <= 0.5);
  CHECK(ended.points.back().parameter > 0.5 - 1e-8);

  const auto bent =
      test_function_zeros(surface(piece), a_index,
                          one([](In u, In p) { return test_function(u) + 0.3 * std::max(0.0, p[1] - 0.5); }));
  const Branch passed = curve(bent, start_of(*bent), 1, window(-2, 1.5));
  CHECK(passed.stop.reason == StopReason::boundary);
  for (const Point& point : passed.points) {
    const double above = 0.3 * std::max(0.0, point.parameter - 0.5);
    CHECK(std::abs(test_function(point.u) + above) < 1e-10);
  }
}

TEST_CASE("a curve of zeros ends where its test function is not known") {
  const auto problem = test_function_zeros(
      surface(), a_index, one([](In u, In p) { return p[1] > 0.7 ? std::nan("") : test_function(u); }));
  const Branch ended = curve(problem, start_of(*problem), 1, window(-2, 1.5));
  CHECK(ended.stop.reason == StopReason::not_evaluated);
  CHECK(ended.points.back().parameter > 0.69);
}

TEST_CASE("further unknowns without a positive scale are refused, and parameters that there are not") {
  auto functions = with_further_unknown();
  functions.scales[0] = 0;
  CHECK_THROWS_AS(test_function_zeros(surface(), a_index, functions), std::invalid_argument);
  CHECK_THROWS_AS(test_function_zeros(surface(), 2, with_further_unknown()), std::out_of_range);
}
