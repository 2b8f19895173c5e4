// Why steps were tried in vain, as a log reports it.

#include "catch.hpp"

#include "continuation/problems.hpp"

#include <map>

using namespace problems;

namespace {

struct Log {
  Branch branch;
  std::vector<Rejection> all;
  long count(Rejected why) const {
    return std::count_if(all.begin(), all.end(), [=](const Rejection& each) { return each.why == why; });
  }
};

Log logged(const std::shared_ptr<const Problem>& problem, const Start& start, Options options,
           const std::vector<Monitor>& monitors = {}) {
  Log log;
  options.on_rejection = [&](const Rejection& each) { log.all.push_back(each); };
  log.branch = trace(problem, start, options, monitors);
  return log;
}

}  // namespace

TEST_CASE("each rejected step is reported, with its place and its reason") {
  // F is not defined beyond 0.5.
  const auto line = from_functions(1, {parameter("p", 0)}, [](In u, In p, Out F) {
    F[0] = p[0] > 0.5 ? throw std::runtime_error("no pressure beyond") : u[0] - p[0];
  });
  const Log edge = logged(line, {Vector{{0.0}}, Vector{{0.0}}, 0, 1}, window(0, 1));
  REQUIRE(static_cast<long>(edge.all.size()) == edge.branch.counts.rejected_steps);
  REQUIRE(edge.all.size() > 5);
  CHECK(edge.count(Rejected::not_evaluated) == static_cast<long>(edge.all.size()));
  CHECK(edge.all[0].words == "no pressure beyond");
  for (const Rejection& each : edge.all) CHECK(each.parameter + each.step > 0.5 - 1e-4);

  // A step of 1.5 along a circle of radius 1 turns by 1.5.
  const auto circle = from_functions(
      1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = u[0] * u[0] + p[0] * p[0] - 1; },
      [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = 2 * u[0]; },
      [](In, In p, int, Out dF) { dF[0] = 2 * p[0]; });
  Options options = window(-2, 2);
  options.step.initial = 0.8;
  options.step.largest_parameter = 1;
  const Log turn = logged(circle, {Vector{{1.0}}, Vector{{0.0}}, 0, 1}, options);
  REQUIRE(turn.count(Rejected::turn) >= 1);
  CHECK(turn.all[0].why == Rejected::turn);
  CHECK(turn.all[0].value > 0.6);
  CHECK(turn.all[0].limit == 0.6);
  CHECK(turn.all[0].step == 0.8);
}

TEST_CASE("a step that a quantity forbids names its monitor") {
  const auto q = [](double p) { return 1 + 1 / (1 + 400 * p * p); };
  const auto problem =
      from_functions(1, {parameter("p", 0)}, [=](In u, In p, Out F) { F[0] = u[0] - q(p[0]); });
  Monitor peak{.name = "peak", .value = [](const Accepted& now) { return now.tangent[0]; }};
  peak.quantity = [](const Accepted& now) { return now.u[0]; };
  Options options = window(-1, 1);
  options.step.largest_parameter = 0.5;
  options.step.largest_angle = 1.4;
  options.step.angle = 1;
  const Log log = logged(problem, {Vector{{q(-1)}}, Vector{{-1.0}}, 0, 1}, options, {peak});
  REQUIRE(log.count(Rejected::quantity) > 0);
  for (const Rejection& each : log.all)
    if (each.why == Rejected::quantity) CHECK(each.words == "peak");
}

TEST_CASE("every reason for a rejection has a name of its own") {
  const Rejected all[] = {Rejected::not_converged, Rejected::not_evaluated,  Rejected::singular,
                          Rejected::turn,          Rejected::another_branch, Rejected::parameter_step,
                          Rejected::curve,         Rejected::quantity,       Rejected::end_of_window,
                          Rejected::branch_points};
  std::map<std::string, int> names;
  for (const Rejected why : all) ++names[name(why)];
  CHECK(names.size() == std::size(all));
  CHECK(names.count("unknown") == 0);
}
