#include "catch.hpp"

#include "continuation/events/hopf_problems.hpp"

#include <Eigen/LU>

#include <arcslip/continuation/events/hopf.hpp>

#include <algorithm>
#include <numbers>

using namespace problems;

namespace {

// u' = M(p) u, whose branch u = 0 has the eigenvalues of M.
std::shared_ptr<const Problem> linear(int n, std::function<void(double p, Eigen::Ref<Matrix> M)> fill) {
  return from_functions(
      n, {parameter("p", 0)},
      [=](In u, In p, Out F) {
        Matrix M = Matrix::Zero(n, n);
        fill(p[0], M);
        F = M * u;
      },
      [=](In, In p, Eigen::Ref<Matrix> M) {
        M.setZero();
        fill(p[0], M);
      });
}

void pair(Eigen::Ref<Matrix> M, int at, double real, double imaginary) {
  M.block(at, at, 2, 2) << real, -imaginary, imaginary, real;
}

Branch along_zero(const std::shared_ptr<const Problem>& problem, double from, double to, double step = 0) {
  Options options = window(from, to);
  options.step.largest_parameter = step;
  options.step.initial = step;
  Branch branch =
      trace(problem, {Vector::Zero(problem->size()), Vector{{from}}, 0, 1}, options, hopf_monitors(*problem));
  REQUIRE(branch.stop.reason == StopReason::boundary);
  return branch;
}

}  // namespace

TEST_CASE("the ab problem has one Hopf point, at 0.1309000448, and its neutral saddle is none") {
  auto monitors = hopf_monitors(*ab());
  monitors.push_back(fold_monitor());
  const Branch branch =
      trace(ab(), {Vector::Zero(2), Vector{{0.0, 14.0, 2.0}}, 0, 1}, window(0, 0.2), monitors);
  REQUIRE(branch.stop.reason == StopReason::boundary);
  const auto folds = events_named(branch, "fold"), hopfs = events_named(branch, "hopf");
  REQUIRE(folds.size() == 2);
  CHECK(std::abs(folds[0].point.parameter - 0.105739) < 5e-7);
  CHECK(std::abs(folds[1].point.parameter - 0.08893185) < 5e-9);
  REQUIRE(hopfs.size() == 1);
  CHECK(std::abs(hopfs[0].point.parameter - 0.1309000448) < 5e-11);
  CHECK(std::abs(hopfs[0].value) < 1e-11);
}

TEST_CASE("the Brusselator's Hopf point is at B = 1 + A^2, with omega = A and its eigenvector") {
  for (double A : {0.5, 1.0, 2.0}) {
    const Branch branch = trace(brusselator(), {Vector{{A, 0.5 / A}}, Vector{{A, 0.5}}, 1, 1},
                                window(0.5, 2 + 2 * A * A), hopf_monitors(*brusselator()));
    CAPTURE(A);
    REQUIRE(branch.stop.reason == StopReason::boundary);
    REQUIRE(branch.events.size() == 1);
    const double B = 1 + A * A;
    CHECK(std::abs(branch.events[0].point.parameter - B) < 1e-11);
    const auto& hopf = std::get<Hopf>(branch.events[0].data);
    CHECK(std::abs(hopf.frequency - A) < 1e-11);
    const Matrix J{{B - 1, A * A}, {-B, -A * A}};
    CHECK((J * hopf.real + A * hopf.imaginary).norm() < 1e-10);
    CHECK((J * hopf.imaginary - A * hopf.real).norm() < 1e-10);
    CHECK(std::abs(hopf.real.squaredNorm() + hopf.imaginary.squaredNorm() - 1) < 1e-14);
    CHECK(std::abs(hopf.real.dot(hopf.imaginary)) < 1e-14);
    CHECK(hopf.real.norm() >= hopf.imaginary.norm());
    CHECK(hopf.real.maxCoeff() == hopf.real.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("the Brusselator along a line has a Hopf point for each mode, where its closed form says") {
  const Line line;
  const double A = 2;
  const Branch branch = trace(line.problem(), {line.homogeneous(A, 4), Vector{{4.0, A}}, 0, 1},
                              window(4, line.B(5, A) + 0.01), hopf_monitors(*line.problem()));
  REQUIRE(branch.stop.reason == StopReason::boundary);
  REQUIRE(branch.events.size() == 5);
  for (int k = 1; k <= 5; ++k) {
    const Event& event = branch.events[static_cast<std::size_t>(k - 1)];
    CAPTURE(k);
    CHECK(std::abs(event.point.parameter - line.B(k, A)) < 1e-11);
    const auto& hopf = std::get<Hopf>(event.data);
    CHECK(std::abs(hopf.frequency - line.frequency(k, A)) < 1e-11);
    // a + ib is the mode in x, and in y, times a complex number each.
    const double share = k * std::numbers::pi / (line.nodes + 1);
    for (int i = 1; i < line.nodes; ++i)
      for (int of : {0, 1}) {
        const double ratio = std::sin(share * (i + 1)) / std::sin(share);
        CHECK(std::abs(hopf.real[2 * i + of] - ratio * hopf.real[of]) < 1e-10);
        CHECK(std::abs(hopf.imaginary[2 * i + of] - ratio * hopf.imaginary[of]) < 1e-10);
      }
  }
}

TEST_CASE("the Lorenz equations have their Hopf point at r = s (s + b + 3) / (s - b - 1)") {
  const double s = 10, b = 8.0 / 3, r = s * (s + b + 3) / (s - b - 1), x = std::sqrt(b);
  const Branch branch = trace(lorenz(), {Vector{{x, x, 1.0}}, Vector{{2.0, s, b}}, 0, 1}, window(2, 30),
                              hopf_monitors(*lorenz()));
  REQUIRE(branch.stop.reason == StopReason::boundary);
  REQUIRE(branch.events.size() == 1);
  CHECK(std::abs(branch.events[0].point.parameter - r) < 1e-10);
  CHECK(std::abs(std::get<Hopf>(branch.events[0].data).frequency - std::sqrt(b * (s + r))) < 1e-10);
}

TEST_CASE("a pair that turns real off the axis, and a real eigenvalue that crosses it, are no Hopf points") {
  // 1 +- sqrt(-p), with a stable pair next to.
  const auto turning = linear(4, [](double p, Eigen::Ref<Matrix> M) {
    M.block(0, 0, 2, 2) << 1, 1, -p, 1;
    pair(M, 2, -2, 3);
  });
  CHECK(along_zero(turning, -0.9, 1).events.empty());
  CHECK(along_zero(turning, -3, 1).events.empty());  // 0 at p = -1
}

TEST_CASE("a neutral saddle is no Hopf point, whether its eigenvalues lie next to others or not") {
  const auto saddle = linear(4, [](double p, Eigen::Ref<Matrix> M) {
    M(0, 0) = 1 + p;
    M(1, 1) = -1 + p;
    pair(M, 2, -2, 1);
  });
  CHECK(along_zero(saddle, -0.5, 0.5).events.empty());
}

TEST_CASE("pairs that cross within one step are found each, and a real eigenvalue next to them is not") {
  const auto crossing = linear(7, [](double p, Eigen::Ref<Matrix> M) {
    pair(M, 0, p - 0.01, 1);
    pair(M, 2, p - 0.02, 2);
    pair(M, 4, p - 0.03, 3);
    M(6, 6) = p - 0.015;
  });
  for (double step : {1e-3, 0.1, 0.5}) {
    const Branch branch = along_zero(crossing, -1, 1, step);
    CAPTURE(step, branch.points.size());
    REQUIRE(branch.events.size() == 3);
    for (int k = 1; k <= 3; ++k) {
      const Event& event = branch.events[static_cast<std::size_t>(k - 1)];
      CHECK(std::abs(event.point.parameter - 0.01 * k) < 1e-12);
      CHECK(std::abs(std::get<Hopf>(event.data).frequency - k) < 1e-12);
    }
  }
}

TEST_CASE("a pair that becomes unstable and one that becomes stable later are found each") {
  const auto crossing = linear(4, [](double p, Eigen::Ref<Matrix> M) {
    pair(M, 0, p + 0.3, 1);
    pair(M, 2, 0.3 - p, 2);
  });
  const Branch branch = along_zero(crossing, -1, 1);
  REQUIRE(branch.events.size() == 2);
  CHECK(std::abs(branch.events[0].point.parameter + 0.3) < 1e-12);
  CHECK(std::get<Hopf>(branch.events[0].data).frequency == Approx(1).epsilon(1e-12));
  CHECK(std::abs(branch.events[1].point.parameter - 0.3) < 1e-12);
  CHECK(std::get<Hopf>(branch.events[1].data).frequency == Approx(2).epsilon(1e-12));
}

TEST_CASE("two equal pairs that cross at one place are two Hopf points") {
  const auto twice = linear(4, [](double p, Eigen::Ref<Matrix> M) {
    pair(M, 0, p, 1);
    pair(M, 2, p, 1);
  });
  const Branch branch = along_zero(twice, -0.7, 1);
  REQUIRE(branch.events.size() == 2);
  CHECK(std::abs(branch.events[0].point.parameter) < 1e-12);
}

TEST_CASE("a pair that jumps across the axis at a kink is a nonsmooth event, a real eigenvalue is none") {
  for (bool complex : {true, false}) {
    Functions f;
    f.size = 2;
    f.parameters = {parameter("p", 0)};
    const auto fill = [=](double p, Eigen::Ref<Matrix> M) {
      if (complex)
        pair(M, 0, p < 0.03 ? p - 0.5 : p + 0.5, 1);
      else
        M << (p < 0.03 ? p - 0.5 : p + 0.5), 0, 0, -1;
    };
    f.residual = [=](In u, In p, Out F) {
      Matrix M(2, 2);
      fill(p[0], M);
      F = M * u;
    };
    f.jacobian = [=](In, In p, Eigen::Ref<Matrix> M) { fill(p[0], M); };
    f.piece = [](In, In p) { return p[0] < 0.03 ? 0u : 1u; };
    const Branch branch = along_zero(from_functions(f), -0.2, 0.2);
    CAPTURE(complex);
    REQUIRE(branch.events.size() == (complex ? 1 : 0));
    if (!complex) continue;
    CHECK(branch.events[0].nonsmooth);
    CHECK(std::abs(branch.events[0].point.parameter - 0.03) < 1e-11);
    CHECK(std::holds_alternative<std::monostate>(branch.events[0].data));
  }
}

TEST_CASE("Hopf points are refused where not all eigenvalues can be computed") {
  const auto large =
      from_functions(largest_spectrum + 1, {parameter("p", 0)}, [](In u, In p, Out F) { F = u * p[0]; });
  REQUIRE_THROWS_AS(hopf_monitors(*large), std::invalid_argument);
  Functions f;
  f.size = 1;
  f.parameters = {parameter("p", 0)};
  f.residual = [](In u, In p, Out F) { F[0] = u[0] - p[0]; };
  f.apply_jacobian = [](In, In, In x, Out y) { y = x; };
  const auto applied = from_functions(f);
  Matrix dense;
  REQUIRE_THROWS_AS(to_dense(applied->evaluator()->jacobian(), dense), std::invalid_argument);
}

TEST_CASE("two pairs that cross at one parameter are two events, each with its frequency and its vector") {
  // Blocks [p -w; w p] and [2p -v; v 2p], mixed by a similarity, with frequencies apart or equal.
  for (const double v : {2.5, 1.0})
    for (const double rate : {2.0, 1.0}) {
      Matrix S = Matrix::Identity(4, 4);
      S(0, 2) = 0.3, S(1, 3) = -0.2, S(3, 0) = 0.1;
      const Matrix inverse = S.inverse();
      const auto jacobian = [=](double p) {
        Matrix A = Matrix::Zero(4, 4);
        A.topLeftCorner(2, 2) << p, -1, 1, p;
        A.bottomRightCorner(2, 2) << rate * p, -v, v, rate * p;
        return Matrix(S * A * inverse);
      };
      const auto problem = from_functions(
          4, {parameter("p", -1)}, [=](In u, In p, Out F) { F = jacobian(p[0]) * u; },
          [=](In, In p, Eigen::Ref<Matrix> J) { J = jacobian(p[0]); });
      const Branch branch = along_zero(problem, -0.913, 1, 0.31);
      CAPTURE(v, rate);
      REQUIRE(branch.events.size() == 2);
      std::vector<double> frequencies;
      for (const Event& event : branch.events) {
        CHECK(std::abs(event.point.parameter) < 1e-11);
        const auto& hopf = std::get<Hopf>(event.data);
        const Matrix J = jacobian(event.point.parameter);
        CHECK((J * hopf.real + hopf.frequency * hopf.imaginary).norm() < 1e-10);
        CHECK((J * hopf.imaginary - hopf.frequency * hopf.real).norm() < 1e-10);
        frequencies.push_back(hopf.frequency);
      }
      std::sort(frequencies.begin(), frequencies.end());
      CHECK(frequencies[0] == Approx(1).epsilon(1e-11));
      CHECK(frequencies[1] == Approx(v).epsilon(1e-11));
    }
}
