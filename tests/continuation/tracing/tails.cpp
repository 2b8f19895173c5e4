// Branches that go to infinity along the end of the window.

#include "catch.hpp"

#include "continuation/problems.hpp"

using namespace problems;

namespace {

// u = lambda e^u: a fold at lambda = 1/e, and then u ~ -ln lambda for lambda -> 0.
std::shared_ptr<const Problem> exponential() {
  return from_functions(
      1, {{"lambda", ""}}, [](In u, In p, Out F) { F[0] = u[0] - p[0] * std::exp(u[0]); },
      [](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = 1 - p[0] * std::exp(u[0]); },
      [](In u, In, int, Out dF) { dF[0] = -std::exp(u[0]); });
}

Start at_zero(int n) {
  return {Vector::Zero(n), Vector{{0.0}}, 0, 1};
}

// -u'' = lambda e^u on n inner nodes.
Functions bratu(int n) {
  const double h2 = 1.0 / ((n + 1.0) * (n + 1.0));
  Functions f;
  f.size = n;
  f.parameters = {{"lambda", ""}};
  f.scales = Vector::Constant(n, std::sqrt(n));
  f.residual = [=](In u, In p, Out F) {
    for (int i = 0; i < n; ++i)
      F[i] = 2 * u[i] - (i ? u[i - 1] : 0) - (i + 1 < n ? u[i + 1] : 0) - h2 * p[0] * std::exp(u[i]);
  };
  f.derivative = [=](In u, In, int, Out dF) { dF = -h2 * u.array().exp(); };
  f.sparse_jacobian = [=](In u, In p, SparseMatrix& J) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) {
      entries.emplace_back(i, i, 2 - h2 * p[0] * std::exp(u[i]));
      if (i) entries.emplace_back(i, i - 1, -1), entries.emplace_back(i - 1, i, -1);
    }
    J.setFromTriplets(entries.begin(), entries.end());
  };
  return f;
}

}  // namespace

TEST_CASE("a fold monitor costs little more in a tail in which the parameter falls to 0") {
  const Branch without = trace(exponential(), at_zero(1), window(0, 1));
  const Branch with = trace(exponential(), at_zero(1), window(0, 1), {fold_monitor()});
  CAPTURE(with.counts.points, with.counts.rejected_steps, with.counts.residuals, without.counts.points);
  CHECK(without.counts.points < 200);
  CHECK(4 * with.counts.points < 5 * without.counts.points);
  CHECK(with.counts.rejected_steps < 50);
  REQUIRE(with.events.size() == 1);
  CHECK(std::abs(with.events[0].point.parameter - std::exp(-1.0)) < 1e-15);
}

TEST_CASE("a branch that goes to infinity along the end of its window is not said to reach a point there") {
  for (const auto& monitors : {std::vector<Monitor>{}, std::vector<Monitor>{fold_monitor()}})
    for (const int n : {1, 100}) {
      const auto problem = n == 1 ? exponential() : from_functions(bratu(n));
      const Branch branch = trace(problem, at_zero(n), window(0, 4), monitors);
      CAPTURE(n, branch.stop.message, branch.counts.points, branch.counts.factorizations);
      CHECK(branch.stop.reason == StopReason::boundary);
      CHECK(branch.stop.value > 0);
      CHECK(branch.stop.value < 1e-11);
      CHECK(branch.stop.message.find("without reaching it: the branch goes to infinity") !=
            std::string::npos);
      CHECK(branch.counts.factorizations < 600);
    }
}

TEST_CASE("a singular point at the end of the window is reached, and is not said to be at infinity") {
  for (const int power : {3, 5, 7}) {
    const auto problem = from_functions(
        1, {parameter("p", 0)}, [=](In u, In p, Out F) { F[0] = p[0] - std::pow(u[0], power); },
        [=](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = -power * std::pow(u[0], power - 1); },
        [](In, In, int, Out dF) { dF[0] = 1; });
    const Branch branch = trace(problem, {Vector{{1.0}}, Vector{{1.0}}, 0, -1}, window(0, 2));
    CAPTURE(power, branch.stop.message);
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.stop.message.find("infinity") == std::string::npos);
    CHECK(std::abs(branch.points.back().parameter) < 1e-5);
  }
}
