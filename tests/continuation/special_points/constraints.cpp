// Problems with constraints, whose parameters are found by name.

#include "catch.hpp"

#include "continuation/linear/users_solvers.hpp"
#include "continuation/tracing/softening.hpp"

#include <arcslip/continuation/diagrams/diagram.hpp>
#include <arcslip/continuation/special_points/constraints.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>

#include <cmath>
#include <numbers>
#include <string>

using namespace problems;

namespace {

// A pendulum that is held at the angle u by the torque.
std::shared_ptr<const Problem> pendulum() {
  return from_functions(
      1, {parameter("torque", 0), parameter("weight", 1)},
      [](In u, In p, Out F) { F[0] = p[1] * std::sin(u[0]) - p[0]; },
      [](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = p[1] * std::cos(u[0]); },
      [](In u, In, int k, Out dF) { dF[0] = k == 0 ? -1 : std::sin(u[0]); });
}

Constraint energy() {
  return {.level = parameter("energy", 0),
          .value = [](In u, In p) { return p[1] * (1 - std::cos(u[0])); },
          .gradient = [](In u, In p, Out gradient) { gradient[0] = p[1] * std::sin(u[0]); },
          .derivative = [](In u, In, int k) { return k == 0 ? 0 : 1 - std::cos(u[0]); }};
}

// Two phases of a given mass: eps^2 u'' - u^3 + u + chemical = 0 at n cells, without flux at the ends.
constexpr int cells = 200;
constexpr double eps = 0.15;

Functions phases() {
  const double d = eps * eps * cells * cells;
  Functions f;
  f.size = cells;
  f.parameters = {parameter("chemical", 0)};
  f.residual = [=](In u, In p, Out F) {
    for (int i = 0; i < cells; ++i) {
      const double left = i > 0 ? u[i - 1] : u[i], right = i + 1 < cells ? u[i + 1] : u[i];
      F[i] = d * (left - 2 * u[i] + right) + u[i] - u[i] * u[i] * u[i] + p[0];
    }
  };
  f.sparse_jacobian = [=](In u, In, SparseMatrix& J) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < cells; ++i) {
      const int neighbours = (i > 0) + (i + 1 < cells);
      entries.emplace_back(i, i, 1 - 3 * u[i] * u[i] - d * neighbours);
      if (i > 0) entries.emplace_back(i, i - 1, d);
      if (i + 1 < cells) entries.emplace_back(i, i + 1, d);
    }
    J.setFromTriplets(entries.begin(), entries.end());
  };
  f.derivative = [](In, In, int, Out dF) { dF.setOnes(); };
  f.scales = Vector::Constant(cells, std::sqrt(cells));
  return f;
}

// The k-th mode of the cells, with the eigenvalue -eps^2 mu, bends u = mass where 1 - 3 mass^2 = eps^2 mu.
double branching_mass(int k) {
  const double mu = std::pow(2 * cells * std::sin(k * std::numbers::pi / (2 * cells)), 2);
  return std::sqrt((1 - eps * eps * mu) / 3);
}

std::shared_ptr<const Problem> of_given_mass(std::shared_ptr<const Problem> problem) {
  return with_constraints(std::move(problem),
                          {weighted_sum(parameter("mass", -0.9), Vector::Constant(cells, 1.0 / cells))},
                          {"chemical"});
}

Start uniform(double mass) {
  Vector x(cells + 1);
  x << Vector::Constant(cells, mass), mass * mass * mass - mass;
  return {.u = x, .p = Vector{{0.0, mass}}, .free = "mass"};
}

}  // namespace

TEST_CASE("the torque of a pendulum follows from its energy, past the fold that it has in the torque") {
  const bool by_differences = GENERATE(false, true);
  Constraint of = energy();
  if (by_differences) of = {.level = of.level, .value = of.value};
  const auto problem = with_constraints(pendulum(), {of}, {"torque"});
  const Start start{.u = Vector{{0.5, 0.5}}, .p = Vector{{0, 1, 0.1}}, .free = "energy"};
  const Branch branch = trace(problem, start, window(0.1, 1.9), {fold_monitor()});
  REQUIRE(branch.stop.reason == StopReason::boundary);
  CHECK(branch.points.back().parameter == 1.9);
  CHECK(branch.events.empty());
  CHECK(branch.warnings.empty());
  for (const Point& point : branch.points) {
    const double e = point.parameter, angle = std::acos(1 - e);
    CHECK(std::abs(point.u[0] - angle) < 1e-12);
    CHECK(std::abs(point.u[1] - std::sqrt(e * (2 - e))) < 1e-12);
    CHECK(std::abs(point.tangent[0] * std::sin(angle) - point.tangent[2]) < 1e-8);
    CHECK(std::abs(point.tangent[1] - point.tangent[0] * std::cos(angle)) < 1e-8);
  }
}

TEST_CASE("a level that is freed is an outcome, and any other parameter may be free") {
  const auto problem = with_constraints(pendulum(), {energy()}, {"energy"});
  const Start start{.u = Vector{{0.1, 0.0}}, .p = Vector{{0.1, 1, 0}}, .free = "torque"};
  const Branch branch = trace(problem, start, window(-0.5, 2), {fold_monitor()});
  const auto folds = events_named(branch, fold_event);
  REQUIRE(!folds.empty());
  CHECK(std::abs(folds[0].point.parameter - 1) < 1e-12);
  CHECK(std::abs(folds[0].point.u[1] - 1) < 1e-8);
  for (const Point& point : branch.points) CHECK(std::abs(point.u[1] - (1 - std::cos(point.u[0]))) < 1e-12);

  const auto heavy = with_constraints(pendulum(), {energy()}, {"torque"});
  const Start held{.u = Vector{{1.0, 0.8}}, .p = Vector{{0, 1, 0.5}}, .free = "weight"};
  const Branch heavier = trace(heavy, held, window(0.3, 4));
  REQUIRE(heavier.stop.reason == StopReason::boundary);
  for (const Point& point : heavier.points) {
    const double w = point.parameter;
    CHECK(std::abs(std::cos(point.u[0]) - (1 - 0.5 / w)) < 1e-12);
    CHECK(std::abs(point.u[1] - w * std::sin(point.u[0])) < 1e-12);
  }
}

TEST_CASE("two constraints free two parameters, in the order of their names") {
  const auto inner = from_functions(
      3, {parameter("a", 1), parameter("b", 1), parameter("c", 1)},
      [](In u, In p, Out F) { F << u[0] - p[0] - p[1], u[1] - p[0] + p[1], u[2] - p[0] * p[1] * p[2]; });
  const Constraint third{.level = parameter("third", 2), .value = [](In u, In) { return u[2] * u[2]; }};
  const Constraint sum = weighted_sum(parameter("sum", 3), Vector{{1, 1, 0}});
  const auto problem = with_constraints(inner, {sum, third}, {"c", "a"});
  CHECK(parameter_index(*problem, "sum") == 3);
  CHECK(parameter_index(*problem, "third") == 4);
  const Vector p = parameter_values(*problem);
  const Start start{.u = Vector{{2, 1, 1, 1, 1}}, .p = p, .free = "b"};
  const Branch by_b = trace(problem, start, window(0.5, 3));
  REQUIRE(by_b.stop.reason == StopReason::boundary);
  for (const Point& point : by_b.points) {
    CHECK(std::abs(point.u[4] - 1.5) < 1e-11);                                       // a = sum / 2
    CHECK(std::abs(point.u[3] - std::sqrt(2.0) / (1.5 * point.parameter)) < 1e-11);  // c
  }
  const Branch by_third = trace(problem, {.u = start.u, .p = p, .free = "third"}, window(0.5, 4));
  for (const Point& point : by_third.points)
    CHECK(std::abs(point.u[3] - std::sqrt(point.parameter) / 1.5) < 1e-11);
}

TEST_CASE("phases of a given mass separate where their modes say, with the sparse solver of their problem") {
  const auto problem = of_given_mass(from_functions(phases()));
  const Branch branch = trace(problem, uniform(-0.9), window(-0.9, -0.05), {branch_point_monitor()});
  CHECK(branch.linear_solver == "KLU");
  REQUIRE(branch.stop.reason == StopReason::boundary);
  REQUIRE(branch.events.size() == 2);  // 0.15^2 (3 pi)^2 is larger than 1
  for (int k = 1; k <= 2; ++k) {
    const Event& event = branch.events[static_cast<std::size_t>(k - 1)];
    CHECK(std::abs(event.point.parameter + branching_mass(k)) < 1e-10);
    CHECK(std::get<BranchPoint>(event.data).type == BranchPoint::Type::pitchfork);
  }
  for (const Point& point : branch.points)
    CHECK(std::abs(point.u[cells] - (std::pow(point.parameter, 3) - point.parameter)) < 1e-12);

  const Diagram diagram = trace_diagram(problem, uniform(-0.9), window(-0.9, -0.05), {.depth = 1});
  CHECK(diagram.complete);
  REQUIRE(diagram.branches.size() == 3);
  for (const DiagramBranch& each : diagram.branches)
    for (const Point& point : each.branch.points)
      CHECK(std::abs(point.u.head(cells).mean() - point.parameter) < 1e-12);
}

TEST_CASE("constraints border whichever solver their problem has") {
  Functions f = phases();
  f.linear_solver = users::without_sign();
  const Branch branch = trace(of_given_mass(from_functions(f)), uniform(-0.9), window(-0.9, -0.5));
  REQUIRE(branch.stop.reason == StopReason::boundary);
  for (const Point& point : branch.points)
    CHECK((point.u.head(cells).array() - point.parameter).matrix().lpNorm<Eigen::Infinity>() < 1e-12);
}

TEST_CASE("a phase condition and a speed take the place of a symmetry of rotation") {
  // z' = (mu + 2 i) z - (1 - i) |z|^2 z - i speed z
  const auto waves = from_functions(2, {parameter("mu", 0.1), parameter("speed", 2)}, [](In u, In p, Out F) {
    const double r2 = u.squaredNorm(), turn = 2 + r2 - p[1];
    F << (p[0] - r2) * u[0] - turn * u[1], (p[0] - r2) * u[1] + turn * u[0];
  });
  const Vector reference{{0.3, 0.1}}, along{{-0.1, 0.3}};
  const auto pinned =
      with_constraints(waves, {weighted_sum(parameter("phase", 0), along, reference)}, {"speed"});
  const Start start{.u = Vector{{0.3, 0.1, 2.1}}, .p = parameter_values(*pinned), .free = "mu"};
  const Branch branch = trace(pinned, start, window(0.05, 2));
  REQUIRE(branch.stop.reason == StopReason::boundary);
  for (const Point& point : branch.points) {
    CHECK(std::abs(point.u.head(2).squaredNorm() - point.parameter) < 1e-12);
    CHECK(std::abs(point.u[2] - (2 + point.parameter)) < 1e-12);
    CHECK(std::abs(along.dot(point.u.head(2) - reference)) < 1e-13);
  }
}

TEST_CASE("a snap-back has no fold where the strain of the element that softens is the free parameter") {
  const softening::Bar bar = softening::exponential(20, 0.01);
  Vector strain = Vector::Zero(20);
  strain[bar.weak()] = 20;
  strain[bar.weak() - 1] = -20;
  const auto problem = with_constraints(from_functions(softening::functions(bar)),
                                        {weighted_sum(parameter("strain", 0), strain)}, {"force"});
  const Start start{.u = Vector::Zero(21), .p = Vector{{0, 0.5}}, .free = "strain"};
  const Branch branch = trace(problem, start, window(0, 1.5), {fold_monitor()});
  REQUIRE(branch.stop.reason == StopReason::boundary);
  CHECK(branch.events.empty());
  CHECK(std::abs(branch.state[0] - 1.5) < 1e-12);
  for (const Point& point : branch.points) {
    const double w = point.parameter;
    CHECK(std::abs(point.u[20] - bar.force(w)) < 1e-10);
    CHECK(std::abs(point.u[19] - bar.end(w)) < 1e-10);
  }
}

TEST_CASE("curves of special points are made of a problem with constraints as of any other") {
  // p + lambda u - u^3 with u + lambda measured: folds at 27 p^2 = 4 lambda^3.
  const Constraint measure{.level = parameter("measure", 0), .value = [](In u, In p) { return u[0] + p[1]; }};
  const auto problem = with_constraints(cusp(), {measure}, {"measure"});
  const Start start{.u = Vector{{-1.3, -0.3}}, .p = Vector{{-1, 1, 0}}, .free = 0};
  const Branch branch = trace(problem, start, window(-1, 1), {fold_monitor()});
  REQUIRE(branch.events.size() == 2);
  const Fold& fold = std::get<Fold>(branch.events[0].data);
  CHECK(std::abs(std::abs(branch.events[0].point.parameter) - std::sqrt(4.0 / 27)) < 1e-12);
  CHECK(fold.right_null.size() == 2);
  const Start on_curve{.u = with_parameter(branch.events[0].point), .p = start.p, .free = 1};
  const Branch curve = trace(folds(problem, 0), on_curve, window(0.2, 3));
  REQUIRE(curve.stop.reason == StopReason::boundary);
  for (const Point& point : curve.points) {
    CHECK(std::abs(27 * std::pow(point.u[2], 2) - 4 * std::pow(point.parameter, 3)) < 1e-8);
    CHECK(std::abs(point.u[1] - point.u[0] - point.parameter) < 1e-11);
  }
}

TEST_CASE("a wrong gradient of a constraint is found by its entry") {
  Constraint wrong = energy();
  wrong.gradient = [](In u, In, Out gradient) { gradient[0] = 1.1 * std::sin(u[0]); };
  const Start start{.u = Vector{{0.5, 0.5}}, .p = Vector{{0, 1, 0.1}}, .free = "energy"};
  const Branch branch = trace(with_constraints(pendulum(), {wrong}, {"torque"}), start, window(0.1, 1));
  REQUIRE(!branch.warnings.empty());
  CHECK(branch.warnings[0].find("the Jacobian is wrong: dF[1]/du[0]") == 0);
  wrong = energy();
  wrong.derivative = [](In, In, int k) { return k == 0 ? 0.3 : 0.0; };
  const Branch other = trace(with_constraints(pendulum(), {wrong}, {"torque"}), start, window(0.1, 1));
  REQUIRE(!other.warnings.empty());
  CHECK(other.warnings[0].find("the Jacobian is wrong: dF[1]/du[1]") == 0);
}

TEST_CASE("constraints that do not fit, and names that there are none of, are refused in words") {
  CHECK_THROWS_WITH(with_constraints(pendulum(), {energy()}, {}),
                    "0 parameters are freed for 1 constraints: as many as these, and one at least");
  CHECK_THROWS_WITH(with_constraints(pendulum(), {energy()}, {"mass"}),
                    "no parameter \"mass\"; there are: torque, weight, energy");
  Constraint other = energy();
  CHECK_THROWS_WITH(with_constraints(pendulum(), {energy(), other}, {"torque", "weight"}),
                    "the parameters 2 and 3 are both called \"energy\"");
  other.level.name = "other";
  CHECK_THROWS_WITH(with_constraints(pendulum(), {energy(), other}, {"torque", "torque"}),
                    "the parameter \"torque\" is freed, and is an unknown already");
  other.value = {};
  CHECK_THROWS_WITH(with_constraints(pendulum(), {other}, {"torque"}),
                    "the constraint \"other\" has no value function");
  CHECK_THROWS_WITH(with_constraints(nullptr, {other}, {"torque"}), "no problem is given");
  CHECK_THROWS_WITH(weighted_sum(parameter("sum", 0), Vector::Ones(2), Vector::Ones(3)),
                    "the constraint \"sum\" has 2 weights, its reference 3 unknowns");

  const auto problem = with_constraints(pendulum(), {energy()}, {"torque"});
  const auto start = [](WhichParameter free) {
    return Start{.u = Vector{{0.5, 0.5}}, .p = Vector{{0, 1, 0.1}}, .free = std::move(free)};
  };
  CHECK_THROWS_WITH(
      trace(problem, start("torque"), window(-1, 1)),
      "the parameter \"torque\" is among the unknowns of this problem: another one has to be free");
  CHECK_THROWS_WITH(trace(problem, start(std::string("tork")), window(-1, 1)),
                    "no parameter \"tork\"; there are: torque, weight, energy");
  CHECK_THROWS_WITH(folds(problem, 0),
                    "the parameter \"torque\" is among the unknowns of the problem already");
  const auto wide =
      with_constraints(pendulum(), {weighted_sum(parameter("sum", 0), Vector::Ones(2))}, {"torque"});
  const Branch branch = trace(wide, start("sum"), window(-1, 1));
  CHECK(branch.stop.message.find("a weighted sum of 2 unknowns of 1") != std::string::npos);
}
