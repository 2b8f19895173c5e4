// Where a step leaves its window, and the way back to the bound.

#include <arcslip/continuation/tracing/termination.hpp>

#include "catch.hpp"

#include "continuation/problems.hpp"

using namespace problems;

namespace {

CurvePoint place(double u, double p, double du, double dp) {
  CurvePoint at;
  at.v = Vector{{u, p}};
  at.tangent = Vector{{du, dp}}.normalized();
  return at;
}

}  // namespace

TEST_CASE("a step whose ends lie within the window leaves it where its cubic does") {
  // p = x - x^2 on [0, 1], whose cubic it is: beyond 0.21 from x = 0.3 to 0.7, beyond 0.25 nowhere.
  CurvePoint from, to;
  from.v = to.v = Vector{{0.0}};
  from.tangent = Vector{{1.0}};
  to.tangent = Vector{{-1.0}};
  const auto exit = leaves({-1, 0.21}, from, to, 1, false);
  REQUIRE(exit);
  CHECK(std::abs(exit->share - 0.3) < 1e-12);
  CHECK(exit->bound == 0.21);
  CHECK_FALSE(leaves({-1, 0.2501}, from, to, 1, false));
  CHECK_FALSE(leaves({-1, 0.21}, from, to, 1, true));
  to.v[0] = 2;
  const auto straight = leaves({-1, 0.5}, from, to, 1, true);
  REQUIRE(straight);
  CHECK(straight->share == 0.25);
}

TEST_CASE(
    "no branch is left at the window's bound for one near by, which the sign of the determinant reports") {
  // u (u - d) = 0: lines at u = 0, where J = -d, and at u = d, where J = d.
  const double d = 1e-3;
  const auto problem = from_functions(
      1, {parameter("p", 0)}, [=](In u, In, Out F) { F[0] = u[0] * (u[0] - d); },
      [=](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = 2 * u[0] - d; },
      [](In, In, int, Out dF) { dF[0] = 0; });
  Counts counts;
  Corrector with(*problem, Vector{{0.0}}, 0, {}, counts);
  Vector row(2);
  const auto drawn_to = [&](double u, double share, int orientation) -> std::optional<double> {
    CurvePoint from = place(0, 0, 0, 1), beyond = place(u, 1, 0, 1);
    from.piece = beyond.piece = 0;
    if (!correct_to_bound(with, from, {share, share}, orientation, beyond, row)) return {};
    return beyond.v[0];
  };
  CHECK(drawn_to(0, 0.7, -1) == 0);
  CHECK(drawn_to(d, 0.7, 1) == d);
  CHECK_FALSE(drawn_to(d, 0.7, -1));
  CHECK_FALSE(drawn_to(0, 0.7, 1));
  CHECK(drawn_to(d, 0.7, 0) == d);  // where the sign is not known, the distance reports alone
}
