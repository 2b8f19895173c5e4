#include "catch.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/branch_point.hpp>

#include <Eigen/Dense>

#include <numbers>

using namespace problems;

namespace {

using Type = BranchPoint::Type;
constexpr int lambda = 0;

// The normal forms (lambda - c^2) u - u^2 and - u^3, imperfect by epsilon, of an amplitude.
struct NormalForm {
  int power = 3;
  double value(double u, In p) const { return (p[0] - p[2] * p[2]) * u - std::pow(u, power) + p[1]; }
  double slope(double u, In p) const { return p[0] - p[2] * p[2] - power * std::pow(u, power - 1); }
};

std::vector<Parameter> normal_form_parameters() {
  return {parameter("lambda", 0), parameter("epsilon", 0), parameter("c", 0)};
}

std::shared_ptr<const Problem> normal_form(int power) {
  const NormalForm f{power};
  return from_functions(
      1, normal_form_parameters(), [=](In u, In p, Out F) { F[0] = f.value(u[0], p); },
      [=](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = f.slope(u[0], p); });
}

// The normal form of y_0 with stable unknowns y_i that follow it, y_i = y_0^2 + sin(i) lambda, in the
// coordinates u = T y + shift, its equations mixed by S.
struct Embedded {
  int n, power;
  Matrix T, S, T_inverse;
  Vector shift;

  Embedded(int size, int k) : n(size), power(k) {
    std::srand(7u + static_cast<unsigned>(n));
    T = Matrix::Random(n, n) / std::sqrt(n) + Matrix::Identity(n, n);
    S = Matrix::Random(n, n) / std::sqrt(n) + Matrix::Identity(n, n);
    T_inverse = T.inverse();
    shift = Vector::Random(n);
  }
  std::shared_ptr<const Problem> problem() const {
    const Embedded e = *this;
    const NormalForm f{power};
    return from_functions(
        n, normal_form_parameters(),
        [=](In u, In p, Out F) {
          const Vector y = e.T_inverse * (u - e.shift);
          Vector f_y(e.n);
          f_y[0] = f.value(y[0], p);
          for (int i = 1; i < e.n; ++i) f_y[i] = y[0] * y[0] + std::sin(i) * p[0] - y[i];
          F = e.S * f_y;
        },
        [=](In u, In p, Eigen::Ref<Matrix> J) {
          const Vector y = e.T_inverse * (u - e.shift);
          Matrix J_y = -Matrix::Identity(e.n, e.n);
          J_y.col(0).setConstant(2 * y[0]);
          J_y(0, 0) = f.slope(y[0], p);
          J = e.S * J_y * e.T_inverse;
        },
        [=](In u, In p, int k, Out dF) {
          const Vector y = e.T_inverse * (u - e.shift);
          Vector f_y = Vector::Zero(e.n);
          f_y[0] = k == 0 ? y[0] : k == 1 ? 1 : -2 * p[2] * y[0];
          for (int i = 1; i < e.n && k == 0; ++i) f_y[i] = std::sin(i);
          dF = e.S * f_y;
        });
  }
  // d(u, lambda) of dy_0 and dlambda, at y_0 = 0, of length 1.
  Vector tangent(double dy, double dlambda) const {
    Vector y(n);
    y[0] = dy;
    for (int i = 1; i < n; ++i) y[i] = std::sin(i) * dlambda;
    Vector t(n + 1);
    t << T * y, dlambda;
    return t.normalized();
  }
  // On the branch y_0 = 0, u at lambda.
  Vector trivial(double at) const {
    Vector y(n);
    y[0] = 0;
    for (int i = 1; i < n; ++i) y[i] = std::sin(i) * at;
    return T * y + shift;
  }
};

Vector join(const Vector& u, double p) {
  Vector x(u.size() + 1);
  x << u, p;
  return x;
}

// A solver without transposed solves.
class ForwardOnly final : public LinearSolver {
 public:
  const char* name() const override { return "dense LU without transpose"; }
  bool factorize(const Jacobian& J, const Borders& borders) override { return lu_->factorize(J, borders); }
  void solve(Out x) const override { lu_->solve(x); }
  std::optional<int> determinant_sign() const override { return lu_->determinant_sign(); }

 private:
  std::unique_ptr<LinearSolver> lu_ = dense_lu();
};

MakeLinearSolver forward_only() {
  return [] { return std::make_unique<ForwardOnly>(); };
}

std::optional<BranchPoint> describe(const Problem& problem, const std::optional<BranchPointLocation>& at,
                                    const Vector& tangent) {
  if (!at) return {};
  return describe_branch_point(problem, lambda, *at, tangent);
}

}  // namespace

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

TEST_CASE("an imperfect pitchfork is not a branch point, and its imperfection is told") {
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

    // Residuals beside v are those of the same equations.
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

TEST_CASE("block elimination solves the system of branch points, borders included, and knows its sign") {
  const Vector p = Vector{{0.0, 0.1, 0.4}};
  check_linear_system(Embedded(6, 3).problem(), p, 2);
  check_linear_system(Embedded(6, 3).problem(), p, 2, forward_only());
  check_linear_system(twice_differentiated(), Vector{{0.0, 0.7}}, 1);
}

TEST_CASE("second derivatives of the problem's own give the branch point without evaluations beside it") {
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
