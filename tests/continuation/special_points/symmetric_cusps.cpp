// Curves of folds where F_pa lies in the range of J: through cusps of problems with a symmetry, and where the
// curve turns in the other parameter; and curves with an odd number of cusps, along which the null vectors
// have no sign.

#include "catch.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>

#include <numbers>

using namespace problems;

namespace {

constexpr int by_lambda = 0, by_eps = 1;

// The unfolded pitchfork lambda u - u^3 + eps = 0, with a second unknown 2 v = u or none. Its folds are u =
// s, lambda = 3 s^2, eps = -2 s^3.
std::shared_ptr<const Problem> unfolded_pitchfork(bool second) {
  Functions f;
  f.size = second ? 2 : 1;
  f.parameters = {{"lambda", ""}, {"eps", ""}};
  f.residual = [=](In u, In p, Out F) {
    F[0] = p[0] * u[0] - u[0] * u[0] * u[0] + p[1];
    if (second) F[1] = -2 * u[1] + u[0];
  };
  f.jacobian = [=](In u, In p, Eigen::Ref<Matrix> J) {
    J.setZero();
    J(0, 0) = p[0] - 3 * u[0] * u[0];
    if (second) J.row(1) << 1, -2;
  };
  f.derivative = [](In u, In, int k, Out dF) {
    dF.setZero();
    dF[0] = k == by_lambda ? u[0] : 1;
  };
  return from_functions(std::move(f));
}

// Lorenz-84 of van Veen (2003) and Kuznetsov, with the derivatives or without; parameters F and T. With (T,
// U) also -(T, U) is a solution.
std::shared_ptr<const Problem> lorenz84(bool exact) {
  const double a = 0.25, G = 0.25, d = 1.04, g = 0.987;
  Functions f;
  f.size = 4;
  f.parameters = {{"F", "", 3}, {"T", "", 0.04}};
  f.residual = [=](In u, In p, Out F) {
    const double X = u[0], Y = u[1], Z = u[2], U = u[3];
    F << -Y * Y - Z * Z - a * X + a * p[0] - g * U * U, X * Y - X * Z - Y + G, X * Y + X * Z - Z,
        -d * U + g * U * X + p[1];
  };
  if (exact) {
    f.jacobian = [=](In u, In, Eigen::Ref<Matrix> J) {
      const double X = u[0], Y = u[1], Z = u[2], U = u[3];
      J << -a, -2 * Y, -2 * Z, -2 * g * U, Y - Z, X - 1, -X, 0, Y + Z, X, X - 1, 0, g * U, 0, 0, -d + g * X;
    };
    f.derivative = [=](In, In, int k, Out dF) {
      dF.setZero();
      dF[k == 0 ? 0 : 3] = k == 0 ? a : 1;
    };
  }
  return from_functions(std::move(f));
}

// On the curve of folds at T = sign 0.04.
Start fold_of_lorenz84(int sign, int direction) {
  Start start{.u = Vector{{1.311785525, -0.04287499818, 0.1803893942, sign * -0.157027585, 1.546648373}},
              .p = Vector{{3.0, sign * 0.04}},
              .free = 1,
              .direction = direction};
  return start;
}

constexpr double bogdanov_takens_of_lorenz84 = 0.02094016968;  // |T|, where curves of Hopf points end, too

}  // namespace

TEST_CASE("the folds of an unfolded pitchfork pass one cusp, and no Bogdanov-Takens point, along either") {
  for (const bool second : {false, true})
    for (const int along : {by_lambda, by_eps})
      for (const double s : {-0.5, -0.6173}) {
        Vector x(second ? 3 : 2);
        x[0] = s;
        if (second) x[1] = s / 2;
        x[x.size() - 1] = along == by_lambda ? 3 * s * s : -2 * s * s * s;
        const Vector p{{3 * s * s, -2 * s * s * s}};
        const Branch curve = trace(folds(unfolded_pitchfork(second), along),
                                   {.u = x, .p = p, .free = 1 - along, .direction = -1}, window(-0.5, 1.5),
                                   {cusp_monitor(), bogdanov_takens_monitor()});
        CAPTURE(second, along, s, curve.stop.message);
        CHECK(curve.stop.reason == StopReason::boundary);
        CHECK(curve.warnings.empty());
        CHECK(curve.counts.rejected_steps <= 2);
        REQUIRE(curve.events.size() == 1);
        const Event& cusp = curve.events[0];
        CHECK(cusp.monitor == cusp_event);
        CHECK(cusp.located);
        CHECK(std::abs(cusp.point.u[0]) < 1e-9);
        CHECK(std::abs(cusp.point.parameter) < 1e-12);
        for (const Point& point : curve.points) {
          const double u = point.u[0], other = point.u[point.u.size() - 1];
          const double lambda = along == by_lambda ? other : point.parameter,
                       eps = along == by_lambda ? point.parameter : other;
          CHECK(std::abs(lambda - 3 * u * u) < 1e-9);
          CHECK(std::abs(eps + 2 * u * u * u) < 1e-9);
        }
      }
}

TEST_CASE("the folds of Lorenz-84 pass its cusp at T = 0 and its two Bogdanov-Takens points, and no others") {
  for (const bool exact : {true, false})
    for (const int sign : {1, -1}) {
      const Branch curve = trace(folds(lorenz84(exact), 0), fold_of_lorenz84(sign, -sign), window(-0.1, 0.1),
                                 {cusp_monitor(), bogdanov_takens_monitor()});
      CAPTURE(exact, sign, curve.stop.message);
      CHECK(curve.stop.reason == StopReason::boundary);
      CHECK(curve.warnings.empty());
      const auto cusps = events_named(curve, cusp_event), takens = events_named(curve, "bogdanov_takens");
      REQUIRE(cusps.size() == 1);
      CHECK(std::abs(cusps[0].point.parameter) < 1e-9);
      CHECK(std::abs(cusps[0].point.u[3]) < 1e-6);
      REQUIRE(takens.size() == 2);
      CHECK(std::abs(takens[0].point.parameter - sign * bogdanov_takens_of_lorenz84) < 1e-8);
      CHECK(std::abs(takens[1].point.parameter + sign * bogdanov_takens_of_lorenz84) < 1e-8);
      for (const Event& event : curve.events) CHECK(event.located);
    }
}

TEST_CASE("the folds of Lorenz-84 in a window that ends near the cusp blame no derivatives") {
  for (const bool exact : {true, false})
    for (const int sign : {1, -1})
      for (const double to : {0.0, 1e-3}) {
        const Options options = window(sign > 0 ? -to : -0.1, sign > 0 ? 0.1 : to);
        const Branch curve = trace(folds(lorenz84(exact), 0), fold_of_lorenz84(sign, -sign), options,
                                   {bogdanov_takens_monitor()});
        CAPTURE(exact, sign, to, curve.stop.message);
        CHECK(curve.stop.reason == StopReason::boundary);
        CHECK(curve.warnings.empty());
        REQUIRE(curve.events.size() == 1);
        CHECK(std::abs(curve.events[0].point.parameter - sign * bogdanov_takens_of_lorenz84) < 1e-8);
      }
}

TEST_CASE("where folds turn in the other parameter there is no cusp: an isola of u^2 + lambda^2 = eps") {
  const auto isola = from_functions(
      1, {{"lambda", ""}, {"eps", ""}}, [](In u, In p, Out F) { F[0] = u[0] * u[0] + p[0] * p[0] - p[1]; },
      [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = 2 * u[0]; },
      [](In, In p, int k, Out dF) { dF[0] = k == 0 ? 2 * p[0] : -1; });
  const Branch curve =
      trace(folds(isola, 0), {.u = Vector{{0.0, 0.7}}, .p = Vector{{0.7, 0.49}}, .free = 1, .direction = -1},
            window(-1, 0.5), {cusp_monitor(), bogdanov_takens_monitor(), fold_monitor()});
  CAPTURE(curve.stop.message);
  CHECK(curve.stop.reason == StopReason::boundary);
  REQUIRE(curve.events.size() == 1);
  CHECK(curve.events[0].monitor == fold_event);
  CHECK(std::abs(curve.events[0].point.parameter) < 1e-12);
  CHECK(curve.points.back().u[1] < -0.7);
}

TEST_CASE("a closed curve of folds with three cusps, a section of the elliptic umbilic, has each of them") {
  // The gradient of x^3 - 3 x y^2 + w (x^2 + y^2) - a x - b y: folds on the circle of radius r = w / 3, at
  // (a, b) = r^2 (3 cos 2t + 6 cos t, 6 sin t - 3 sin 2t), with cusps at t = 0 and +-120 degrees.
  const double w = 1.5, r = w / 3;
  const auto umbilic = from_functions(
      2, {{"a", "", 0, 1}, {"b", "", 0, 1}},
      [=](In u, In p, Out F) {
        const double x = u[0], y = u[1];
        F << 3 * x * x - 3 * y * y + 2 * w * x - p[0], -6 * x * y + 2 * w * y - p[1];
      },
      [=](In u, In, Eigen::Ref<Matrix> J) {
        J << 6 * u[0] + 2 * w, -6 * u[1], -6 * u[1], -6 * u[0] + 2 * w;
      });
  for (const int along : {0, 1})
    for (const double t : {0.5, 2.9, 4.4}) {
      const Vector p{
          {r * r * (3 * std::cos(2 * t) + 6 * std::cos(t)), r * r * (6 * std::sin(t) - 3 * std::sin(2 * t))}};
      const Start start{.u = Vector{{r * std::cos(t), r * std::sin(t), p[along]}}, .p = p, .free = 1 - along};
      const Branch curve = trace(folds(umbilic, along), start, window(-5, 5), {cusp_monitor()});
      CAPTURE(along, t, curve.stop.message);
      CHECK(curve.stop.reason == StopReason::closed);
      REQUIRE(curve.events.size() == 3);
      for (const Event& cusp : curve.events) {
        const double at = std::atan2(cusp.point.u[1], cusp.point.u[0]) / (2 * std::numbers::pi / 3);
        CHECK(std::abs(at - std::round(at)) < 1e-8);
        CHECK(std::abs(cusp.point.u.head(2).norm() - r) < 1e-10);
        const double a = along == 0 ? cusp.point.u[2] : cusp.point.parameter,
                     b = along == 0 ? cusp.point.parameter : cusp.point.u[2];
        CHECK(std::abs(std::hypot(a, b) - 9 * r * r) < 1e-10);
      }
    }
}

TEST_CASE("right derivatives are not blamed where F is so large that differences are all rounding") {
  const auto problem = lorenz84(true);
  const Vector u{{1.3, -0.04, 0.18, -0.16}};
  for (const double T : {-9.9e35, 1e20, -1e17})
    for (const int free : {0, 1}) CHECK(doubt_jacobian(*problem, u, Vector{{1.5, T}}, free).message == "");
}

TEST_CASE("on a curve of folds a wrong derivative of the problem is named as one of the problem") {
  // a: dF/dmu of mu + lambda x - x^3, b: dF/dx
  for (const bool in_parameter : {true, false}) {
    const auto problem = from_functions(
        1, {parameter("mu", 0), parameter("lambda", 1)},
        [](In u, In p, Out F) { F[0] = p[0] + p[1] * u[0] - std::pow(u[0], 3); },
        [=](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = p[1] - (in_parameter ? 3 : 2.9) * u[0] * u[0]; },
        [=](In u, In, int k, Out dF) { dF[0] = k == 1         ? u[0]
                                               : in_parameter ? 1.1
                                                              : 1; });
    const Start start{Vector{{-0.6, 0.4}}, Vector{{0.0, 1.0}}, 1, -1};
    const Branch curve = trace(folds(problem, 0), start, window(-1, 2));
    REQUIRE(curve.warnings.size() == 1);
    CHECK(curve.warnings[0].find(in_parameter ? "the Jacobian is wrong: dF[0]/d(mu) is given as 1.1"
                                              : "the Jacobian is wrong: dF[0]/du[0] is given as") == 0);
  }
}

TEST_CASE("wrong second derivatives are said to be that") {
  Functions f;
  f.size = 1;
  f.parameters = {parameter("mu", 0), parameter("lambda", 1)};
  f.residual = [](In u, In p, Out F) { F[0] = p[0] + p[1] * u[0] - std::pow(u[0], 3); };
  f.jacobian = [](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = p[1] - 3 * u[0] * u[0]; };
  f.derivative = [](In u, In, int k, Out dF) { dF[0] = k == 0 ? 1 : u[0]; };
  f.second = [](In u, In, In w, In v, In q, Out du, Out dp) {
    du[0] = w[0] * (-5 * u[0] * v[0] + q[1]);
    dp << 0, w[0] * v[0];
  };
  const Branch curve = trace(folds(from_functions(std::move(f)), 0),
                             {Vector{{-0.6, 0.4}}, Vector{{0.0, 1.0}}, 1, -1}, window(-1, 2));
  REQUIRE(curve.warnings.size() == 1);
  CHECK(curve.warnings[0].find("second derivatives are wrong: ") == 0);
}

TEST_CASE("the derivatives of a curve of folds are not blamed for the borders of another place") {
  Functions f;
  f.size = 2;
  f.parameters = {{"a", "", 0}, {"b", "", 0}, {"c", "", 1}};
  f.residual = [](In u, In p, Out F) {
    F << p[0] + p[1] * u[0] - p[2] * u[1] + u[1] * u[1], u[1] - u[0] * u[0];
  };
  f.jacobian = [](In u, In p, Eigen::Ref<Matrix> J) { J << p[1], -p[2] + 2 * u[1], -2 * u[0], 1; };
  f.second = [](In, In, In w, In v, In q, Out du, Out dp) {
    du << -2 * w[1] * v[0] + w[0] * q[1], 2 * w[0] * v[1] - w[0] * q[2];
    dp << 0, w[0] * v[0], -w[0] * v[1];
  };
  const auto curve = folds(from_functions(f), 0);
  for (const double x : {0.5, 1.0, 1.7}) {  // c = 1: b = 2 x - 4 x^3 makes J singular, a makes F vanish
    const double b = 2 * x - 4 * std::pow(x, 3);
    const Vector u{{x, x * x, -b * x + x * x - std::pow(x, 4)}}, p{{0, b, 1}};
    CAPTURE(x);
    CHECK(doubt_jacobian(*curve, u, p, 1).message.empty());
    CHECK(doubt_jacobian(*curve, u, p, 2).message.empty());
  }
}
