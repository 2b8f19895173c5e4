#include "catch.hpp"

#include <arcslip/continuation/linear/linear_solvers.hpp>

#include "continuation/problems.hpp"

#include <cmath>
#include <memory>
#include <numbers>

using namespace problems;

namespace {

using std::numbers::pi;

// Two springs of negative slope -r_k beyond contact at u_k = 0, coupled by 0.3, both loaded by p.
std::shared_ptr<const Problem> two_contacts(double r0, double r1) {
  return from_functions({.size = 2,
                         .parameters = {parameter("p", 0)},
                         .residual =
                             [=](In u, In p, Out F) {
                               const double between = 0.3 * (u[0] - u[1]);
                               F[0] = u[0] - r0 * std::max(0.0, u[0]) + between - p[0];
                               F[1] = u[1] - r1 * std::max(0.0, u[1]) - between - p[0];
                             },
                         .jacobian =
                             [=](In u, In, Eigen::Ref<Matrix> J) {
                               J << 1.3 - (u[0] > 0 ? r0 : 0), -0.3, -0.3, 1.3 - (u[1] > 0 ? r1 : 0);
                             },
                         .derivative = [](In, In, int, Out dF) { dF.setConstant(-1); },
                         .piece = [](In u, In) { return (u[0] > 0 ? 1 : 0) + (u[1] > 0 ? 2 : 0); }});
}

// Every 18th solution is not a number.
class Failing final : public LinearSolver {
 public:
  const char* name() const override { return "failing"; }
  bool factorize(const Jacobian& J, const Borders& borders) override { return lu_->factorize(J, borders); }
  void solve(Out x) const override {
    lu_->solve(x);
    if (++calls_ % 18 == 0) x.setConstant(std::nan(""));
  }
  std::optional<int> determinant_sign() const override { return lu_->determinant_sign(); }

 private:
  std::unique_ptr<LinearSolver> lu_ = dense_lu();
  mutable int calls_ = 0;
};

}  // namespace

TEST_CASE("a solver that fails now and then leaves no point without a tangent") {
  const auto s_curve = from_functions(
      1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = p[0] - u[0] * u[0] * u[0] + u[0]; },
      [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = 1 - 3 * u[0] * u[0]; },
      [](In, In, int, Out dF) { dF[0] = 1; });
  Options options = window(-4, 6);
  options.linear_solver = [] { return std::make_unique<Failing>(); };
  const Branch branch =
      trace(s_curve, {Vector{{-1.4}}, Vector{{1.4 - 1.4 * 1.4 * 1.4}}, 0, 1}, options, {fold_monitor()});
  for (const Point& point : branch.points) CHECK(point.tangent.allFinite());
}

TEST_CASE("a circle closes after one way round, wherever it begins") {
  Options options = window(-2, 2);
  options.points = 400;
  int odd = 0;
  for (int k = 0; k < 300; ++k) {
    const double angle = k * 2 * pi / 300;
    const Branch branch =
        trace(circle(), {Vector{{std::cos(angle)}}, Vector{{std::sin(angle)}}, 0, 1}, options);
    if (branch.stop.reason != StopReason::closed || branch.points.back().arclength > 7) ++odd;
  }
  CHECK(odd == 0);
}

TEST_CASE("a square closes where it begins at a corner") {
  const auto square =
      from_functions({.size = 1,
                      .parameters = {parameter("p", 0)},
                      .residual = [](In u, In p, Out F) { F[0] = std::abs(u[0]) + std::abs(p[0]) - 1; },
                      .jacobian = [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = u[0] < 0 ? -1 : 1; },
                      .derivative = [](In, In p, int, Out dF) { dF[0] = p[0] < 0 ? -1 : 1; },
                      .piece = [](In u, In p) { return (u[0] < 0 ? 1 : 0) + (p[0] < 0 ? 2 : 0); }});
  Options options = window(-2, 2);
  options.points = 1000;
  const Branch branch = trace(square, {Vector{{1.0}}, Vector{{0.0}}, 0, 1}, options);
  CHECK(branch.stop.reason == StopReason::closed);
}

TEST_CASE("a helix whose windings are 6e-6 apart is not closed") {
  const double rise = 1e-6;  // of u_1, per rad
  const auto helix = from_functions(
      2, {parameter("p", 0)},
      [=](In u, In p, Out F) {
        F[0] = u[0] - std::sin(u[1] / rise);
        F[1] = p[0] - std::cos(u[1] / rise);
      },
      [=](In u, In, Eigen::Ref<Matrix> J) {
        J << 1, -std::cos(u[1] / rise) / rise, 0, std::sin(u[1] / rise) / rise;
      });
  Options options = window(-2, 2);
  options.points = 400;
  const Branch branch =
      trace(helix, {Vector{{std::sin(0.4), 0.4 * rise}}, Vector{{std::cos(0.4)}}, 0, 1}, options);
  CHECK(branch.stop.reason == StopReason::point_limit);
}

TEST_CASE("a curve that crosses itself near its start closes only after both rounds") {
  // r = 1 + e cos(3 theta / 2), 0 <= theta < 4 pi, whose crossings lie at cos(3 theta / 2) = 0.
  const double e = 0.1, theta = pi / 3 + 1e-5, r = 1 + e * std::cos(1.5 * theta);
  const auto slope = [=](double u, double p, bool by_u) {
    const double radius = std::hypot(u, p), angle = std::atan2(u, p);
    const double along = 2 * (radius - 1) / radius,
                 round = 1.5 * e * e * std::sin(3 * angle) / (radius * radius);
    return by_u ? along * u + round * p : along * p - round * u;
  };
  const auto rosette = from_functions(
      1, {parameter("p", 0)},
      [=](In u, In p, Out F) {
        const double radius = std::hypot(u[0], p[0]), angle = std::atan2(u[0], p[0]);
        F[0] = (radius - 1) * (radius - 1) - e * e / 2 * (1 + std::cos(3 * angle));
      },
      [=](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = slope(u[0], p[0], true); },
      [=](In u, In p, int, Out dF) { dF[0] = slope(u[0], p[0], false); });
  const Branch branch =
      trace(rosette, {Vector{{r * std::sin(theta)}}, Vector{{r * std::cos(theta)}}, 0, 1}, window(-2, 2));
  CHECK(branch.stop.reason == StopReason::closed);
  CHECK(branch.points.back().arclength > 4 * pi);
}

TEST_CASE("where two contacts close at one place the branch does not run back and forth") {
  const Branch branch =
      trace(two_contacts(3, 2), {Vector{{-0.7, -0.7}}, Vector{{-0.7}}, 0, 1}, window(-1, 1));
  CAPTURE(branch.stop.message, branch.points.size());
  // Open, both follow u = p; that part is passed once.
  double last = -1;
  int back = 0;
  for (const Point& point : branch.points)
    if (point.u.maxCoeff() < 0) {
      if (point.parameter < last) ++back;
      last = point.parameter;
    }
  CHECK(back == 0);
}

TEST_CASE("events beyond the window are not reported") {
  // A pitchfork at p = 0, the window ends at -1e-3; a fold at p = 1e-4, the window ends at 0.
  const auto pitchfork = from_functions(
      1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = u[0] * (p[0] - u[0] * u[0]); },
      [](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = p[0] - 3 * u[0] * u[0]; },
      [](In u, In, int, Out dF) { dF[0] = u[0]; });
  const Branch first =
      trace(pitchfork, {Vector{{0.0}}, Vector{{-0.777}}, 0, 1}, window(-1, -1e-3), {branch_point_monitor()});
  CHECK(first.stop.reason == StopReason::boundary);
  CHECK(first.events.empty());
  const auto parabola = from_functions(
      1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = p[0] + u[0] * u[0] - 1e-4; },
      [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = 2 * u[0]; }, [](In, In, int, Out dF) { dF[0] = 1; });
  const Branch second = trace(parabola, {Vector{{-0.731}}, Vector{{1e-4 - 0.731 * 0.731}}, 0, 1},
                              window(-3, 0), {fold_monitor()});
  CHECK(second.points.back().parameter == 0);
  CHECK(second.events.empty());
}

TEST_CASE("a pitchfork exactly at the window's end is its end") {
  const auto pitchfork = from_functions(
      1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = u[0] * (p[0] - u[0] * u[0]); },
      [](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = p[0] - 3 * u[0] * u[0]; },
      [](In u, In, int, Out dF) { dF[0] = u[0]; });
  const Branch branch =
      trace(pitchfork, {Vector{{0.0}}, Vector{{-0.777}}, 0, 1}, window(-1, 0), {branch_point_monitor()});
  CAPTURE(branch.stop.message);
  CHECK(branch.stop.reason == StopReason::boundary);
}

TEST_CASE("one point is as many as points = 1 allows") {
  Options options = window(-2, 2);
  options.points = 1;
  CHECK(trace(circle(), {Vector{{1.0}}, Vector{{0.0}}, 0, 1}, options).points.size() == 1);
}
