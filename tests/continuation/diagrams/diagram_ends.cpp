// Diagrams that are not complete, that are stopped or refused, and what they say.

#include "continuation/diagrams/diagram_problems.hpp"

using namespace problems;

TEST_CASE("a diagram that would have too many branches says so and names what is missing") {
  const Diagram diagram =
      trace_diagram(pitchfork(), at(0, -0.93), window(-1, 1), {.depth = 1, .branches = 1});
  CHECK(!diagram.complete);
  CHECK(diagram.branches.size() == 1);
  CHECK(diagram.message == "reached the maximum number of branches, 1");
  CHECK(!all_traced(diagram.branch_points.at(0)));
}

TEST_CASE("half-branches that leave the window at once are named as such") {
  // the parabola lambda = u^2 lies at lambda >= 0 only; its mirror image, at lambda <= 0, is not in the
  // window
  const auto problem =
      scalar([](double u, double l) { return u * (1e6 * u * u + l - 1); },
             [](double u, double l) { return 3e6 * u * u + l - 1; }, [](double u, double) { return u; });
  const Diagram diagram = trace_diagram(problem, at(0, 1.9, -1), window(1 - 1e-9, 2), {.depth = 1});
  REQUIRE(diagram.branch_points.size() == 1);
  CHECK(!diagram.complete);
  CHECK(diagram.branches.size() == 1);
  CHECK(diagram.message == "the half-branch leaves the window");
}

TEST_CASE("a branch point just beyond the window is none of the diagram") {
  const Diagram diagram = trace_diagram(pitchfork(), at(0, 0.9, -1), window(1e-3, 1), {.depth = 1});
  CHECK(diagram.complete);
  CHECK(diagram.branch_points.empty());
  CHECK(diagram.branches.size() == 1);
}

TEST_CASE(
    "four pitchforks at one place are more than is switched at: the diagram says that it is incomplete") {
  const auto problem = from_functions(
      4, {parameter("lambda", 0)}, [](In u, In p, Out F) { F = (p[0] - u.array().square()) * u.array(); },
      [](In u, In p, Eigen::Ref<Matrix> J) {
        J.setZero();
        J.diagonal() = p[0] - 3 * u.array().square();
      });
  const Start start{.u = Vector::Zero(4), .p = Vector{{-0.93}}, .free = 0};
  const Diagram diagram = trace_diagram(problem, start, window(-1, 1), {.depth = 1});
  CHECK(!diagram.complete);
  CHECK(diagram.message.find("not simple") != std::string::npos);
  CHECK(diagram.branches.size() == 1);
  CHECK(diagram.branches[0].branch.points.back().parameter == 1);
  REQUIRE(diagram.branch_points.size() == 1);
  CHECK(diagram.branch_points[0].half_branches.size() == 2);
  CHECK(trace_diagram(problem, start, window(-1, 1), {.depth = 0}).complete);
}

TEST_CASE("a start that fails is a diagram of one branch that says why") {
  const auto problem = scalar([](double u, double l) { return u * u + l * l + 1; },
                              [](double u, double) { return 2 * u; }, [](double, double l) { return 2 * l; });
  const Diagram diagram = trace_diagram(problem, at(0.5, 0), window(-1, 1));
  CHECK(!diagram.complete);
  REQUIRE(diagram.branches.size() == 1);
  CHECK(diagram.branches[0].branch.stop.reason == StopReason::start_failed);
  CHECK(diagram.message == diagram.branches[0].branch.stop.message);
}

TEST_CASE("an observer sees every branch, and ends the diagram") {
  int seen = 0;
  const Diagram whole = trace_diagram(pitchfork(), at(0, -0.93), window(-1, 1), {}, {},
                                      [&](const Accepted&, const Event*) { return ++seen > 0; });
  CHECK(whole.complete);
  std::size_t points = 0;
  for (const DiagramBranch& each : whole.branches) points += each.branch.points.size();
  CHECK(seen >= static_cast<int>(points) - 1);
  int left = seen / 2;
  const Diagram part = trace_diagram(pitchfork(), at(0, -0.93), window(-1, 1), {}, {},
                                     [&](const Accepted&, const Event*) { return --left > 0; });
  CHECK(!part.complete);
  CHECK(part.message == "stopped by the caller");
}

TEST_CASE("a diagram refuses depths and numbers of branches that make none, and points that are not kept") {
  const auto begin = [](const Options& options, const DiagramOptions& diagram) {
    return trace_diagram(pitchfork(), at(0, -0.93), options, diagram);
  };
  Options unkept = window(-1, 1);
  unkept.keep_points = false;
  CHECK_THROWS_AS(begin(unkept, {}), std::invalid_argument);
  const auto says = [&](const DiagramOptions& diagram, const std::string& message) {
    CHECK_THROWS_WITH(begin(window(-1, 1), diagram), message);
  };
  says({.depth = -1}, "the depth of a diagram is -1, must be >= 0");
  says({.branches = 0}, "the maximum number of branches of a diagram is 0, must be >= 1");
  says({.same_place = 0}, "same_place of a diagram is 0, must be > 0");
  says({.same_direction = 1}, "same_direction of a diagram is 1, must be between 0 and 1");
  says({.entry = {.shortest = 0}}, "entry.shortest of a diagram is 0, must be > 0");
  says({.entry = {.longest = 1e-7}}, "entry.longest of a diagram is 1e-07, must be >= entry.shortest");
  says({.entry = {.reduction = 1}}, "entry.reduction of a diagram is 1, must be between 0 and 1");
  says({.entry = {.error = -1}}, "entry.error of a diagram is -1, must be between 0 and 1");
  says({.entry = {.turn = 2}}, "entry.turn of a diagram is 2, must be between 0 and 1");
  says({.nearby = {.segment = 0}}, "nearby.segment of a diagram is 0, must be between 0 and 1");
  says({.nearby = {.same_point = 0}}, "nearby.same_point of a diagram is 0, must be between 0 and 1");
  says({.searches = {2}}, "a search of a diagram is at 2, must be in the window, -1 to 1");
  says({.oblique_probes = -1}, "oblique_probes of a diagram is -1, must be >= 0");
}

TEST_CASE("a branch of a diagram is interpolated before its origin as well as beyond") {
  const auto parabola =
      from_functions(1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = u[0] - p[0] * p[0]; });
  const Diagram diagram = trace_diagram(parabola, {Vector{{0.0}}, Vector{{0.0}}, 0, 1}, window(-1, 1));
  const Point before = interpolate(diagram.branches[0].branch, -0.5);
  CHECK(before.parameter < -0.4);
  CHECK(std::abs(before.u[0] - before.parameter * before.parameter) < 1e-5);
}
