#include "catch.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/problem/jacobian_check.hpp>

using namespace problems;

namespace {

// F = (a u0^2 u1, u0 + sin(u1)), with one entry of J or dF/da spoilt.
JacobianError check(int row, int column, double factor) {
  const auto problem = from_functions({.size = 2,
                                       .parameters = {parameter("a", 3)},
                                       .residual =
                                           [](In u, In p, Out F) {
                                             F[0] = p[0] * u[0] * u[0] * u[1];
                                             F[1] = u[0] + std::sin(u[1]);
                                           },
                                       .jacobian =
                                           [=](In u, In p, Eigen::Ref<Matrix> J) {
                                             J << 2 * p[0] * u[0] * u[1], p[0] * u[0] * u[0], 1,
                                                 std::cos(u[1]);
                                             if (column < 2) J(row, column) *= factor;
                                           },
                                       .derivative =
                                           [=](In u, In, int, Out dF) {
                                             dF << u[0] * u[0] * u[1], 0;
                                             if (column == 2) dF[row] *= factor;
                                           }});
  return check_jacobian(*problem, Vector{{0.7, 0.4}}, Vector{{3.0}});
}

}  // namespace

TEST_CASE("a right Jacobian agrees with differences to 1e-9, and nothing is said") {
  const JacobianError worst = check(0, 0, 1);
  CHECK(worst.relative < 1e-9);
  CHECK(worst.message.empty());
}

TEST_CASE("the worst entry of a wrong Jacobian is named, in u and in the parameters") {
  const JacobianError in_u = check(1, 1, -1);
  CHECK(in_u.row == 1);
  CHECK(in_u.column == 1);
  CHECK(in_u.given == Approx(-std::cos(0.4)));
  CHECK(in_u.difference == Approx(std::cos(0.4)).epsilon(1e-9));
  CHECK(in_u.message ==
        "the Jacobian is wrong: dF[1]/du[1] is given as -0.921061, finite differences give 0.921061");
  const JacobianError in_a = check(0, 2, 2);
  CHECK(in_a.message == "the Jacobian is wrong: dF[0]/d(a) is given as 0.392, finite differences give 0.196");
}

TEST_CASE("differences across a kink accuse nobody") {
  const auto problem =
      from_functions({.size = 1,
                      .parameters = {parameter("p", 0)},
                      .residual = [](In u, In p, Out F) { F[0] = std::abs(u[0]) - p[0]; },
                      .jacobian = [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = u[0] < 0 ? -1 : 1; },
                      .derivative = [](In, In, int, Out dF) { dF[0] = -1; },
                      .piece = [](In u, In) { return u[0] < 0 ? 1 : 2; }});
  CHECK(check_jacobian(*problem, Vector{{1e-9}}, Vector{{1e-9}}).message.empty());
}
