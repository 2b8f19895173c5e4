#include "catch.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/special_points/stationary.hpp>

#include <numbers>

using namespace problems;

namespace {

constexpr int over_mu = 0, over_lambda = 1;

// The curve of folds in mu through a fold of the branch at lambda = 1, over lambda.
Branch fold_curve(const MakeLinearSolver& solver = {}) {
  const auto problem = cusp();
  const Vector p = Vector{{-1.0, 1.0}};
  const Branch branch =
      trace(problem, {Vector::Constant(1, -1.3), p, over_mu, 1}, window(-1, 1), {fold_monitor()});
  REQUIRE(events_named(branch, "fold").size() == 2);
  Options options = window(-1, 2);
  return trace(folds(problem, over_mu, solver), {with_parameter(branch.events[0].point), p, over_lambda, -1},
               options, {cusp_monitor()});
}

}  // namespace

TEST_CASE("the folds of mu + lambda x - x^3 lie on mu^2 = 4/27 lambda^3, and turn at a cusp at 0") {
  const Branch curve = fold_curve();
  REQUIRE(curve.stop.reason == StopReason::boundary);
  REQUIRE(curve.points.size() > 20);
  for (const Point& point : curve.points) {
    const double x = point.u[0];
    CHECK(std::abs(point.parameter - 3 * x * x) < 1e-10);
    CHECK(std::abs(point.u[1] + 2 * x * x * x) < 1e-10);
  }
  CHECK(curve.points.back().parameter == Approx(2).margin(1e-12));
  const auto cusps = events_named(curve, "cusp");
  REQUIRE(cusps.size() == 1);
  CHECK(std::abs(cusps[0].point.u[0]) < 1e-8);
  CHECK(std::abs(cusps[0].point.parameter) < 1e-10);
}

TEST_CASE("second derivatives of the problem's own give the curve of folds without evaluations next to it") {
  const double x = 0.5;
  for (const bool given : {true, false}) {
    int jacobians = 0;
    Functions f;
    f.size = 1;
    f.parameters = {parameter("mu", 0), parameter("lambda", 1)};
    f.residual = [](In u, In p, Out F) { F[0] = p[0] + p[1] * u[0] - std::pow(u[0], 3); };
    f.jacobian = [&](In u, In p, Eigen::Ref<Matrix> J) {
      ++jacobians;
      J(0, 0) = p[1] - 3 * u[0] * u[0];
    };
    f.derivative = [](In u, In, int k, Out dF) { dF[0] = k == over_mu ? 1 : u[0]; };
    if (given)
      f.second = [](In u, In, In w, In v, In q, Out du, Out dp) {
        du[0] = w[0] * (-6 * u[0] * v[0] + q[over_lambda]);
        dp << 0, w[0] * v[0];
      };
    const auto at = folds(from_functions(f), over_mu)->evaluator();
    const Vector place{{x, -2 * x * x * x}}, p{{0.0, 3 * x * x}};
    REQUIRE(at->move_to(place, p, Needs::jacobian) == Evaluated::ok);
    CHECK(jacobians == (given ? 1 : 3));
    // t = (1 / c_0, 0) with the row c: G = 0, G_u = 6 x / c_0, G_lambda = -1 / c_0.
    Vector right{{1.0, 0.0}}, product(2), by_lambda(2);
    apply(at->jacobian(), right, product);
    at->parameter_derivative(over_lambda, by_lambda);
    CHECK(std::abs(at->residual()[1]) < 1e-15);
    CHECK(std::abs(product[1] / by_lambda[1] + 6 * x) < (given ? 1e-14 : 1e-9));
    CHECK(jacobians == (given ? 1 : 3));
  }
}

TEST_CASE("next to a kink, and between two, the curve of folds has the derivatives of its own piece") {
  // p - lambda u^2 - max(0, u - d): a fold at u = 0 of p'' = 2 lambda on its piece, u < d or |u| < d.
  for (const bool both : {false, true})
    for (double d : {1e-4, 5e-6, 1e-7}) {
      const auto beyond = [=](double u) { return u > d ? 1.0 : both && u < -d ? -1.0 : 0.0; };
      const auto problem = from_functions(
          {.size = 1,
           .parameters = {parameter("p", 0), parameter("lambda", 1)},
           .residual =
               [=](In u, In p, Out F) {
                 F[0] = p[0] - p[1] * u[0] * u[0] - beyond(u[0]) * (u[0] - beyond(u[0]) * d);
               },
           .jacobian = [=](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = -2 * p[1] * u[0] - beyond(u[0]); },
           .derivative = [](In u, In, int k, Out dF) { dF[0] = k == 0 ? 1 : -u[0] * u[0]; },
           .piece = [=](In u, In) { return static_cast<std::uint64_t>(2 + beyond(u[0])); }});
      std::vector<double> seconds;
      const Monitor second = cusp_monitor();
      const Branch curve = trace(folds(problem, 0), {Vector{{0.0, 0.0}}, Vector{{0.0, 1.0}}, 1, 1},
                                 window(1, 2), {}, [&](const Accepted& now, const Event*) {
                                   seconds.push_back(second.value(now) / now.parameter);
                                   return true;
                                 });
      CAPTURE(both, d, curve.stop.message);
      REQUIRE(curve.stop.reason == StopReason::boundary);
      for (double each : seconds) CHECK(std::abs(each / seconds.front() - 1) < 1e-9);
      for (const Point& point : curve.points) CHECK(point.u.norm() < 1e-13);
    }
}
