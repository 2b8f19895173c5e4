// What is said to those who use the library in ways that cannot work.

#include "catch.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/linear/linear_solvers.hpp>
#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/continuation/special_points/branch_point.hpp>
#include <arcslip/continuation/special_points/hopf_curve.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>

using namespace problems;

namespace {

std::shared_ptr<const Problem> line(double lower = -1e300, double upper = 1e300) {
  return from_functions(1, {{"p", "", 0, 1, lower, upper}}, [](In u, In p, Out F) { F[0] = u[0] - p[0]; });
}

Start start_at(double p) {
  return {Vector{{p}}, Vector{{p}}, 0, 1};
}

}  // namespace

TEST_CASE("no problem at all is refused") {
  const std::shared_ptr<const Problem> none;
  CHECK_THROWS_WITH(trace(none, start_at(0), window(0, 1)), "no problem is given");
  CHECK_THROWS_WITH(Tracer(none, State{}, window(0, 1)), "no problem is given");
  CHECK_THROWS_WITH(folds(none, 0), "no problem is given");
  CHECK_THROWS_WITH(branch_points(none, 0, Vector::Ones(1)), "no problem is given");
  CHECK_THROWS_WITH(hopf_points(none, 0, 1), "no problem is given");
  CHECK_THROWS_WITH(locate_branch_point(none, Vector{{0.0}}, 0, Vector{{0.0, 0.0}}), "no problem is given");
}

TEST_CASE("a start outside the bounds of its parameter, and bounds that leave no window, are refused") {
  CHECK_THROWS_WITH(trace(line(0.5, 1), start_at(0.2), window(0, 3)),
                    "the start is at 0.2, outside the bounds [0.5, 1] of the parameter \"p\"");
  CHECK_THROWS_WITH(trace(line(2, 1), start_at(1.5), window(0, 3)),
                    "the window [0, 3] has no part within the bounds [2, 1] of the parameter \"p\"");
  CHECK_THROWS_WITH(trace(line(4, 5), start_at(1.5), window(0, 3)),
                    "the window [0, 3] has no part within the bounds [4, 5] of the parameter \"p\"");
}

TEST_CASE("a tangent that is zero says nothing of the way to go") {
  Start start = start_at(0);
  start.tangent = Vector::Zero(2);
  CHECK_THROWS_WITH(trace(line(), start, window(0, 1)), "the tangent of the start is zero");
}

TEST_CASE("a parameter that is an unknown of a curve of special points cannot be free on it") {
  const auto curve = folds(cusp(), 0);
  CHECK_THROWS_WITH(trace(curve, {Vector{{0.5, -0.25}}, Vector{{0.0, 0.75}}, 0, 1}, window(-1, 1)),
                    "the parameter \"mu\" is among the unknowns of this problem: another one has to be free");
  const auto swallowtail = from_functions(
      1, {parameter("mu", 0), parameter("lambda", 0), parameter("c", 0)},
      [](In u, In p, Out F) { F[0] = p[0] + p[1] * u[0] - std::pow(u[0], 3) + p[2] * std::pow(u[0], 4); });
  for (int free : {0, 1})
    CHECK_THROWS_AS(
        trace(folds(folds(swallowtail, 0), 1), {Vector::Zero(3), Vector::Zero(3), free, 1}, window(-1, 1)),
        std::invalid_argument);
}

TEST_CASE("a monitor without a value, or of an unknown that there is not, is said") {
  Monitor empty;
  empty.name = "heat";
  CHECK_THROWS_WITH(trace(line(), start_at(0), window(0, 1), {empty}),
                    "the monitor \"heat\" has no value function");
  for (int index : {-1, 1, 7}) {
    const Branch branch = trace(line(), start_at(0), window(0, 1), {bound_monitor("far", index, 0.5)});
    CHECK(branch.stop.reason == StopReason::monitor_failed);
    CHECK(branch.stop.message ==
          "the monitor \"far\" threw at 0: there is no unknown " + std::to_string(index) + " among 1");
  }
}

TEST_CASE("a linear solver for another kind of Jacobian is named, on branches and on curves of folds") {
  Options options = window(-1, 1);
  options.linear_solver = klu;
  const Branch branch = trace(line(), start_at(0), options);
  CHECK(branch.stop.reason == StopReason::start_failed);
  CHECK(branch.stop.message.find("KLU takes sparse Jacobians") != std::string::npos);
  options.linear_solver = dense_lu;
  const Branch curve = trace(folds(cusp(), 0), {Vector{{-0.577, 0.385}}, Vector{{0.0, 1.0}}, 1, -1}, options);
  CHECK(curve.stop.message.find("dense LU takes dense Jacobians") != std::string::npos);
}

TEST_CASE("a sparse Jacobian of another size is said") {
  Functions f;
  f.size = 2;
  f.parameters = {parameter("p", 0)};
  f.residual = [](In u, In p, Out F) { F = u.array() - p[0]; };
  f.sparse_jacobian = [](In, In, SparseMatrix& J) {
    J.resize(3, 3);
    J.setIdentity();
  };
  const Branch branch = trace(from_functions(f), {Vector::Zero(2), Vector::Zero(1), 0, 1}, window(0, 1));
  CHECK(branch.stop.message ==
        "the problem could not be evaluated at the start: the sparse Jacobian is 3 x 3 for 2 unknowns");
}

TEST_CASE("second derivatives that are not finite are not taken: the fold is described by differences") {
  Functions f;
  f.size = 1;
  f.parameters = {parameter("p", 0)};
  f.residual = [](In u, In p, Out F) { F[0] = p[0] - u[0] * u[0]; };
  f.jacobian = [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = -2 * u[0]; };
  f.second = [](In, In, In, In, In, Out du, Out dp) {
    du[0] = std::nan("");
    dp[0] = 0;
  };
  const Branch branch =
      trace(from_functions(f), {Vector{{-1.0}}, Vector{{1.0}}, 0, -1}, window(-1, 2), {fold_monitor()});
  REQUIRE(branch.events.size() == 1);
  CHECK(std::abs(std::get<Fold>(branch.events[0].data).curvature - 2) < 1e-9);
}

TEST_CASE(
    "places of another size than the problem's are refused where branch points and Jacobians are asked for") {
  CHECK_THROWS_WITH(locate_branch_point(line(), Vector(0), 0, Vector{{0.0, 0.0}}),
                    "0 parameters are given, the problem has 1");
  CHECK_THROWS_WITH(locate_branch_point(line(), Vector{{0.0}}, 0, Vector{{0.0}}),
                    "the guess has 1 entries, needs 1 unknowns and a parameter");
  CHECK_THROWS_WITH(check_jacobian(*line(), Vector{{0.0, 1.0}}, Vector{{0.0}}),
                    "the point has 2 unknowns and 1 parameters, the problem has 1 and 1");
}

TEST_CASE("a direction that is neither +1 nor -1 is refused") {
  for (const int direction : {0, 5, -2}) {
    Start start = start_at(0);
    start.direction = direction;
    CHECK_THROWS_WITH(trace(line(), start, window(0, 1)),
                      "the direction of the start is " + std::to_string(direction) + ", must be +1 or -1");
  }
}

TEST_CASE("parameters of one name, and a problem without any, are refused") {
  const ResidualFunction residual = [](In u, In p, Out F) { F[0] = u[0] - (p.size() > 0 ? p[0] : 0); };
  const auto twice = [&] {
    return from_functions(1, {parameter("a", 0), parameter("b", 0), parameter("a", 1)}, residual);
  };
  CHECK_THROWS_AS(twice(), std::invalid_argument);
  CHECK_THROWS_WITH(twice(), "the parameters 0 and 2 are both called \"a\"");
  CHECK_THROWS_AS(from_functions(1, {}, residual), std::invalid_argument);
  CHECK_THROWS_WITH(from_functions(1, {}, residual), "the problem has no parameters: one has to be free");
}

TEST_CASE("a start on a fold is reported to need a tangent, and one on a branch point to be on one") {
  const auto parabola = from_functions(
      1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = p[0] - u[0] * u[0]; },
      [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = -2 * u[0]; });
  const auto pitchfork = from_functions(
      1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = u[0] * (p[0] - u[0] * u[0]); },
      [](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = p[0] - 3 * u[0] * u[0]; });
  for (const auto& problem : {parabola, pitchfork})
    for (const double u : {0.0, 1e-3}) {
      const Branch branch = trace(problem, {Vector{{u}}, Vector{{0.0}}, 0, 1}, window(-1, 1));
      CAPTURE(u, branch.stop.message);
      CHECK(branch.stop.reason == StopReason::start_failed);
      const bool on_branch_point = problem == pitchfork && u == 0;
      CHECK(branch.stop.message.find(on_branch_point
                                         ? "it is a branch point"
                                         : "a start needs a tangent (Start::tangent)") != std::string::npos);
    }
  Start start{Vector{{0.0}}, Vector{{0.0}}, 0, 1, Vector{{1.0, 0.0}}};
  CHECK(trace(parabola, start, window(-1, 1)).stop.reason == StopReason::boundary);
}
