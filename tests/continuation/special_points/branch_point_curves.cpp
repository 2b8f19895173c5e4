// The equations of branch points, and curves of them in two parameters.

#include "catch.hpp"

#include "continuation/special_points/branch_point_problems.hpp"

#include <numbers>

using namespace problems;

namespace {

// (lambda - c^2) u_0 - u_0^3, c u_0^2 + lambda - u_1, with second derivatives.
std::shared_ptr<const Problem> twice_differentiated() {
  Functions f;
  f.size = 2;
  f.parameters = {parameter("lambda", 0), parameter("c", 0)};
  f.residual = [](In u, In p, Out F) {
    F[0] = (p[0] - p[1] * p[1]) * u[0] - std::pow(u[0], 3);
    F[1] = p[1] * u[0] * u[0] + p[0] - u[1];
  };
  f.jacobian = [](In u, In p, Eigen::Ref<Matrix> J) {
    J << p[0] - p[1] * p[1] - 3 * u[0] * u[0], 0, 2 * p[1] * u[0], -1;
  };
  f.derivative = [](In u, In p, int k, Out dF) {
    dF = k == 0 ? Vector{{u[0], 1.0}} : Vector{{-2 * p[1] * u[0], u[0] * u[0]}};
  };
  f.second = [](In u, In p, In w, In v, In q, Out du, Out dp) {
    const double c = p[1];
    du << w[0] * (-6 * u[0] * v[0] + q[0] - 2 * c * q[1]) + w[1] * (2 * c * v[0] + 2 * u[0] * q[1]), 0;
    dp << w[0] * v[0], w[0] * (-2 * c * v[0] - 2 * u[0] * q[1]) + w[1] * 2 * u[0] * v[0];
  };
  return from_functions(f);
}

// The linear system of branch points over parameter k against differences of its residuals, at random places.
void check_linear_system(const std::shared_ptr<const Problem>& inner, const Vector& p, int k,
                         const MakeLinearSolver& make_solver = {}) {
  const int n = inner->size(), N = n + 2, m = 2;
  for (int seed : {1, 2, 3, 4, 5}) {
    std::srand(static_cast<unsigned>(seed));
    const auto problem = branch_points(inner, lambda, Vector::Random(n), make_solver);
    const auto at = problem->evaluator();
    const auto solver = problem->linear_solver();
    const Vector v = Vector::Random(N);
    REQUIRE(at->move_to(v, p, Needs::jacobian) == Evaluated::ok);
    Borders borders(N, m);
    borders.columns.setRandom();
    borders.rows.setRandom();
    borders.corner.setRandom();
    REQUIRE(solver->factorize(at->jacobian(), borders));
    const Vector right = Vector::Random(N + m);
    Vector x = right, product(N), dR(N);
    solver->solve(x);
    apply(at->jacobian(), x.head(N), product);
    at->parameter_derivative(k, dR);
    const auto sign = solver->determinant_sign();
    REQUIRE(sign);

    // Residuals next to v are those of the same equations.
    const double h = 1e-5;
    const auto residual = [&](const Vector& where, const Vector& parameters) {
      REQUIRE(at->move_to(where, parameters, Needs::residual) == Evaluated::ok);
      return at->residual();
    };
    Matrix K(N + m, N + m);
    K << Matrix::Zero(N, N), borders.columns, borders.rows.transpose(), borders.corner;
    for (int j = 0; j < N; ++j) {
      const Vector d = h * Vector::Unit(N, j);
      K.col(j).head(N) = (residual(v + d, p) - residual(v - d, p)) / (2 * h);
    }
    const Vector dp = h * Vector::Unit(p.size(), k);
    const Vector by_parameter = (residual(v, p + dp) - residual(v, p - dp)) / (2 * h);
    INFO("seed " << seed << ", condition " << K.norm() * K.inverse().norm());
    CHECK((K * x - right).norm() < 1e-7 * K.norm() * x.norm());
    CHECK((product - K.topLeftCorner(N, N) * x.head(N)).norm() < 1e-7 * K.norm() * x.norm());
    CHECK((dR - by_parameter).norm() < 1e-7 * K.norm());
    CHECK(*sign == (K.determinant() > 0 ? 1 : -1));
  }
}

}  // namespace

TEST_CASE("block elimination solves the system of branch points, borders included, and knows its sign") {
  const Vector p = Vector{{0.0, 0.1, 0.4}};
  check_linear_system(Embedded(6, 3).problem(), p, 2);
  check_linear_system(Embedded(6, 3).problem(), p, 2, forward_only());
  check_linear_system(twice_differentiated(), Vector{{0.0, 0.7}}, 1);
}

TEST_CASE("second derivatives of the problem's own give the branch point without evaluations next to it") {
  int evaluations = 0;
  Functions f;
  f.size = 1;
  f.parameters = {parameter("lambda", 0)};
  f.residual = [](In u, In p, Out F) { F[0] = p[0] * u[0] - u[0] * u[0]; };
  f.jacobian = [&](In u, In p, Eigen::Ref<Matrix> J) {
    ++evaluations;
    J(0, 0) = p[0] - 2 * u[0];
  };
  f.derivative = [](In u, In, int, Out dF) { dF[0] = u[0]; };
  f.second = [](In, In, In w, In v, In q, Out du, Out dp) {
    du[0] = w[0] * (-2 * v[0] + q[0]);
    dp[0] = w[0] * v[0];
  };
  const auto problem = from_functions(f);
  const auto at = locate_branch_point(problem, Vector::Zero(1), 0, Vector{{1e-4, 2e-4}});
  const auto point = describe(*problem, at, Vector{{0.0, 1.0}});
  REQUIRE(point);
  CHECK(evaluations == 4);  // one for the direction b_0, three for Newton
  CHECK((point->tangents[0] - Vector{{0.0, 1.0}}).norm() < 1e-14);
  CHECK((point->tangents[1] - Vector{{1.0, 1.0}}.normalized()).norm() < 1e-14);
}

TEST_CASE("a solver without transposed solves finds branch points among coupled unknowns") {
  const Embedded e(12, 2);
  const auto at = locate_branch_point(e.problem(), Vector::Zero(3), lambda,
                                      join(e.trivial(0), 0) + 1e-4 * Vector::Random(13), forward_only());
  const auto point = describe(*e.problem(), at, e.tangent(0, 1));
  REQUIRE(point);
  CHECK((at->x - join(e.trivial(0), 0)).norm() < 1e-12);
  CHECK((point->tangents[0] - e.tangent(0, 1)).norm() < 1e-9);
  CHECK((point->tangents[1] - e.tangent(1, 1)).norm() < 1e-9);
  CHECK(point->left_null.size() == 0);
}

TEST_CASE("the branch points of (lambda - c^2) u - u^3 lie on lambda = c^2 without imperfection") {
  constexpr int c = 2;
  for (const MakeLinearSolver& solver : {MakeLinearSolver{}, forward_only()})
    for (int n : {1, 8}) {
      const Embedded e(n, 3);
      const auto problem = n == 1 ? normal_form(3) : e.problem();
      const auto exact = [&](double value) {
        return n == 1 ? Vector{{0.0, value * value}} : join(e.trivial(value * value), value * value);
      };
      const Vector p = Vector{{0.0, 0.0, -1.0}};
      const auto at =
          locate_branch_point(problem, p, lambda, exact(-1) + Vector::Constant(n + 1, 1e-4), solver);
      REQUIRE(at);
      const Branch curve = trace(branch_points(problem, lambda, at->unfolding, solver),
                                 {at->unknowns(), p, c, 1}, window(-1, 1.5));
      CHECK(curve.stop.reason == StopReason::boundary);
      CHECK(curve.points.size() > 20);
      for (const Point& point : curve.points) {
        CHECK((point.u.head(n + 1) - exact(point.parameter)).norm() < 1e-11);
        CHECK(std::abs(point.u[n + 1]) < 1e-13);
      }
      CHECK(curve.points.back().parameter == Approx(1.5).margin(1e-12));
    }
}

TEST_CASE("an imperfect transcritical bifurcation is followed to where its branches cross") {
  // (lambda - c^2) v - v^2 + c^2 - 1/4, v = u - c: J = 0 and F_lambda = 0 at v = 0, lambda = c^2, where
  // F = c^2 - 1/4.
  const auto problem = from_functions(
      1, {parameter("lambda", 0), parameter("c", 1)},
      [](In u, In p, Out F) {
        const double v = u[0] - p[1];
        F[0] = (p[0] - p[1] * p[1]) * v - v * v + p[1] * p[1] - 0.25;
      },
      [](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = p[0] - p[1] * p[1] - 2 * (u[0] - p[1]); },
      [](In u, In p, int k, Out dF) {
        const double v = u[0] - p[1];
        dF[0] = k == 0 ? v : -2 * p[1] * v - (p[0] - p[1] * p[1]) + 2 * v + 2 * p[1];
      });
  const Vector p = Vector{{0.0, 1.0}};
  const auto at = locate_branch_point(problem, p, 0, Vector{{1.01, 0.99}});
  REQUIRE(at);
  CHECK_FALSE(at->branches_cross());
  CHECK(at->imperfection * at->unfolding[0] == Approx(-0.75).epsilon(1e-12));
  const Monitor perfect{"perfect", [](const Accepted& now) { return now.u[2]; }};
  const Branch curve =
      trace(branch_points(problem, 0, at->unfolding), {at->unknowns(), p, 1, -1}, window(-1, 1.2), {perfect});
  REQUIRE(curve.stop.reason == StopReason::boundary);
  for (const Point& point : curve.points) {
    const double c = point.parameter;
    CHECK(std::abs(point.u[0] - c) < 1e-11);
    CHECK(std::abs(point.u[1] - c * c) < 1e-11);
    CHECK(std::abs(point.u[2] * at->unfolding[0] + c * c - 0.25) < 1e-11);
  }
  const auto crossings = events_named(curve, "perfect");
  REQUIRE(crossings.size() == 2);
  for (const Event& event : crossings) {
    CHECK(std::abs(std::abs(event.point.parameter) - 0.5) < 1e-11);
    const Vector here = Vector{{0.0, std::copysign(0.5, event.point.parameter)}};
    const auto there = locate_branch_point(problem, here, 0, event.point.u.head(2));
    const auto point = describe(*problem, there, Vector{{0.0, 1.0}});
    REQUIRE(point);
    CHECK((point->tangents[1] - Vector{{1.0, 1.0}}.normalized()).norm() < 1e-9);
  }
}

TEST_CASE("branch points of a sparse problem are followed by KLU along their straight line") {
  const int n = 40;
  const double h = 1.0 / (n + 1);
  const auto problem = from_functions(rod(n, true));
  const double exact = std::pow(2 / h * std::sin(std::numbers::pi * h), 2);
  const Vector p = Vector::Zero(2);
  const auto at = locate_branch_point(problem, p, 0, join(1e-6 * Vector::Random(n), exact + 0.01));
  REQUIRE(at);
  const Branch curve =
      trace(branch_points(problem, 0, at->unfolding), {at->unknowns(), p, 1, 1}, window(0, 30));
  REQUIRE(curve.stop.reason == StopReason::boundary);
  for (const Point& point : curve.points) {
    CHECK(std::abs(point.u[n] - (exact - point.parameter)) < 1e-9);
    CHECK(point.u.head(n).norm() < 1e-12);
    CHECK(std::abs(point.u[n + 1]) < 1e-12);
  }
}

TEST_CASE("curves of branch points refuse what does not fit") {
  CHECK_THROWS_AS(branch_points(normal_form(3), 3, Vector::Ones(1)), std::out_of_range);
  CHECK_THROWS_AS(branch_points(normal_form(3), -1, Vector::Ones(1)), std::out_of_range);
  CHECK_THROWS_AS(branch_points(normal_form(3), 0, Vector::Ones(2)), std::invalid_argument);
  CHECK_THROWS_AS(null_space(*normal_form(3)->evaluator()), std::invalid_argument);
  // b_0 orthogonal to the left null vector unfolds nothing.
  const auto problem = from_functions(2, {parameter("lambda", 0), parameter("c", 0)}, [](In u, In p, Out F) {
    F[0] = p[0] * u[0] - std::pow(u[0], 3);
    F[1] = u[1] - p[0];
  });
  const Branch curve = trace(branch_points(problem, 0, Vector{{0.0, 1.0}}),
                             {Vector{{1e-3, 1e-3, 1e-3, 0.0}}, Vector::Zero(2), 1, 1}, window(-1, 1));
  CHECK(curve.stop.reason != StopReason::boundary);
}
