// Conserved sums of reaction networks by mass action, whose stoichiometry is known.

#include "catch.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/special_points/conserved_sums.hpp>

#include <Eigen/LU>

using namespace problems;

namespace {

using Amounts = std::vector<std::pair<int, double>>;  // species, coefficient

struct Reaction {
  Amounts from, to;
};

struct Network {
  const char* name;
  int species;
  std::vector<Reaction> reactions;
  int sums;  // conserved
  double inflow = 0;
};

// k_r = 1 + 0.3 r, times the parameter k for the first reaction.
std::shared_ptr<const Problem> network_problem(const Network& network, bool exact) {
  Functions f;
  f.size = network.species;
  f.parameters = {parameter("k", 1)};
  const auto rate = [=](In u, In p, std::size_t r) {
    double product = (1 + 0.3 * static_cast<double>(r)) * (r == 0 ? p[0] : 1);
    for (const auto& [i, many] : network.reactions[r].from) product *= std::pow(u[i], many);
    return product;
  };
  f.residual = [=](In u, In p, Out F) {
    F.setConstant(network.inflow);
    for (std::size_t r = 0; r < network.reactions.size(); ++r) {
      for (const auto& [i, many] : network.reactions[r].from) F[i] -= many * rate(u, p, r);
      for (const auto& [i, many] : network.reactions[r].to) F[i] += many * rate(u, p, r);
    }
  };
  if (exact)
    f.sparse_jacobian = [=](In u, In p, SparseMatrix& J) {
      std::vector<Eigen::Triplet<double>> entries;
      for (std::size_t r = 0; r < network.reactions.size(); ++r)
        for (const auto& [j, order] : network.reactions[r].from) {
          const double slope = order * rate(u, p, r) / u[j];
          for (const auto& [i, many] : network.reactions[r].from) entries.emplace_back(i, j, -many * slope);
          for (const auto& [i, many] : network.reactions[r].to) entries.emplace_back(i, j, many * slope);
        }
      J.setFromTriplets(entries.begin(), entries.end());
    };
  return from_functions(std::move(f));
}

Amounts one(std::initializer_list<int> species) {
  Amounts all;
  for (const int each : species) all.emplace_back(each, 1);
  return all;
}

std::vector<Network> networks() {
  return {
      {"isomers", 2, {{one({0}), one({1})}, {one({1}), one({0})}}, 1},
      {"enzyme of Michaelis and Menten: E S C P",
       4,
       {{one({0, 1}), one({2})}, {one({2}), one({0, 1})}, {one({2}), one({0, 3})}},
       2},
      {"association", 3, {{one({0, 1}), one({2})}, {one({2}), one({0, 1})}}, 2},
      {"dimers", 2, {{{{0, 2}}, one({1})}, {one({1}), {{0, 2}}}}, 1},
      {"phosphorylation of one site: S0 S1 E F ES0 FS1",
       6,
       {{one({0, 2}), one({4})},
        {one({4}), one({0, 2})},
        {one({4}), one({1, 2})},
        {one({1, 3}), one({5})},
        {one({5}), one({1, 3})},
        {one({5}), one({0, 3})}},
       3},
      {"phosphorylation of two sites: S0 S1 S2 E F ES0 ES1 FS1 FS2",
       9,
       {{one({0, 3}), one({5})},
        {one({5}), one({0, 3})},
        {one({5}), one({1, 3})},
        {one({1, 3}), one({6})},
        {one({6}), one({1, 3})},
        {one({6}), one({2, 3})},
        {one({2, 4}), one({8})},
        {one({8}), one({2, 4})},
        {one({8}), one({1, 4})},
        {one({1, 4}), one({7})},
        {one({7}), one({1, 4})},
        {one({7}), one({0, 4})}},
       3},
      {"a cycle of three", 3, {{one({0}), one({1})}, {one({1}), one({2})}, {one({2}), one({0})}}, 1},
      {"ozone: O O2 O3", 3, {{one({0, 1}), one({2})}, {one({2}), one({0, 1})}, {one({0, 2}), {{1, 2}}}}, 1},
      {"predator and prey of Lotka", 2, {{one({0}), {{0, 2}}}, {one({0, 1}), {{1, 2}}}, {one({1}), {}}}, 0},
      {"isomers with inflow", 2, {{one({0}), one({1})}, {one({1}), one({0})}, {one({1}), {}}}, 0, 0.5}};
}

}  // namespace

TEST_CASE("the conserved sums of ten reaction networks are those of their stoichiometry") {
  for (const Network& network : networks())
    for (const bool exact : {true, false}) {
      const auto problem = network_problem(network, exact);
      const Vector u = Vector::LinSpaced(network.species, 0.7, 1.4);
      const ConservedSums sums = conserved_sums(*problem, u, Vector{{1.0}});
      CAPTURE(network.name, exact);
      REQUIRE(sums.L.rows() == network.sums);
      CHECK(static_cast<int>(sums.rows.size()) == network.sums);
      for (const Reaction& reaction : network.reactions) {
        Vector change = Vector::Zero(network.species);
        for (const auto& [i, many] : reaction.from) change[i] -= many;
        for (const auto& [i, many] : reaction.to) change[i] += many;
        if (network.sums > 0) CHECK((sums.L * change).norm() < 1e-9);
      }
      if (network.sums > 0) CHECK(sums.L.fullPivLu().rank() == network.sums);
      for (const std::string& words : sums.words) CHECK(!words.empty());
    }
  CHECK(
      conserved_sums(*network_problem(networks()[3], true), Vector{{0.7, 1.4}}, Vector{{1.0}}).words.at(0) ==
      "u[0] + 2 u[1]");
}

TEST_CASE(
    "with its sum for an equation a closed reaction has the branch of its equilibria, over rate and sum") {
  // k a = 1.3 b, a + b = 2 + c.
  for (const bool exact : {true, false}) {
    const Vector u0{{1.5, 0.5}};
    const auto reaction = network_problem(networks()[0], exact);
    const auto closed =
        with_conserved_sums(reaction, conserved_sums(*reaction, u0, Vector{{1.0}}), u0, {"total"});
    CHECK(parameter_index(*closed, "total") == 1);
    for (const int free : {0, 1}) {
      const Branch branch = trace(closed, {u0, Vector{{1.0, 0.0}}, free, 1}, window(free == 0 ? 1 : 0, 3));
      CAPTURE(branch.stop.message, exact, free);
      CHECK(branch.stop.reason == StopReason::boundary);
      CHECK(branch.warnings.empty());
      for (const Point& point : branch.points) {
        const double k = free == 0 ? point.parameter : 1, c = free == 1 ? point.parameter : 0;
        CHECK(std::abs(point.u[0] - 1.3 * (2 + c) / (k + 1.3)) < 1e-9);
        CHECK(std::abs(point.u.sum() - (2 + c)) < 1e-9);
      }
    }
  }
}

TEST_CASE("conserved sums of other sizes, rows, names or Jacobians are refused") {
  const auto reaction = network_problem(networks()[0], true);
  const Vector u{{1.5, 0.5}}, p{{1.0}};
  const auto sums = conserved_sums(*reaction, u, p);
  CHECK_THROWS_WITH(conserved_sums(*reaction, Vector::Ones(3), p),
                    Catch::Matchers::Contains("3 unknowns and 1"));
  CHECK_THROWS_WITH(conserved_sums(*reaction, u, p, 1), Catch::Matchers::Contains("with 1 moved"));
  CHECK_THROWS_WITH(with_conserved_sums(reaction, sums, Vector::Ones(3)),
                    Catch::Matchers::Contains("at 3 unknowns, the problem has 2"));
  CHECK_THROWS_WITH(with_conserved_sums(reaction, sums, u, {"a", "b"}), "2 names for 1 conserved sums");
  CHECK_THROWS_AS(with_conserved_sums(reaction, sums, u, {"k"}), std::invalid_argument);
  CHECK_THROWS_AS(with_conserved_sums(nullptr, sums, u), std::invalid_argument);
  ConservedSums wrong = sums;
  wrong.rows[0] = 2;
  CHECK_THROWS_WITH(with_conserved_sums(reaction, wrong, u),
                    "a conserved sum takes the place of equation 2 of 2");
  ConservedSums twice;
  twice.L = Matrix{{1, 1}, {1, -1}};
  twice.rows = {1, 1};
  CHECK_THROWS_WITH(with_conserved_sums(reaction, twice, u),
                    "two conserved sums take the place of equation 1");
  Functions f;
  f.size = 2;
  f.parameters = {parameter("p", 0)};
  f.residual = [](In x, In, Out F) { F << x[0] - x[1], x[1] - x[0]; };
  f.apply_jacobian = [](In, In, In x, Out y) { y << x[0] - x[1], x[1] - x[0]; };
  const auto applied = from_functions(f);
  CHECK(conserved_sums(*applied, u, p).L.rows() == 1);
  CHECK_THROWS_WITH(with_conserved_sums(applied, sums, u), Catch::Matchers::Contains("which is an operator"));
}
