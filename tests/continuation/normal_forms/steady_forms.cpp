// Normal forms at folds and branch points, against systems whose centre manifold is known: y_1 is the
// critical unknown, y_2 = m y_1^2 follows it, and u = T y mixes them. With N = |T e_1|, z = N y_1.

#include "catch.hpp"

#include "continuation/problems.hpp"

#include <Eigen/LU>

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/tracing/state.hpp>

using namespace problems;

namespace {

const Matrix mixing{{1, 0.3, -0.2}, {0.5, 2, 0.4}, {-0.7, 0.1, 1.5}};

struct Reduced {
  double constant = 0, linear = 0, square = 0, cube = 0;  // y_1' = constant p + linear p y_1 + ...
  double k = 0;                                           // + k y_1 y_2
  double m = 0;                                           // y_2' = -y_2 + m y_1^2
};

Vector rate(const Reduced& r, const Vector& y, double p) {
  return Vector{{r.constant * p + r.linear * p * y[0] + r.square * y[0] * y[0] + r.cube * std::pow(y[0], 3) +
                     r.k * y[0] * y[1],
                 -y[1] + r.m * y[0] * y[0], -2 * y[2] + y[0] * y[1]}};
}

std::shared_ptr<const Problem> mixed(const Reduced& r, bool exact) {
  const Matrix T = mixing, inverse = T.inverse();
  Functions f;
  f.size = 3;
  f.parameters = {parameter("p", 0)};
  f.residual = [=](In u, In p, Out F) { F = T * rate(r, inverse * u, p[0]); };
  if (exact) {
    f.jacobian = [=](In u, In p, Eigen::Ref<Matrix> J) {
      const Vector y = inverse * u;
      const Matrix of_y{
          {r.linear * p[0] + 2 * r.square * y[0] + 3 * r.cube * y[0] * y[0] + r.k * y[1], r.k * y[0], 0},
          {2 * r.m * y[0], -1, 0},
          {y[1], y[0], -2}};
      J = T * of_y * inverse;
    };
    f.derivative = [=](In u, In, int, Out dF) { dF = T.col(0) * (r.constant + r.linear * (inverse * u)[0]); };
  }
  return from_functions(std::move(f));
}

double promised(bool exact) {
  return exact ? 1e-9 : 2e-7;
}

void check_coefficient(const Coefficient& found, double expected, bool exact) {
  CAPTURE(found.value, found.error, expected, exact);
  CHECK(std::abs(found.value - expected) < promised(exact));
  CHECK(std::abs(found.value - expected) <= found.error);
  CHECK(found.error < 100 * promised(exact));
}

}  // namespace

TEST_CASE("a fold has the quadratic coefficient and the unfolding of its centre manifold") {
  const double N = mixing.col(0).norm();
  for (const bool exact : {true, false}) {
    const Reduced r{.constant = 1, .square = 0.8, .k = 0.3, .m = 0.5};
    const Branch branch =
        trace(mixed(r, exact), {-0.5 * mixing.col(0), Vector{{-0.2}}, 0, 1}, window(-1, 1), {fold_monitor()});
    CAPTURE(branch.stop.message);
    REQUIRE(branch.events.size() == 1);
    const Fold& fold = std::get<Fold>(branch.events[0].data);
    const double side = fold.right_null.dot(mixing.col(0)) > 0 ? 1 : -1;
    check_coefficient(fold.quadratic, side * 0.8 / N, exact);
    check_coefficient(fold.unfolding, side * N, exact);
    // p = -a z^2 / b with |du/ds| = 1.
    CHECK(std::abs(fold.curvature + 2 * 0.8 / (N * N)) < promised(exact));
  }
}

TEST_CASE("a transcritical point has the coefficients of its centre manifold") {
  const double N = mixing.col(0).norm();
  for (const bool exact : {true, false}) {
    const Reduced r{.linear = 1.3, .square = -0.8, .cube = 0.4, .k = 0.3, .m = 0.5};
    const Branch branch = trace(mixed(r, exact), {Vector::Zero(3), Vector{{-1.0}}, 0, 1}, window(-1, 1.2),
                                {branch_point_monitor()});
    REQUIRE(branch.events.size() == 1);
    const BranchPoint& point = std::get<BranchPoint>(branch.events[0].data);
    CHECK(point.type == BranchPoint::Type::transcritical);
    CHECK(point.criticality == Criticality::unknown);
    check_coefficient(point.crossing, 1.3, exact);
    CHECK(std::abs(std::abs(point.quadratic.value) - 0.8 / N) < promised(exact));
  }
}

TEST_CASE(
    "a pitchfork has the cubic coefficient of its centre manifold, from the trivial branch or its arms") {
  const double N = mixing.col(0).norm();
  for (const bool exact : {true, false})
    for (const double cube : {-1.0, 0.2}) {
      const Reduced r{.linear = 1.3, .cube = cube, .k = 0.3, .m = 0.5};
      const double c = cube + 0.3 * 0.5;
      const Branch branch = trace(mixed(r, exact), {Vector::Zero(3), Vector{{-1.0}}, 0, 1}, window(-1, 1.2),
                                  {branch_point_monitor()});
      REQUIRE(branch.events.size() == 1);
      const BranchPoint& point = std::get<BranchPoint>(branch.events[0].data);
      CHECK(point.type == BranchPoint::Type::pitchfork);
      check_coefficient(point.crossing, 1.3, exact);
      check_coefficient(point.quadratic, 0, exact);
      check_coefficient(point.cubic, c / (N * N), exact);
      CHECK(point.criticality == (c < 0 ? Criticality::supercritical : Criticality::subcritical));

      const double y = 0.4;
      const Vector arm = mixing * Vector{{y, 0.5 * y * y, 0.25 * y * y * y}};
      const double p = -c * y * y / 1.3;
      const Branch from_arm = trace(mixed(r, exact), {arm, Vector{{p}}, 0, c < 0 ? -1 : 1}, window(-0.5, 0.5),
                                    {branch_point_monitor()});
      CAPTURE(from_arm.stop.message);
      REQUIRE(from_arm.events.size() >= 1);
      const BranchPoint& same = std::get<BranchPoint>(from_arm.events[0].data);
      check_coefficient(same.crossing, 1.3, exact);
      check_coefficient(same.cubic, c / (N * N), exact);
    }
}

TEST_CASE("a fold where the eigenvalue zero is double has no normal form, but its curvature") {
  // u_1' = u_2, u_2' = p + u_1^2: w . q = 0.
  const auto problem = from_functions(
      2, {parameter("p", 0)}, [](In u, In p, Out F) { F << u[1], p[0] + u[0] * u[0]; },
      [](In u, In, Eigen::Ref<Matrix> J) { J << 0, 1, 2 * u[0], 0; });
  const Branch branch =
      trace(problem, {Vector{{-1.0, 0.0}}, Vector{{-1.0}}, 0, 1}, window(-1, 1), {fold_monitor()});
  REQUIRE(branch.events.size() == 1);
  const Fold& fold = std::get<Fold>(branch.events[0].data);
  CHECK(!fold.quadratic.known());
  CHECK(!fold.unfolding.known());
  CHECK(std::abs(fold.curvature + 2) < 1e-8);
}

TEST_CASE("the normal forms of folds and branch points survive saving") {
  const Reduced r{.linear = 1.3, .cube = -1, .k = 0.3, .m = 0.5};
  Tracer tracer(mixed(r, true), {Vector::Zero(3), Vector{{-1.0}}, 0, 1}, window(-1, 1.2),
                {branch_point_monitor()});
  while (tracer.step()) {
  }
  const State state = state_from_json(to_json(tracer.save()));
  REQUIRE(state.branch.events.size() == 1);
  const BranchPoint &kept = std::get<BranchPoint>(state.branch.events[0].data),
                    &point = std::get<BranchPoint>(tracer.branch().events[0].data);
  CHECK(kept.crossing.value == point.crossing.value);
  CHECK(kept.cubic.error == point.cubic.error);
  CHECK(kept.criticality == Criticality::supercritical);
}
