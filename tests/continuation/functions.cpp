#include "catch.hpp"

#include <arcslip/continuation/functions.hpp>

#include <cmath>

using namespace arcslip::continuation;

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
