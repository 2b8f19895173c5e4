#include "catch.hpp"

#include "continuation/suite/cases.hpp"

#include <cmath>
#include <numbers>

using namespace suite;
using arcslip::continuation::fold_monitor;
using arcslip::continuation::Point;
using arcslip::continuation::StopReason;

namespace {

constexpr double bratu_fold = 3.51383071912516121;  // 8 (c / cosh c)^2, c tanh c = 1

double bratu_fold_by_differences(int n, int order) {
  const auto found = folds(arcslip::continuation::trace(bratu_differences(n, order),
                                                        {Vector::Zero(n), Vector::Constant(1, 0.5), 0, 1},
                                                        window(0.5, 5), {fold_monitor()}));
  REQUIRE(found.size() == 1);
  return found[0].point.parameter;
}

}  // namespace

TEST_CASE(
    "every point of Bratu's branch is 2 ln(cosh c / cosh(c (1 - 2 x))) with lambda = 8 (c / cosh c)^2") {
  const int n = 47;
  const Branch branch =
      arcslip::continuation::trace(bratu_chebyshev(n), {Vector::Zero(n), Vector::Constant(1, 0.5), 0, 1},
                                   window(0.5, 5), {fold_monitor()});
  CHECK(branch.stop.reason == StopReason::boundary);
  double lambda_error = 0, state_error = 0;
  for (const Point& point : branch.points) {
    const double c = std::acosh(std::exp(point.u[n / 2] / 2));
    lambda_error = std::max(lambda_error, std::abs(8 * std::pow(c / std::cosh(c), 2) - point.parameter));
    for (int j = 0; j < n; ++j) {
      const double x = 0.5 * (1 - std::cos((j + 1) * std::numbers::pi / (n + 1)));
      const double u = 2 * std::log(std::cosh(c) / std::cosh(c * (1 - 2 * x)));
      state_error = std::max(state_error, std::abs(u - point.u[j]));
    }
  }
  CHECK(lambda_error < 1e-10);
  CHECK(state_error < 1e-10);
  const auto found = folds(branch);
  REQUIRE(found.size() == 1);
  CHECK(std::abs(found[0].point.parameter - bratu_fold) < 1e-12);
  CHECK(std::abs(found[0].point.u[n / 2] - 1.1868421686343891) < 1e-9);
}

TEST_CASE("the error of Bratu's fold falls with h^2 by three points and with h^4 by Numerov's") {
  for (int order : {2, 4}) {
    const double coarse = std::abs(bratu_fold_by_differences(15, order) - bratu_fold);
    const double fine = std::abs(bratu_fold_by_differences(31, order) - bratu_fold);
    const double finest = std::abs(bratu_fold_by_differences(63, order) - bratu_fold);
    CHECK(std::abs(std::log2(coarse / fine) - order) < 0.02);
    CHECK(std::abs(std::log2(fine / finest) - order) < 0.01);
  }
}

TEST_CASE("the response of the Duffing oscillator in one harmonic satisfies its amplitude equation") {
  const Branch branch = trace(named("duffing_1harmonic"));
  for (const Point& point : branch.points) {
    const double A2 = point.u.squaredNorm(), w = point.parameter;
    const double force = std::sqrt(A2 * (std::pow(1 - w * w + 0.75 * A2, 2) + std::pow(0.1 * w, 2)));
    REQUIRE(std::abs(force - 0.1) < 1e-10);
  }
}

TEST_CASE("Powell's homotopy goes to infinity at lambda = 1 - 1e-4 / (1.0001 - e^-y1 - e^-y2)") {
  const double pole = 1 - 1e-4 / (1.0001 - std::exp(-3.0) - std::exp(-6.0));
  for (const char* name : {"powell_1", "powell_3"}) {
    const Branch branch = trace(named(name));
    CHECK(branch.stop.reason == StopReason::state_too_large);
    CHECK(std::abs(branch.points.back().parameter - pole) < 1e-10);
    for (const Point& point : branch.points) REQUIRE(point.u.minCoeff() > 0);
  }
}

TEST_CASE("a start at which Jacobian and dF/dp leave no tangent has no branch") {
  CHECK(trace(named("powell_4")).points.empty());
}

TEST_CASE("the folds of Oden's frame under a load along its axis are at x1 = 2 -+ 2 / sqrt(3), x2 = 0") {
  const auto found = folds(trace(named("oden_0")));
  REQUIRE(found.size() == 2);
  CHECK((found[0].point.u - Vector{{2 - 2 / std::sqrt(3.0), 0.0}}).norm() < 1e-9);
  CHECK((found[1].point.u - Vector{{2 + 2 / std::sqrt(3.0), 0.0}}).norm() < 1e-9);
}

TEST_CASE("the buckling spring satisfies the quadratic equation of its load at each angle") {
  const double mu = 0.01;
  const Branch branch = trace(named("buckling_spring_0.01"));
  CHECK(branch.stop.reason == StopReason::boundary);
  for (const Point& point : branch.points) {
    const double s = std::sin(point.u[1]), c = std::cos(point.u[1]), lambda = point.parameter;
    const double length = 1 - lambda * c - mu * s / 2;
    REQUIRE(std::abs(point.u[0] - length) < 1e-10);
    REQUIRE(std::abs(length * (2 * lambda * s - mu * c) - point.u[1] / 2) < 1e-10);
  }
}

TEST_CASE("the steady state of the Brusselator is (A, B / A), without a fold") {
  const Branch branch = trace(named("brusselator"));
  for (const Point& point : branch.points) REQUIRE((point.u - Vector{{1.0, point.parameter}}).norm() < 1e-12);
}

TEST_CASE("the circle is closed after its two folds, at lambda = 1 and -1") {
  const Case c = named("circle");
  const Branch branch = trace(c);
  CHECK(branch.stop.reason == StopReason::closed);
  double sign = 1;
  const auto found = folds(branch);
  CHECK(found.size() == 2);
  for (const Event& fold : found) {
    CHECK(std::abs(fold.point.parameter - sign) < 1e-12);
    CHECK(std::abs(fold.point.u[0]) < 1e-9);
    sign = -sign;
  }
  for (const Point& point : branch.points)
    REQUIRE(std::abs(point.u[0] * point.u[0] + point.parameter * point.parameter - 1) < 1e-12);
}

TEST_CASE("torsion and Keller's problem are followed to the end of the window without a fold") {
  for (const char* name : {"torsion", "keller"}) {
    const Branch branch = trace(named(name));
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.points.back().parameter == named(name).upper);
    CHECK(branch.events.empty());
  }
}
