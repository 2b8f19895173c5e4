#include "catch.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/problem/problem_from_functions.hpp>

#include <cmath>

using namespace arcslip::continuation;
using problems::window;

TEST_CASE("derivatives that are not given are central differences, good to 1e-9") {
  const auto problem = from_functions(2, {{"a", "", 2, 1, -1e300, 1e300}}, [](In u, In p, Out F) {
    F[0] = std::exp(u[0]) * u[1] - p[0] * p[0];
    F[1] = std::sin(u[1]) + p[0] * u[0];
  });
  const auto at = problem->evaluator();
  Vector u(2), p(1);
  u << 0.3, -1.1;
  p << 2;
  REQUIRE(at->move_to(u, p, Needs::jacobian) == Evaluated::ok);
  Eigen::MatrixXd J(2, 2);
  J << std::exp(0.3) * -1.1, std::exp(0.3), 2, std::cos(-1.1);
  CHECK((std::get<Matrix>(at->jacobian()) - J).norm() < 1e-9);
  Vector dF(2);
  at->parameter_derivative(0, dF);
  CHECK((dF - Vector{{-4.0, 0.3}}).norm() < 1e-9);
}

TEST_CASE("a NaN of the residual is outside the domain") {
  const auto problem =
      from_functions(1, {{"p", "", 0, 1, -1e300, 1e300}}, [](In u, In, Out F) { F[0] = std::sqrt(u[0]); });
  const auto at = problem->evaluator();
  CHECK(at->move_to(Vector::Constant(1, -1), Vector::Zero(1), Needs::residual) == Evaluated::outside_domain);
}

TEST_CASE("problems without unknowns, without a residual or with other scales are refused") {
  const auto residual = [](In u, In, Out F) { F = u; };
  CHECK_THROWS_WITH(from_functions(0, {}, residual), "a problem has at least 1 unknown, not 0");
  CHECK_THROWS_WITH(from_functions(1, {}, {}), "a problem needs a residual function");
  CHECK_THROWS_WITH(from_functions(1, {}, residual, {}, {}, Vector::Ones(2)), "2 scales for 1 unknowns");
}

TEST_CASE("an unknown parameter is refused with the names that there are") {
  const auto problem =
      from_functions(1, {{"a", "", 1, 1, 0, 2}, {"b", "", 3, 1, 0, 2}}, [](In u, In, Out F) { F = u; });
  CHECK(parameter_index(*problem, "b") == 1);
  CHECK(parameter_values(*problem) == Vector{{1.0, 3.0}});
  CHECK_THROWS_WITH(parameter_index(*problem, "c"), "no parameter \"c\"; there are: a, b");
}

TEST_CASE(
    "a branch by differences comes to the edge of the domain, whether it is determined by NaN or thrown") {
  for (const bool throws : {false, true})
    for (const int direction : {1, -1}) {
      // u = p^3, where |p| <= 1/2.
      const auto problem = from_functions(1, {{"p", ""}}, [=](In u, In p, Out F) {
        if (throws && std::abs(p[0]) > 0.5) throw std::runtime_error("beyond the domain");
        F[0] = u[0] - p[0] * p[0] * p[0] + 0 * std::sqrt(0.5 - std::abs(p[0]));
      });
      const Branch branch = trace(problem, {Vector{{0.0}}, Vector{{0.0}}, 0, direction}, window(-1, 1));
      CAPTURE(throws, direction, branch.stop.message);
      CHECK(branch.stop.reason == StopReason::not_evaluated);
      CHECK(0.5 - std::abs(branch.points.back().parameter) < 1e-9);
      CHECK(branch.stop.message.find("dF/dp") == std::string::npos);
      if (throws) CHECK(branch.stop.message.find("beyond the domain") != std::string::npos);
      // dF/dp by differences to one side is good to h^2: the tangent has du/dp = 3/4.
      const Vector& t = branch.points.back().tangent;
      CHECK(std::abs(t[0] / t[1] - 0.75) < 1e-8);
    }
}

TEST_CASE("scales proposed from the first points make unknowns of any size exact") {
  // u_0 = 1e-11 (1 + p)^(1/2), u_1 = 1e9 / (2 + p), u_2 = p u_0 1e11, u_3 = 0.
  const auto problem = [](Vector scales) {
    Functions f{.size = 4, .parameters = {{"p", ""}}};
    f.residual = [](In u, In p, Out F) {
      F[0] = 1e22 * u[0] * u[0] - 1 - p[0];
      F[1] = 1e-9 * u[1] * (2 + p[0]) - 1;
      F[2] = u[2] - 1e11 * p[0] * u[0];
      F[3] = u[3] * (1 + u[2]);
    };
    f.jacobian = [](In u, In p, Eigen::Ref<Matrix> J) {
      J.setZero();
      J(0, 0) = 2e22 * u[0];
      J(1, 1) = 1e-9 * (2 + p[0]);
      J(2, 0) = -1e11 * p[0];
      J(2, 2) = 1;
      J(3, 2) = u[3];
      J(3, 3) = 1 + u[2];
    };
    f.scales = std::move(scales);
    return from_functions(f);
  };
  const auto points = [&](const Vector& scales, int most) {
    Options options = window(0, 3);
    options.points = most;
    const Branch branch = trace(problem(scales), {Vector{{1e-11, 5e8, 0, 0}}, Vector{{0.0}}, 0, 1}, options);
    REQUIRE(branch.points.size() > 1);
    return branch.points;
  };
  std::vector<Vector> first;
  for (const Point& point : points(Vector::Ones(4), 5)) first.push_back(point.u);
  const Vector scales = proposed_scales(first);
  CHECK(scales[0] / 1e-11 == Approx(1).epsilon(1));
  CHECK(scales[1] / 5e8 == Approx(1).epsilon(0.5));
  CHECK(std::log(scales[3]) == Approx(std::log(scales[0] * scales[1] * scales[2]) / 3));
  const auto all = points(scales, 1000);
  CHECK(all.back().parameter == 3);
  for (const Point& point : all) {
    const double p = point.parameter;
    CHECK(point.u[0] / (1e-11 * std::sqrt(1 + p)) == Approx(1).epsilon(1e-11));
    CHECK(point.u[1] * (2 + p) / 1e9 == Approx(1).epsilon(1e-11));
    CHECK(point.u[2] == Approx(p * std::sqrt(1 + p)).epsilon(1e-11).margin(1e-11));
  }
}

TEST_CASE("scales are not proposed from nothing, from solutions that differ in size or are not finite") {
  CHECK_THROWS_WITH(proposed_scales({}), "scales follow from one solution at least");
  const std::vector<Vector> sizes{Vector::Ones(2), Vector::Ones(3)};
  CHECK_THROWS_WITH(proposed_scales(sizes), "solutions of 2 and of 3 unknowns have no scales in common");
  const std::vector<Vector> endless{Vector::Constant(2, HUGE_VAL)};
  CHECK_THROWS_WITH(proposed_scales(endless), "a solution that scales are to follow from is not finite");
  CHECK(proposed_scales(std::vector<Vector>{Vector::Zero(2)}) == Vector::Ones(2));
  CHECK(proposed_scales(std::vector<Vector>{Vector{{4.0, 1e-17, -9.0}}})
            .isApprox(Vector{{4.0, 6.0, 9.0}}, 1e-15));
}
