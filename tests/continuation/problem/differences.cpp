// Derivatives that a problem is not given: within the pieces of F, and by steps that fit the parameter.

#include "catch.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/problem/jacobian_check.hpp>

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <random>

using namespace problems;

TEST_CASE("differences next to a corner are those of the piece, to 1e-8, at any distance from it") {
  // Of e^x - 1 below x = u + p = 0, and 3 sin x above.
  for (const bool number_of_its_own : {false, true}) {  // for x = 0 itself: as above
    Functions f;
    f.size = 1;
    f.parameters = {parameter("p", 0)};
    f.residual = [](In u, In p, Out F) {
      const double x = u[0] + p[0];
      F[0] = x < 0 ? std::expm1(x) : 3 * std::sin(x);
    };
    f.piece = [=](In u, In p) {
      const double x = u[0] + p[0];
      return number_of_its_own && x == 0 ? 7 : x < 0 ? 1 : 2;
    };
    const auto at = from_functions(f)->evaluator();
    Vector dF(1);
    for (const int side : {1, -1})
      for (const double distance : {0.0, 1e-12, 1e-9, 1e-7, 5e-6, 1e-5, 1e-3}) {
        if (number_of_its_own && distance == 0) continue;
        const double x = side * distance, u = x - 0.5;
        const double known = u + 0.5 < 0 ? std::exp(x) : 3 * std::cos(x);
        REQUIRE(at->move_to(Vector{{u}}, Vector{{0.5}}, Needs::jacobian) == Evaluated::ok);
        CAPTURE(side, distance, number_of_its_own);
        CHECK(std::abs(std::get<Matrix>(at->jacobian())(0, 0) - known) < 1e-8 * known);
        at->parameter_derivative(0, dF);
        CHECK(std::abs(dF[0] - known) < 1e-8 * known);
      }
    // In a piece without room J is that of what is around: here the mean of both slopes, as before.
    REQUIRE(at->move_to(Vector{{-0.5}}, Vector{{0.5}}, Needs::jacobian) == Evaluated::ok);
    CHECK(std::get<Matrix>(at->jacobian())(0, 0) == Approx(number_of_its_own ? 2 : 3).epsilon(1e-4));
  }
}

namespace {

// The spring of examples/nonsmooth: of slopes 1, -1/2, 1, 3 between its corners.
Functions snapping_spring(bool with_jacobian, double scale) {
  static constexpr std::array<double, 4> corner{0, 1, 2, 3}, force{0, 1, 0.5, 1.5}, slope{1, -0.5, 1, 3};
  const auto part = [](double e) { return std::size_t(e < 1 ? 0 : e < 2 ? 1 : e < 3 ? 2 : 3); };
  const double k = 4;
  Functions snap;
  snap.size = 2;
  snap.parameters = {{"p", "N", 0}};
  snap.residual = [=](In u, In p, Out F) {
    const double e = u[0] - u[1], f = force[part(e)] + slope[part(e)] * (e - corner[part(e)]);
    F[0] = f - p[0];
    F[1] = k * u[1] - f;
  };
  if (with_jacobian)
    snap.jacobian = [=](In u, In, Eigen::Ref<Matrix> J) {
      const double a = slope[part(u[0] - u[1])];
      J << a, -a, -a, k + a;
    };
  snap.piece = [=](In u, In) { return part(u[0] - u[1]); };
  snap.scales = Vector::Constant(2, scale);
  return snap;
}

double slope_of(const Vector& tangent) {
  return tangent[0] / tangent[tangent.size() - 1];
}

}  // namespace

TEST_CASE("the snapping spring has its three kinks and two nonsmooth folds without a Jacobian as with one") {
  // u_1 = e + p/k, du_1/dp = 1/f'(e) + 1/k at the corners of f.
  for (const bool with : {true, false})
    for (const double scale : {1.0, 1e-3}) {
      const auto problem = from_functions(snapping_spring(with, scale));
      const Branch branch = trace(problem, {.u = Vector::Zero(2), .p = Vector::Zero(1)},
                                  {.lower = -1, .upper = 2}, {fold_monitor(), kink_monitor()});
      CAPTURE(with, scale, branch.stop.message);
      CHECK(branch.stop.reason == StopReason::boundary);
      CHECK(branch.warnings.empty());
      const auto folds = events_named(branch, "fold"), kinks = events_named(branch, "kink");
      REQUIRE(folds.size() == 2);
      REQUIRE(kinks.size() == 3);
      for (std::size_t k = 0; k < 2; ++k) {
        CHECK(folds[k].nonsmooth);
        CHECK(std::abs(folds[k].point.parameter - (k == 0 ? 1 : 0.5)) < 1e-9);
      }
      const std::array<double, 4> compliance{1.25, -1.75, 1.25, 1 / 3.0 + 0.25};
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(std::abs(kinks[k].point.parameter - std::array{1.0, 0.5, 1.5}[k]) < 1e-9);
        const Kink& kink = std::get<Kink>(kinks[k].data);
        CHECK(slope_of(kink.before) == Approx(compliance[k]).epsilon(1e-7));
        CHECK(slope_of(kink.after) == Approx(compliance[k + 1]).epsilon(1e-7));
      }
    }
}

TEST_CASE("a steep corner is a nonsmooth fold at p = 1 without a Jacobian as with one") {
  for (const bool with : {true, false}) {
    Functions f;
    f.size = 1;
    f.parameters = {{"p", "", -1}};
    f.residual = [](In u, In p, Out F) { F[0] = std::min(u[0], 1 - 40 * (u[0] - 1)) - p[0]; };
    if (with) f.jacobian = [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = u[0] < 1 ? 1 : -40; };
    f.piece = [](In u, In) { return u[0] < 1 ? 0 : 1; };
    const Branch branch =
        trace(from_functions(f), at(-1, -1), window(-2, 2), {fold_monitor(), kink_monitor()});
    CAPTURE(with, branch.stop.message);
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.points.back().parameter == -2);
    REQUIRE(branch.events.size() == 2);
    for (const Event& event : branch.events) {
      CHECK(std::abs(event.point.u[0] - 1) < 1e-9);
      CHECK(std::abs(event.point.parameter - 1) < 1e-9);
      CHECK(event.nonsmooth);
    }
  }
}

namespace {

// p = g(x_0) and x_j = h_j(x_0), j >= 1, along x_0 from -1 to 1: each a x + b sin(2 x + c) and a sum of
// bends e_k max(0, x - c_k). The unknowns are u = R x, the equations mixed by Q.
struct RandomBranch {
  struct Curve {
    double a, b, c;
    std::vector<double> bends;
  };
  std::vector<Curve> curves;  // g, h_1, ...
  std::vector<double> corners;
  Matrix R, inverse_R, Q;

  explicit RandomBranch(unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&](double lower, double upper) {
      return lower + (upper - lower) * static_cast<double>(random()) / 4294967296.0;
    };
    const int n = 1 + static_cast<int>(seed % 4), count = 1 + static_cast<int>(seed / 4 % 4);
    for (int k = 0; k < count; ++k)  // at least 0.1 apart
      corners.push_back(-0.9 + 1.8 * (k + uniform(0.1, 0.8)) / count);
    for (int i = 0; i < n; ++i) curves.push_back({uniform(-1, 1), uniform(-1, 1), uniform(0, 6), {}});
    curves[0].a += curves[0].a < 0 ? -0.5 : 0.5;
    for (int k = 0; k < count; ++k) {
      const auto bent = static_cast<std::size_t>(uniform(0, n));
      for (std::size_t i = 0; i < curves.size(); ++i) {
        const double size = uniform(0.5, 3) * (uniform(-1, 1) < 0 ? -1 : 1);
        curves[i].bends.push_back(i == bent ? size : 0);
      }
    }
    const auto near_identity = [&] {
      Matrix M = Matrix::Identity(n, n);
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) M(i, j) += uniform(-0.3, 0.3) / n;
      return M;
    };
    R = near_identity();
    Q = near_identity();
    inverse_R = R.inverse();
  }

  std::size_t part(double x) const {
    return static_cast<std::size_t>(std::upper_bound(corners.begin(), corners.end(), x) - corners.begin());
  }
  double value(std::size_t i, double x, std::size_t part) const {
    double y = curves[i].a * x + curves[i].b * std::sin(2 * x + curves[i].c);
    for (std::size_t k = 0; k < part; ++k) y += curves[i].bends[k] * (x - corners[k]);
    return y;
  }
  double slope(std::size_t i, double x, std::size_t part) const {
    double y = curves[i].a + 2 * curves[i].b * std::cos(2 * x + curves[i].c);
    for (std::size_t k = 0; k < part; ++k) y += curves[i].bends[k];
    return y;
  }
  Vector u_at(double x) const {
    Vector y(static_cast<Eigen::Index>(curves.size()));
    y[0] = x;
    for (Eigen::Index i = 1; i < y.size(); ++i) y[i] = value(static_cast<std::size_t>(i), x, part(x));
    return R * y;
  }
  // (u, p) with x.
  Vector tangent(double x, std::size_t part) const {
    const auto n = static_cast<Eigen::Index>(curves.size());
    Vector y(n), t(n + 1);
    y[0] = 1;
    for (Eigen::Index i = 1; i < n; ++i) y[i] = slope(static_cast<std::size_t>(i), x, part);
    t << R * y, slope(0, x, part);
    return t.normalized();
  }
  Vector residual(const Vector& u, double p, std::size_t part) const {
    Vector x = inverse_R * u, F = x;
    F[0] = value(0, x[0], part) - p;
    for (Eigen::Index i = 1; i < F.size(); ++i) F[i] = x[i] - value(static_cast<std::size_t>(i), x[0], part);
    return Q * F;
  }
  double x_of(In u) const { return inverse_R.row(0).dot(u); }

  Functions functions(bool by_choices) const {
    Functions f;
    f.size = static_cast<int>(curves.size());
    f.parameters = {parameter("p", 0)};
    const auto self = std::make_shared<const RandomBranch>(*this);
    if (by_choices) {
      f.choosing.residual = [=](In u, In p, Choices& choose, Out F) {
        F = self->residual(u, p[0], choose.part(self->x_of(u), self->corners));
      };
    } else {
      f.residual = [=](In u, In p, Out F) { F = self->residual(u, p[0], self->part(self->x_of(u))); };
      f.piece = [=](In u, In) { return self->part(self->x_of(u)); };
    }
    return f;
  }
};

}  // namespace

TEST_CASE("each kink of 500 random branches is found without a Jacobian, with the tangents of both sides") {
  int kinks = 0;
  for (unsigned seed = 0; seed < 500; ++seed)
    for (const bool by_choices : {false, true}) {
      const RandomBranch known(seed);
      const double p = known.value(0, -1, 0);
      const Monitor end{.name = "end",
                        .value = [&](const Accepted& now) { return known.x_of(now.u) - 1; },
                        .terminal = true};
      const Branch branch = trace(from_functions(known.functions(by_choices)),
                                  {.u = known.u_at(-1), .p = Vector{{p}}, .tangent = known.tangent(-1, 0)},
                                  window(-30, 30), {kink_monitor(), end});
      CAPTURE(seed, by_choices, branch.stop.message, branch.points.size());
      CHECK(branch.stop.reason == StopReason::event);
      CHECK(branch.warnings.empty());
      const auto found = events_named(branch, "kink");
      REQUIRE(found.size() == known.corners.size());
      for (std::size_t k = 0; k < found.size(); ++k, ++kinks) {
        const double corner = known.corners[k];
        CHECK(std::abs(known.x_of(found[k].point.u) - corner) < 1e-9);
        CHECK((found[k].point.u - known.u_at(corner)).norm() < 1e-8);
        const Kink& kink = std::get<Kink>(found[k].data);
        CHECK((kink.before - known.tangent(corner, k)).norm() < 1e-6);
        CHECK((kink.after - known.tangent(corner, k + 1)).norm() < 1e-6);
      }
    }
  CHECK(kinks > 2000);
}

namespace {

// dF/dp of one equation at (u, p) by the problem's own differences, and the number of residuals.
struct Difference {
  double value;
  int residuals;
};
Difference by_differences(const std::function<double(double)>& f, double u, double p, double scale) {
  int residuals = 0;
  const auto problem = from_functions(
      {.size = 1, .parameters = {parameter("p", 0, scale)}, .residual = [&](In v, In q, Out F) {
         ++residuals;
         F[0] = v[0] - f(q[0]);
       }});
  const auto at = problem->evaluator();
  REQUIRE(at->move_to(Vector{{u}}, Vector{{p}}, Needs::residual) == Evaluated::ok);
  residuals = 0;
  Vector dF(1);
  at->parameter_derivative(0, dF);
  return {-dF[0], residuals};
}

}  // namespace

TEST_CASE("dF/dp by differences is right to 1e-8 where p is small in a wide window") {
  for (const double p : {1e-6, 1e-3, 1.0, 1e3})
    for (const double scale : {0.0, 1.0, 1e6})
      for (const double n : {1.0, 2.0, 3.0}) {
        const auto f = [=](double q) { return 1 / (1 + std::pow(q, -n)); };
        const double known = n * std::pow(p, n - 1) / std::pow(1 + std::pow(p, n), 2);
        const Difference found = by_differences(f, f(p), p, scale);
        CAPTURE(p, scale, n, found.value, known);
        // F is 1 to rounding beyond p = 1: its differences over steps of p have that rounding.
        const double rounding = 4 * 2.2e-16 * f(p) / (6e-6 * p);
        CHECK(std::abs(found.value - known) < 1e-8 * known + rounding);
      }
}

TEST_CASE("dF/dp by differences is right at p = 0, whatever the width over which F bends") {
  for (const double width : {1e-6, 1e-4, 1e-2, 1.0, 1e3})
    for (const double scale : {1.0, 1e3}) {
      const Difference found = by_differences([=](double q) { return std::atan(q / width); }, 0, 0, scale);
      CAPTURE(width, scale, found.value);
      CHECK(found.value * width == Approx(1).epsilon(1e-8));
      CHECK(found.residuals <= 18);
    }
}

TEST_CASE("dF/dp takes two residuals where F is seen to be smooth over the scale, else four if it is") {
  const auto smooth = [](double q) { return std::sin(0.5 + q); };
  CHECK(by_differences(smooth, 0, 0.4, 1).residuals == 2);
  CHECK(by_differences(smooth, 0, 7, 1).residuals == 2);
  CHECK(by_differences(smooth, 0, 1e-3, 1).residuals == 2);
  CHECK(by_differences(smooth, 0, 1e-6, 1).residuals == 4);
  CHECK(by_differences(smooth, 0, 0, 1).residuals == 4);
  for (const double p : {0.0, 1e-6, 1e-3, 0.4}) {
    const Difference found = by_differences(smooth, 0, p, 1);
    CHECK(std::abs(found.value - std::cos(0.5 + p)) < 1e-9);
  }
}

TEST_CASE("rounding of F costs dF/dp by differences no digits that it has") {
  // Terms of 1e3 whose rounding is 1e-13: over 6e-6 scales 1e-8, over shorter steps more.
  for (const double p : {0.0, 1e-9, 1e-6, 1e-3}) {
    const auto f = [](double q) { return 1e3 * std::exp(1e-3 * q) - 1e3; };
    const Difference found = by_differences(f, 0, p, 1);
    CAPTURE(p, found.residuals);
    CHECK(std::abs(found.value - std::exp(1e-3 * p)) < 1e-7);
  }
}

TEST_CASE("the differences of a trace go by its window: the unit of a parameter does not matter") {
  for (const double unit : {1e-9, 1.0, 1e9}) {
    const auto problem = from_functions(1, {{"p", "", 0}}, [=](In u, In p, Out F) {
      F[0] = 1 + u[0] - std::exp(p[0] / unit);  // of terms of 1 that cancel
    });
    const Branch branch =
        trace(problem, {.u = Vector{{0.0}}, .p = Vector{{0.0}}}, {.lower = -unit, .upper = unit});
    CAPTURE(unit);
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.warnings.empty());
    for (const Point& point : branch.points)
      CHECK(point.tangent[0] / point.tangent[1] * unit ==
            Approx(std::exp(point.parameter / unit)).epsilon(1e-8));
  }
}

TEST_CASE("u = p^n / (1 + p^n) from 1e-6 to 1e6 blames no derivative that is right") {
  for (const double n : {1.0, 3.0}) {
    const auto problem = from_functions(
        1, {{"p", "", 1e-6}}, [=](In u, In p, Out F) { F[0] = u[0] - 1 / (1 + std::pow(p[0], -n)); });
    const Branch branch =
        trace(problem, {.u = Vector{{0.0}}, .p = Vector{{1e-6}}}, {.lower = 1e-6, .upper = 1e6});
    CAPTURE(n, branch.stop.message);
    CHECK(branch.warnings.empty());
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.points.back().parameter == 1e6);
    CHECK(std::abs(branch.points.back().u[0] - 1 / (1 + std::pow(1e6, -n))) < 1e-12);
  }
}

TEST_CASE("a wrong dF/dp is named where the window is far wider than p, and a right one is not") {
  for (const double p : {0.0, 1e-6, 1e-2, 1.0})
    for (const double factor : {1.0, 1.001, 0.0, -1.0}) {
      const auto problem = from_functions(
          2, {parameter("p", 0, 1e6)},
          [](In u, In q, Out F) { F << u[0] - q[0] / (1 + q[0] * q[0]), u[1] - q[0]; },
          [](In, In, Eigen::Ref<Matrix> J) { J.setIdentity(); },
          [=](In, In q, int, Out dF) {
            const double d = 1 + q[0] * q[0];
            dF << -factor * (1 / d - 2 * q[0] * q[0] / (d * d)), -1;
          });
      const JacobianError found = doubt_jacobian(*problem, Vector{{p / (1 + p * p), p}}, Vector{{p}}, 0);
      CAPTURE(p, factor, found.message);
      if (factor == 1 || p == 1)  // at p = 1 dF/dp = 0
        CHECK(found.message.empty());
      else
        CHECK(found.message.find("the Jacobian is wrong: dF[0]/d(p) is given as") == 0);
    }
}
