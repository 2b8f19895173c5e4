#include "catch.hpp"

#include "continuation/problems.hpp"

using namespace problems;

TEST_CASE("lambda u - u^3 + eps = 0 is followed without a jump between its branches, eps = 1e-2 to 1e-8") {
  for (double eps = 1e-2; eps > 0.5e-8; eps /= 10) {
    const auto problem = from_functions(1, {parameter("lambda", 0)}, [eps](In u, In p, Out F) {
      F[0] = p[0] * u[0] - std::pow(u[0], 3) + eps;
    });
    CAPTURE(eps);
    // From the left, u ~ -eps/lambda > 0: the branch goes up into u = +sqrt(lambda), without a fold.
    const Branch upper = trace(problem, {Vector::Constant(1, eps), Vector::Constant(1, -1), 0, 1},
                               window(-1, 1), {fold_monitor()});
    CHECK(upper.stop.reason == StopReason::boundary);
    CHECK(upper.points.back().parameter == 1);
    CHECK(upper.points.back().u[0] == Approx(1).margin(eps));
    CHECK(upper.events.empty());
    // From the lower right, u ~ -sqrt(lambda): a fold at lambda = 3 (eps/2)^(2/3), and back along u ~
    // -eps/lambda.
    const Branch lower = trace(problem, {Vector::Constant(1, -1), Vector::Constant(1, 1), 0, -1},
                               window(-1, 1), {fold_monitor()});
    CHECK(lower.stop.reason == StopReason::boundary);
    CHECK(lower.points.back().parameter == 1);
    CHECK(lower.points.back().u[0] == Approx(-eps).margin(2 * eps * eps));
    REQUIRE(lower.events.size() == 1);
    CHECK(std::abs(lower.events[0].point.parameter / (3 * std::pow(eps / 2, 2.0 / 3)) - 1) < 1e-9);
  }
}
