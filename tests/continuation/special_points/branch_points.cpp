// Branch points located and described, at fixed other parameters.

#include "catch.hpp"

#include "continuation/special_points/branch_point_problems.hpp"

#include <numbers>

using namespace problems;

TEST_CASE("the branches of lambda u - u^2 cross at 0 in the directions (0, 1) and (1, 1)") {
  const auto problem = normal_form(2);
  const Vector p = Vector::Zero(3);
  for (const MakeLinearSolver& solver : {MakeLinearSolver{}, forward_only()})
    for (const Vector& guess : {Vector{{0.0, 1e-4}}, Vector{{1e-3, -2e-2}}, Vector{{0.1, 0.1}}}) {
      const auto at = locate_branch_point(problem, p, lambda, guess, solver);
      REQUIRE(at);
      CHECK(at->x.norm() < 1e-15);
      CHECK(std::abs(at->imperfection) < 1e-20);
      const auto point = describe(*problem, at, Vector{{0.1, 0.9}});
      REQUIRE(point);
      CHECK(point->type == Type::transcritical);
      CHECK((point->tangents[0] - Vector{{0.0, 1.0}}).norm() < 1e-10);
      CHECK((point->tangents[1] - Vector{{1.0, 1.0}}.normalized()).norm() < 1e-10);
      const auto other = describe(*problem, at, Vector{{-1.0, -1.0}});
      CHECK((other->tangents[0] - Vector{{-1.0, -1.0}}.normalized()).norm() < 1e-10);
    }
}

TEST_CASE("the branches of lambda u - u^3 cross at 0 in the directions (0, 1) and (1, 0)") {
  const auto problem = normal_form(3);
  for (const MakeLinearSolver& solver : {MakeLinearSolver{}, forward_only()}) {
    const auto at = locate_branch_point(problem, Vector::Zero(3), lambda, Vector{{0.0, 1e-2}}, solver);
    const auto point = describe(*problem, at, Vector{{0.0, -1.0}});
    REQUIRE(point);
    CHECK(at->x.norm() < 1e-15);
    CHECK(point->type == Type::pitchfork);
    CHECK((point->tangents[0] - Vector{{0.0, -1.0}}).norm() < 1e-10);
    CHECK(std::abs(point->tangents[1][1]) < 1e-10);
  }
}

TEST_CASE("a branch point among coupled unknowns is found from afar with the tangents of its normal form") {
  for (int n : {5, 12, 40})
    for (int power : {2, 3}) {
      const Embedded e(n, power);
      const auto problem = e.problem();
      const Vector p = Vector{{0.0, 0.0, 0.7}};  // lambda = c^2 at the branch point
      const double exact = 0.49;
      const Vector guess = join(e.trivial(exact), exact) + 1e-4 * Vector::Random(n + 1);
      const auto at = locate_branch_point(problem, p, lambda, guess);
      const auto point = describe(*problem, at, -e.tangent(0, 1));
      INFO("n = " << n << ", power " << power << ", imperfection " << (at ? at->imperfection : NAN)
                  << ", rounding " << (at ? at->rounding : NAN));
      REQUIRE(point);
      CHECK((at->x - join(e.trivial(exact), exact)).norm() < 1e-13 * n);
      CHECK(std::abs(at->imperfection) < 1e-15);
      CHECK(point->type == (power == 2 ? Type::transcritical : Type::pitchfork));
      CHECK((point->tangents[0] + e.tangent(0, 1)).norm() < 1e-10);
      const Vector other = power == 2 ? e.tangent(1, 1) : e.tangent(1, 0);
      const Vector& t = point->tangents[1];
      CHECK(std::min((t - other).norm(), (t + other).norm()) < 1e-10);
      const Vector w = e.S.transpose().inverse().col(0).normalized();
      CHECK(std::min((point->left_null - w).norm(), (point->left_null + w).norm()) < 1e-11);
    }
}

TEST_CASE("the branch points of u'' + lambda sin u lie at (2/h)^2 sin^2(k pi h/2), dense and sparse") {
  for (const bool sparse : {false, true})
    for (int n : {9, 60}) {
      Functions f = sparse ? rod(n) : dense(rod(n));
      f.scales = Vector::Ones(n);
      const auto problem = from_functions(f);
      const double h = 1.0 / (n + 1), pi = std::numbers::pi;
      for (int k : {1, 2, 3, 5}) {
        const double exact = std::pow(2 / h * std::sin(k * pi * h / 2), 2);
        const Vector guess = join(1e-5 * Vector::Random(n), exact * (1 + 1e-4));
        const auto at = locate_branch_point(problem, Vector::Zero(1), lambda, guess);
        const auto point = describe(*problem, at, join(Vector::Zero(n), 10.0));
        INFO("n = " << n << ", k = " << k << ", sparse " << sparse);
        REQUIRE(point);
        CHECK(std::abs(at->x[n] - exact) < 4 / (h * h) * 1e-14);
        CHECK(at->x.head(n).norm() < 1e-13);
        CHECK(point->type == Type::pitchfork);
        Vector mode(n + 1);
        for (int i = 0; i < n; ++i) mode[i] = std::sin(k * pi * h * (i + 1));
        mode[n] = 0;
        mode.normalize();
        CHECK((point->tangents[0] - join(Vector::Zero(n), 10.0)).norm() < 1e-9);
        CHECK(std::abs(std::abs(point->tangents[1].dot(mode)) - 1) < 1e-10);
      }
    }
}

TEST_CASE("Newton's method for branch points converges quadratically") {
  // sin(lambda - 1) v - v^2 e^u, v = u - 1: a branch point at (1, 1).
  const auto problem = from_functions(
      1, {parameter("lambda", 0)},
      [](In u, In p, Out F) {
        F[0] = std::sin(p[0] - 1) * (u[0] - 1) - std::pow(u[0] - 1, 2) * std::exp(u[0]);
      },
      [](In u, In p, Eigen::Ref<Matrix> J) {
        const double v = u[0] - 1;
        J(0, 0) = std::sin(p[0] - 1) - (2 * v + v * v) * std::exp(u[0]);
      },
      [](In u, In p, int, Out dF) { dF[0] = std::cos(p[0] - 1) * (u[0] - 1); });
  const auto equations = branch_points(problem, lambda, Vector::Ones(1));
  const auto at = equations->evaluator();
  const auto solver = equations->linear_solver();
  Vector v{{1.02, 1.03, 0.0}};
  std::vector<double> errors;
  for (int k = 0; k < 4; ++k) {
    REQUIRE(at->move_to(v, Vector::Zero(1), Needs::jacobian) == Evaluated::ok);
    REQUIRE(solver->factorize(at->jacobian(), Borders(3, 0)));
    Vector dv = -at->residual();
    solver->solve(dv);
    v += dv;
    errors.push_back((v - Vector{{1.0, 1.0, 0.0}}).norm());
  }
  CHECK(errors[0] < 1e-2);
  CHECK(errors[1] < 10 * errors[0] * errors[0]);
  CHECK(errors[2] < 10 * errors[1] * errors[1]);
  CHECK(errors[3] < 1e-15);
}

TEST_CASE("an imperfect pitchfork is not a branch point, and its imperfection is reported") {
  for (int power : {2, 3})
    for (double epsilon : {1e-2, 1e-4, -1e-6, 1e-8}) {
      const auto problem = normal_form(power);
      const Vector p = Vector{{0.0, epsilon, 0.0}};
      const auto at = locate_branch_point(problem, p, lambda, Vector{{1e-3, 1e-3}});
      INFO("power " << power << ", epsilon " << epsilon);
      REQUIRE(at);
      CHECK(at->imperfection * at->unfolding[0] == Approx(-epsilon).epsilon(1e-12));
      CHECK_FALSE(at->branches_cross());
      CHECK_FALSE(describe(*problem, at, Vector{{0.0, 1.0}}));
    }
  const Embedded e(12, 3);
  for (double epsilon : {1e-4, 1e-8, 1e-10, 1e-12}) {
    const Vector p = Vector{{0.0, epsilon, 0.0}};
    const auto at = locate_branch_point(e.problem(), p, lambda, join(e.trivial(0), 1e-4));
    REQUIRE(at);
    CHECK_FALSE(at->branches_cross());
    CHECK_FALSE(describe(*e.problem(), at, e.tangent(0, 1)));
  }
}

TEST_CASE("folds and regular points are not branch points") {
  const auto fold = from_functions(1, {parameter("lambda", 0)},
                                   [](In u, In p, Out F) { F[0] = p[0] - u[0] * u[0] + std::pow(u[0], 3); });
  CHECK_FALSE(
      describe(*fold, locate_branch_point(fold, Vector::Zero(1), 0, Vector{{0.0, 0.0}}), Vector{{1.0, 0.0}}));
  CHECK_FALSE(describe(*fold, locate_branch_point(fold, Vector::Zero(1), 0, Vector{{1e-4, 1e-5}}),
                       Vector{{1.0, 0.0}}));
  const auto linear = from_functions(2, {parameter("lambda", 0)}, [](In u, In p, Out F) {
    F[0] = u[0] - p[0];
    F[1] = u[1] + u[0];
  });
  CHECK_FALSE(locate_branch_point(linear, Vector::Zero(1), 0, Vector::Zero(3)));
  const Vector p = Vector{{0.0, 1.0}};
  for (double x : {-std::sqrt(1.0 / 3), std::sqrt(1.0 / 3), 0.9, 2.0}) {
    const double mu = std::pow(x, 3) - x;
    CHECK_FALSE(describe(*cusp(), locate_branch_point(cusp(), p, 0, Vector{{x, mu}}), Vector{{1.0, 0.0}}));
  }
  const auto bratu = chan(21);
  CHECK_FALSE(describe(*bratu,
                       locate_branch_point(bratu, Vector::Zero(1), 0, join(Vector::Constant(21, 0.5), 1)),
                       join(Vector::Zero(21), 1)));
}

TEST_CASE("isolated points, tacnodes and double branch points have no pair of tangents") {
  const auto isolated = from_functions(
      1, {parameter("lambda", 0)}, [](In u, In p, Out F) { F[0] = u[0] * u[0] + p[0] * p[0]; },
      [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = 2 * u[0]; },
      [](In, In p, int, Out dF) { dF[0] = 2 * p[0]; });
  const auto at = locate_branch_point(isolated, Vector::Zero(1), 0, Vector{{1e-4, 1e-4}});
  REQUIRE(at);
  CHECK(at->x.norm() < 1e-15);
  CHECK(at->branches_cross());
  CHECK_FALSE(describe_branch_point(*isolated, 0, *at, Vector{{0.0, 1.0}}));

  // u (u - lambda^2): the branches touch.
  const auto tacnode = from_functions(
      1, {parameter("lambda", 0)}, [](In u, In p, Out F) { F[0] = u[0] * (u[0] - p[0] * p[0]); },
      [](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = 2 * u[0] - p[0] * p[0]; },
      [](In u, In p, int, Out dF) { dF[0] = -2 * p[0] * u[0]; });
  for (double distance : {0.0, 1e-4})
    CHECK_FALSE(describe(*tacnode, locate_branch_point(tacnode, Vector::Zero(1), 0, Vector{{0.0, distance}}),
                         Vector{{0.0, 1.0}}));

  const auto twice = from_functions(2, {parameter("lambda", 0)}, [](In u, In p, Out F) {
    F[0] = p[0] * u[0] - std::pow(u[0], 3);
    F[1] = p[0] * u[1] - std::pow(u[1], 3) + u[0] * u[0] * u[1] / 2;
  });
  for (double distance : {0.0, 1e-6, 1e-4})
    CHECK_FALSE(describe(*twice, locate_branch_point(twice, Vector::Zero(1), 0, Vector{{0.0, 0.0, distance}}),
                         Vector{{0.0, 0.0, 1.0}}));
}
