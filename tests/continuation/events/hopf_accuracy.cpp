// How accurate Hopf points are: 1e-12 relative with an exact J, 1e-8 with default differences.

#include "catch.hpp"

#include "continuation/events/hopf_problems.hpp"

#include <arcslip/continuation/events/hopf.hpp>
#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <algorithm>

using namespace problems;

namespace {

double promised(bool exact) {
  return exact ? 1e-12 : 1e-8;
}

// A problem without its derivatives.
std::shared_ptr<const Problem> without_jacobian(const std::shared_ptr<const Problem>& problem) {
  const auto all = problem->parameters();
  return from_functions(problem->size(), {all.begin(), all.end()}, [problem](In u, In p, Out F) {
    const auto at = problem->evaluator();
    at->move_to(u, p, Needs::residual);
    F = at->residual();
  });
}

// The columns of neurons of Jansen and Rit (1995), as Grimbert and Faugeras (2006) follow them over p, whose
// Hopf points they print as 89.83 and 315.70.
std::shared_ptr<const Problem> jansen_rit(bool exact, bool scaled) {
  const double A = 3.25, B = 22, a = 100, b = 50, C = 135;
  const auto S = [](double v) { return 5 / (1 + std::exp(0.56 * (6 - v))); };
  const auto dS = [=](double v) { return 0.56 * S(v) * (1 - S(v) / 5); };
  Functions f;
  f.size = 6;
  f.parameters = {{"p", "1/s"}};
  f.residual = [=](In y, In p, Out F) {
    F << y[3], y[4], y[5], A * a * S(y[1] - y[2]) - 2 * a * y[3] - a * a * y[0],
        A * a * (p[0] + 0.8 * C * S(C * y[0])) - 2 * a * y[4] - a * a * y[1],
        B * b * 0.25 * C * S(0.25 * C * y[0]) - 2 * b * y[5] - b * b * y[2];
  };
  if (exact)
    f.jacobian = [=](In y, In, Eigen::Ref<Matrix> J) {
      J.setZero();
      J.topRightCorner(3, 3).setIdentity();
      const double d = A * a * dS(y[1] - y[2]);
      J.row(3) << -a * a, d, -d, -2 * a, 0, 0;
      J.row(4) << A * a * 0.8 * C * C * dS(C * y[0]), -a * a, 0, 0, -2 * a, 0;
      J.row(5) << B * b * 0.0625 * C * C * dS(0.25 * C * y[0]), 0, -b * b, 0, 0, -2 * b;
    };
  if (scaled) f.scales = Vector{{0.1, 20, 20, 1, 100, 100}};
  return from_functions(std::move(f));
}

}  // namespace

TEST_CASE("the Hopf points of Jansen and Rit's columns are those of 40 digits") {
  const double exact_points[] = {-12.147492348419, 89.829107969643, 315.69642806882};  // mpmath
  for (const bool exact : {true, false})
    for (const bool scaled : {true, false}) {
      const auto problem = jansen_rit(exact, scaled);
      const Branch branch = trace(problem, {.u = Vector::Zero(6), .p = Vector{{0.0}}}, window(-50, 400),
                                  hopf_monitors(*problem));
      CAPTURE(exact, scaled, branch.stop.message);
      CHECK(branch.warnings.empty());
      REQUIRE(branch.events.size() == 3);
      for (std::size_t k = 0; k < 3; ++k)
        CHECK(std::abs(branch.events[k].point.parameter / exact_points[k] - 1) < promised(exact));
    }
}

TEST_CASE("the Brusselator's Hopf points B = 1 + A^2, omega = A are as accurate as they are said to be") {
  for (const bool exact : {true, false})
    for (const double A : {0.03, 0.5, 1.0, 2.0, 30.0}) {
      const auto problem = exact ? brusselator() : without_jacobian(brusselator());
      const Branch branch = trace(problem, {Vector{{A, 0.5 / A}}, Vector{{A, 0.5}}, 1, 1},
                                  window(0.5, 2 + 2 * A * A), hopf_monitors(*problem));
      CAPTURE(exact, A, branch.stop.message);
      REQUIRE(branch.events.size() == 1);
      CHECK(std::abs(branch.events[0].point.parameter / (1 + A * A) - 1) < promised(exact));
      CHECK(std::abs(std::get<Hopf>(branch.events[0].data).frequency / A - 1) < promised(exact));
    }
}

TEST_CASE("the Hopf points of the Lorenz equations are as accurate as they are said to be") {
  for (const bool exact : {true, false})
    for (const double s : {6.0, 10.0, 16.0, 40.0}) {
      const double b = 8.0 / 3, r = s * (s + b + 3) / (s - b - 1), x = std::sqrt(b);
      const auto problem = exact ? lorenz() : without_jacobian(lorenz());
      const Branch branch = trace(problem, {Vector{{x, x, 1.0}}, Vector{{2.0, s, b}}, 0, 1}, window(2, 2 * r),
                                  hopf_monitors(*problem));
      CAPTURE(exact, s, branch.stop.message);
      REQUIRE(branch.events.size() == 1);
      CHECK(std::abs(branch.events[0].point.parameter / r - 1) < promised(exact));
      CHECK(std::abs(std::get<Hopf>(branch.events[0].data).frequency / std::sqrt(b * (s + r)) - 1) <
            promised(exact));
    }
}

TEST_CASE("unknowns of sizes from 1e-6 to 1e6 have the same Hopf point, with its eigenvector") {
  // the Brusselator in x / s, y s
  for (const bool exact : {true, false})
    for (const double s : {1e-6, 1e-3, 1e3, 1e6}) {
      const double A = 2, B = 1 + A * A;
      Functions f;
      f.size = 2;
      f.parameters = {{"B", ""}};
      f.scales = Vector{{s, 1 / s}};
      f.residual = [=](In u, In p, Out F) {
        const double x = u[0] / s, y = u[1] * s, x2y = x * x * y;
        F << s * (A - (p[0] + 1) * x + x2y), (p[0] * x - x2y) / s;
      };
      if (exact)
        f.jacobian = [=](In u, In p, Eigen::Ref<Matrix> J) {
          const double x = u[0] / s, y = u[1] * s;
          J << 2 * x * y - p[0] - 1, s * s * x * x, (p[0] - 2 * x * y) / (s * s), -x * x;
        };
      const auto problem = from_functions(std::move(f));
      const Start start{Vector{{A * s, 0.5 / A / s}}, Vector{{0.5}}, 0, 1};
      const Branch branch = trace(problem, start, window(0.5, 10), hopf_monitors(*problem));
      CAPTURE(exact, s, branch.stop.message);
      REQUIRE(branch.events.size() == 1);
      CHECK(std::abs(branch.events[0].point.parameter / B - 1) < promised(exact));
      const auto& hopf = std::get<Hopf>(branch.events[0].data);
      CHECK(std::abs(hopf.frequency / A - 1) < promised(exact));
      const Matrix J{{B - 1, s * s * A * A}, {-B / (s * s), -A * A}};
      const Vector scales{{s, 1 / s}};
      CHECK((J * hopf.real + A * hopf.imaginary).cwiseQuotient(scales).norm() < 1e-7);
      CHECK((J * hopf.imaginary - A * hopf.real).cwiseQuotient(scales).norm() < 1e-7);
    }
}

TEST_CASE("eigenvalues are those of the balanced matrix, whatever the units of its rows and columns") {
  // The companion matrix of (x - 1)(x - 2)(x - 3)(x - 4), in units of 2^(20 i).
  const Matrix companion{{0, 0, 0, -24}, {1, 0, 0, 50}, {0, 1, 0, -35}, {0, 0, 1, 10}};
  Vector units(4);
  for (int i = 0; i < 4; ++i) units[i] = std::ldexp(1.0, i % 2 == 0 ? 20 * i : -20 * i);
  const Matrix A = units.cwiseInverse().asDiagonal() * companion * units.asDiagonal();
  Eigen::VectorXcd values = eigenvalues(A);
  REQUIRE(values.size() == 4);
  std::sort(values.begin(), values.end(), [](auto a, auto b) { return a.real() < b.real(); });
  for (int i = 0; i < 4; ++i) CHECK(std::abs(values[i] - (i + 1.0)) < 1e-11);
  const Modes found = modes(A);
  for (int i = 0; i < 4; ++i) {
    const Eigen::VectorXcd v = units.asDiagonal() * found.V.col(i);
    CHECK((companion * v - found.values[i] * v).norm() < 1e-11 * v.norm());
  }
}
