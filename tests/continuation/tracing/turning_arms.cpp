// Branches that turn where another one crosses them: a branch point, and no fold.

#include "continuation/diagrams/diagram_problems.hpp"

#include <Eigen/LU>

using namespace problems;

namespace {

// u (u^2 + lambda^2 - 1) = 0: a circle, and a line through both ends of it.
std::shared_ptr<const Problem> circle_and_line() {
  return scalar([](double u, double l) { return u * (u * u + l * l - 1); },
                [](double u, double l) { return 3 * u * u + l * l - 1; },
                [](double u, double l) { return 2 * l * u; });
}

Monitor parameter_extreme() {
  return {.name = "extreme",
          .value = [](const Accepted& now) { return now.tangent[now.tangent.size() - 1]; },
          .quantity = [](const Accepted& now) { return now.parameter; }};
}

// AUTO-07p's demo enz: two equal cells, coupled, s_i' = s_0 - s_i + (s_j - s_i) - 100 R(s_i).
double rate(double s) {
  return 100 * s / (1 + s + s * s);
}
double rate_slope(double s) {
  return 100 * (1 - s * s) / std::pow(1 + s + s * s, 2);
}
Functions enzymes(bool exact) {
  Functions f{.size = 2, .parameters = {parameter("s0", 0)}, .residual = [](In u, In p, Out F) {
                F[0] = p[0] - u[0] + (u[1] - u[0]) - rate(u[0]);
                F[1] = p[0] - u[1] + (u[0] - u[1]) - rate(u[1]);
              }};
  if (!exact) return f;
  f.jacobian = [](In u, In, Eigen::Ref<Matrix> J) {
    J << -2 - rate_slope(u[0]), 1, 1, -2 - rate_slope(u[1]);
  };
  f.derivative = [](In, In, int, Out dF) { dF.setOnes(); };
  return f;
}
Eigen::Matrix2d enzyme_jacobian(const Vector& u) {
  return Eigen::Matrix2d{{-2 - rate_slope(u[0]), 1}, {1, -2 - rate_slope(u[1])}};
}

}  // namespace

TEST_CASE("a circle that turns where a line crosses it has two branch points and no fold") {
  for (double start : {0.3, 0.31, 0.47, -0.2, 0.777})
    for (int direction : {1, -1})
      for (double side : {1.0, -1.0}) {
        const Branch branch =
            trace(circle_and_line(), at(side * std::sqrt(1 - start * start), start, direction), window(-2, 2),
                  {fold_monitor(), branch_point_monitor(), parameter_extreme()});
        CAPTURE(start, direction, side);
        CHECK(branch.stop.reason == StopReason::closed);
        CHECK(largest(branch, [](double u, double l) { return u * u + l * l - 1; }) < 1e-12);
        REQUIRE(branch.events.size() == 4);
        for (const Event& event : branch.events) {
          CHECK(event.monitor != "fold");
          CHECK(event.located);
          CHECK(std::abs(std::abs(event.point.parameter) - 1) < 1e-12);
          CHECK(std::abs(event.point.u[0]) < 1e-12);
          CHECK(std::abs(std::abs(event.point.tangent[0]) - 1) < 1e-9);
          if (const auto* crossing = std::get_if<BranchPoint>(&event.data))
            CHECK(crossing->type == BranchPoint::Type::pitchfork);
        }
        CHECK(trace(circle_and_line(), at(side * std::sqrt(1 - start * start), start, direction),
                    window(-2, 2), {fold_monitor()})
                  .events.empty());
      }
}

TEST_CASE("next to a branch point a fold is a fold: (u - d)(lambda - u^2)") {
  for (double d : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    const auto problem = from_functions(
        1, {parameter("lambda", 0)}, [=](In u, In p, Out F) { F[0] = (u[0] - d) * (p[0] - u[0] * u[0]); },
        [=](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = p[0] - u[0] * u[0] - 2 * u[0] * (u[0] - d); },
        [=](In u, In, int, Out dF) { dF[0] = u[0] - d; });
    for (double sign : {1.0, -1.0}) {
      const Branch branch =
          trace(problem, at(sign * 0.9, 0.81, -1), window(-1, 1), {fold_monitor(), branch_point_monitor()});
      CAPTURE(d, sign);
      CHECK(branch.stop.reason == StopReason::boundary);
      CHECK(largest(branch, [](double u, double l) { return u * u - l; }) < 1e-12);
      REQUIRE(branch.events.size() == 2);
      const Event& fold = branch.events[sign > 0 ? 1 : 0];
      const Event& crossing = branch.events[sign > 0 ? 0 : 1];
      CHECK(fold.monitor == "fold");
      CHECK(fold.located);
      CHECK(std::abs(fold.point.parameter) < 1e-12);
      CHECK(std::abs(fold.point.u[0]) < 1e-2 * d);
      CHECK(std::get<Fold>(fold.data).curvature == Approx(2).epsilon(1e-4));
      CHECK(crossing.monitor == "branch_point");
      CHECK(crossing.point.u[0] == Approx(d).epsilon(1e-9));
      CHECK(crossing.point.parameter == Approx(d * d).epsilon(1e-9));
    }
  }
}

TEST_CASE("two coupled enzymes have six folds, whatever the Jacobian's source, and none at a branch point") {
  std::vector<double> curvatures;
  for (const bool exact : {true, false})
    for (double upper : {50.0, 57.0, 60.0}) {
      const Diagram diagram =
          trace_diagram(from_functions(enzymes(exact)), {Vector::Zero(2), Vector{{0.0}}, 0, 1},
                        window(0, upper), {.depth = 2}, {fold_monitor()});
      CAPTURE(exact, upper, diagram.message);
      CHECK(diagram.complete);
      REQUIRE(diagram.branches.size() == 2);
      CHECK(diagram.branch_points.size() == 2);
      for (const Junction& junction : diagram.branch_points)  // equal cells: 1 + R' + 2 = 0
        CHECK(std::abs(3 + rate_slope(junction.u[0])) < 1e-8);
      const auto equal = events_named(diagram.branches[0].branch, "fold");
      const auto unequal = events_named(diagram.branches[1].branch, "fold");
      REQUIRE(equal.size() == 2);
      REQUIRE(unequal.size() == 4);
      for (const Event& fold : equal) CHECK(std::abs(1 + rate_slope(fold.point.u[0])) < 1e-7);
      std::vector<double> now;
      for (const Event& fold : unequal) {
        const Vector& u = fold.point.u;
        CHECK(fold.located);
        CHECK(std::abs(u[0] - u[1]) > 1);
        CHECK(std::abs(enzyme_jacobian(u).determinant()) < 1e-6);
        now.push_back(std::get<Fold>(fold.data).curvature);
      }
      std::sort(now.begin(), now.end());
      if (curvatures.empty()) curvatures = now;
      for (std::size_t i = 0; i < now.size(); ++i) CHECK(now[i] == Approx(curvatures[i]).epsilon(1e-4));
    }
}
