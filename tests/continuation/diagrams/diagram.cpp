// Diagrams of branches that cross: each branch once, compared with closed forms.

#include "continuation/diagrams/diagram_problems.hpp"
#include "controls.hpp"

#include <numbers>

using namespace problems;

TEST_CASE("the pitchfork's diagram is the line u = 0 and one parabola, from either end") {
  for (const Start& start : {at(0, -0.93), at(0, 0.8, -1), at(0, 0.31), at(0, -1)}) {
    const Diagram diagram = trace_diagram(pitchfork(), start, window(-1, 1), {.depth = 1}, {fold_monitor()});
    CHECK(diagram.complete);
    REQUIRE(diagram.branches.size() == 2);
    REQUIRE(diagram.branch_points.size() == 1);
    check_order(diagram);
    const Branch& line = diagram.branches[0].branch;
    CHECK(largest(line, [](double u, double) { return u; }) < 1e-12);
    CHECK(std::min(line.points.front().parameter, line.points.back().parameter) == -1);
    CHECK(std::max(line.points.front().parameter, line.points.back().parameter) == 1);
    const Branch& parabola = diagram.branches[1].branch;
    CHECK(diagram.branches[1].depth == 1);
    CHECK(diagram.branches[1].origin == 0);
    CHECK(diagram.branches[1].begin.reason == StopReason::boundary);
    CHECK(parabola.stop.reason == StopReason::boundary);
    CHECK(largest(parabola, [](double u, double l) { return u * u - l; }) < 1e-12);
    CHECK(std::abs(parabola.points.front().u[0] + parabola.points.back().u[0]) < 1e-12);
    CHECK(std::abs(std::abs(parabola.points.back().u[0]) - 1) < 1e-12);
    const std::vector<Event> crossings = events_named(parabola, "branch_point");
    REQUIRE(crossings.size() == 1);
    const BranchPoint& crossing = std::get<BranchPoint>(crossings[0].data);
    CHECK(std::abs(std::abs(crossing.tangents[0][0]) - 1) < 1e-9);
    CHECK(std::abs(std::abs(crossing.tangents[1][1]) - 1) < 1e-9);
    CHECK(diagram.branch_points[0].half_branches.size() == 4);
    CHECK(all_traced(diagram.branch_points[0]));
  }
}

TEST_CASE("the branches of a pitchfork of u' = l u - u^3 are stable but for u = 0 at l > 0") {
  for (const SpectrumAt spectra : {SpectrumAt::every_point, SpectrumAt::events})
    for (const Start& start : {at(0, -0.93), at(0, 0.8, -1), at(0.6, 0.36, -1)}) {
      Options options = window(-1, 1);
      options.stability.emplace();
      options.stability->at = spectra;
      const Diagram diagram = trace_diagram(pitchfork(), start, options, {.depth = 1});
      REQUIRE(diagram.branches.size() == 2);
      for (const DiagramBranch& each : diagram.branches) {
        const auto& points = each.branch.points;
        const bool is_line = std::abs(points.front().u[0]) < 1e-6;
        REQUIRE(each.stability.size() == (is_line ? 2 : 1));
        CHECK(each.stability.front().first == 0);
        CHECK(each.stability.back().last == points.size() - 1);
        for (const StabilityRange& range : each.stability)
          for (std::size_t i = range.first; i <= range.last; ++i)
            if (std::abs(points[i].parameter) > 1e-9)  // not the branch point itself
              CHECK(range.unstable == (is_line && points[i].parameter > 0 ? 1 : 0));
      }
    }
  const Diagram without = trace_diagram(pitchfork(), at(0, -0.93), window(-1, 1), {.depth = 1});
  for (const DiagramBranch& each : without.branches) CHECK(each.stability.empty());
}

TEST_CASE("begun on the parabola, the pitchfork's diagram is the same") {
  const Diagram diagram = trace_diagram(pitchfork(), at(0.9, 0.81, -1), window(-1, 1), {.depth = 1});
  CHECK(diagram.complete);
  REQUIRE(diagram.branches.size() == 2);
  check_order(diagram);
  CHECK(largest(diagram.branches[0].branch, [](double u, double l) { return u * u - l; }) < 1e-12);
  CHECK(largest(diagram.branches[1].branch, [](double u, double) { return u; }) < 1e-12);
  CHECK(diagram.branches[1].branch.stop.reason == StopReason::boundary);
  CHECK(diagram.branches[1].begin.reason == StopReason::boundary);
}

TEST_CASE("two lines that cross are two branches: lambda u = u^2") {
  const auto problem =
      scalar([](double u, double l) { return l * u - u * u; }, [](double u, double l) { return l - 2 * u; },
             [](double u, double) { return u; });
  const Diagram diagram = trace_diagram(problem, at(0, -0.9), window(-1, 1), {.depth = 3});
  CHECK(diagram.complete);
  REQUIRE(diagram.branches.size() == 2);
  REQUIRE(diagram.branch_points.size() == 1);
  check_order(diagram);
  CHECK(largest(diagram.branches[1].branch, [](double u, double l) { return u - l; }) < 1e-12);
  CHECK(std::abs(diagram.branches[1].branch.points.front().parameter) == 1);
  CHECK(std::abs(diagram.branches[1].branch.points.back().parameter) == 1);
}

TEST_CASE("a parabola and a circle that cross twice are two branches, the circle closed") {
  const auto problem =
      scalar([](double u, double l) { return (u * u - l) * (u * u + l * l - 1); },
             [](double u, double l) { return 2 * u * (u * u + l * l - 1) + (u * u - l) * 2 * u; },
             [](double u, double l) { return -(u * u + l * l - 1) + (u * u - l) * 2 * l; });
  const double golden = (std::sqrt(5.0) - 1) / 2;
  for (const Start& start : {at(1.2, 1.44, -1), at(-1.2, 1.44), at(0.6, -0.8)}) {
    const Diagram diagram = trace_diagram(problem, start, window(-2, 2), {.depth = 2}, {fold_monitor()});
    CAPTURE(start.u, diagram.message);
    CHECK(diagram.complete);
    REQUIRE(diagram.branches.size() == 2);
    REQUIRE(diagram.branch_points.size() == 2);
    check_order(diagram);
    for (const Junction& junction : diagram.branch_points) {
      CHECK(std::abs(junction.parameter - golden) < 1e-12);
      CHECK(std::abs(std::abs(junction.u[0]) - std::sqrt(golden)) < 1e-12);
      CHECK(all_traced(junction));
    }
    const std::size_t circle = start.p[0] < 0 ? 0 : 1;
    const Branch& loop = diagram.branches[circle].branch;
    CHECK(loop.stop.reason == StopReason::closed);
    CHECK(largest(loop, [](double u, double l) { return u * u + l * l - 1; }) < 1e-12);
    CHECK(events_named(loop, "fold").size() == 2);
    CHECK(largest(diagram.branches[1 - circle].branch, [](double u, double l) { return u * u - l; }) < 1e-12);
  }
}

TEST_CASE("a loop between two points of one branch is there once: u (u^2 - lambda (1 - lambda)) = 0") {
  const auto problem = scalar([](double u, double l) { return u * (u * u - l * (1 - l)); },
                              [](double u, double l) { return 3 * u * u - l * (1 - l); },
                              [](double u, double l) { return -u * (1 - 2 * l); });
  const Diagram diagram =
      trace_diagram(problem, at(0, -0.47), window(-0.5, 1.5), {.depth = 2}, {fold_monitor()});
  CHECK(diagram.complete);
  REQUIRE(diagram.branches.size() == 2);
  REQUIRE(diagram.branch_points.size() == 2);
  check_order(diagram);
  CHECK(std::abs(diagram.branch_points[0].parameter) < 1e-12);
  CHECK(std::abs(diagram.branch_points[1].parameter - 1) < 1e-12);
  const Branch& loop = diagram.branches[1].branch;
  CHECK(loop.stop.reason == StopReason::closed);
  CHECK(largest(loop, [](double u, double l) { return u * u - l * (1 - l); }) < 1e-12);
  CHECK(events_named(loop, "branch_point").size() == 2);
}

TEST_CASE("a branch that crosses itself is one branch: the lemniscate of Gerono") {
  const auto problem =
      scalar([](double u, double l) { return l * l * (1 - l * l) - u * u; },
             [](double u, double) { return -2 * u; }, [](double, double l) { return 2 * l - 4 * l * l * l; });
  const Diagram diagram = trace_diagram(problem, at(0.48, 0.8), window(-2, 2), {.depth = 2});
  CHECK(diagram.complete);
  REQUIRE(diagram.branches.size() == 1);
  check_order(diagram);
  CHECK(diagram.branches[0].branch.stop.reason == StopReason::closed);
  REQUIRE(diagram.branch_points.size() == 1);
  CHECK(all_traced(diagram.branch_points[0]));
  CHECK(events_named(diagram.branches[0].branch, "branch_point").size() == 2);
}

TEST_CASE("branches of branches are followed to the depth asked for, and no further") {
  // u = 0, which the parabola crosses, which u = 1/2 crosses at lambda = 1/4
  const auto problem =
      scalar([](double u, double l) { return u * (u * u - l) * (u - 0.5); },
             [](double u, double l) { return (3 * u * u - l) * (u - 0.5) + u * (u * u - l); },
             [](double u, double) { return -u * (u - 0.5); });
  for (int depth : {0, 1, 2, 5}) {
    const Diagram diagram = trace_diagram(problem, at(0, -0.9), window(-1, 1), {.depth = depth});
    CAPTURE(depth);
    CHECK(diagram.complete);
    check_order(diagram);
    REQUIRE(diagram.branches.size() == static_cast<std::size_t>(std::min(depth, 2) + 1));
    CHECK(diagram.branch_points.size() == static_cast<std::size_t>(depth == 0 ? 1 : 2));
    if (depth < 2) CHECK(!all_traced(diagram.branch_points.back()));
    for (const HalfBranch& half : diagram.branch_points.back().half_branches)
      CHECK(half.untraced == (half.branch >= 0 ? ""
                                               : "a branch of it is beyond the depth of the diagram, " +
                                                     std::to_string(depth)));
    if (depth < 2) continue;
    const DiagramBranch& last = diagram.branches[2];
    CHECK(last.depth == 2);
    CHECK(last.origin == 1);
    CHECK(diagram.branch_points[1].branch == 1);
    CHECK(largest(last.branch, [](double u, double) { return u - 0.5; }) < 1e-12);
    CHECK(std::abs(diagram.branch_points[1].parameter - 0.25) < 1e-12);
  }
}

TEST_CASE("the rod's buckled branches have k half-waves each way, and begin at (2/h)^2 sin^2(k pi h/2)") {
  const int n = 40;
  const double h2 = 1.0 / ((n + 1.0) * (n + 1.0));
  const Diagram diagram = trace_diagram(from_functions(rod(n)), {Vector::Zero(n), Vector{{1.0}}, 0, 1},
                                        window(0, 100), {.depth = 2});
  CAPTURE(diagram.message);
  CHECK(diagram.complete);
  REQUIRE(diagram.branches.size() == 4);
  REQUIRE(diagram.branch_points.size() == 3);
  for (std::size_t k = 1; k <= 3; ++k) {
    const double half = std::sin(static_cast<double>(k) * std::numbers::pi / (2.0 * (n + 1)));
    CHECK(std::abs(diagram.branch_points[k - 1].parameter / (4.0 / h2 * half * half) - 1) < 1e-10);
    const DiagramBranch& buckled = diagram.branches[k];
    CHECK(buckled.depth == 1);
    CHECK(buckled.branch.linear_solver == "KLU");
    const Point& first = buckled.branch.points.front();
    const Point& last = buckled.branch.points.back();
    CHECK(first.parameter == 100);
    CHECK(last.parameter == 100);
    CHECK((first.u + last.u).norm() < 1e-8 * last.u.norm());
    std::size_t half_waves = 1;
    for (int i = 0; i + 1 < n; ++i)
      if (last.u[i] * last.u[i + 1] < 0) ++half_waves;
    CHECK(half_waves == k);
  }
}

TEST_CASE("a chain of five cells branches where its linearization is singular, in either of two step sizes") {
  // Rheinboldt 1980: (I + L) u + 100 u / (1 + u + u^2) = lambda. Equal cells branch where 1 + r'(u) + m = 0,
  // m = 4 sin^2(k pi / 10) the eigenvalues of L, k = 1 .. 4: twice for each.
  const int n = 5;
  Matrix A = Matrix::Identity(n, n);
  for (int i = 0; i + 1 < n; ++i) A.block(i, i, 2, 2) += Eigen::Matrix2d{{1, -1}, {-1, 1}};
  const auto slope = [](double x) { return 100 * (1 - x * x) / std::pow(1 + x + x * x, 2); };
  const auto problem = from_functions(
      n, {parameter("lambda", 0, 10)},
      [=](In u, In p, Out F) {
        F = A * u;
        for (int i = 0; i < n; ++i) F[i] += 100 * u[i] / (1 + u[i] + u[i] * u[i]) - p[0];
      },
      [=](In u, In, Eigen::Ref<Matrix> J) {
        J = A;
        for (int i = 0; i < n; ++i) J(i, i) += slope(u[i]);
      },
      [](In, In, int, Out dF) { dF.setConstant(-1); });
  for (double step : {0.6, 0.1}) {
    Options options = window(0, 60);
    options.step.largest_parameter = step;
    const Diagram diagram =
        trace_diagram(problem, {Vector::Zero(n), Vector{{0.0}}, 0, 1}, options, {.depth = 5});
    CAPTURE(step, diagram.message);
    CHECK(diagram.complete);
    check_order(diagram);
    std::size_t equal = 0;
    for (const Junction& junction : diagram.branch_points) {
      CHECK(all_traced(junction));
      const double x = junction.u.mean();
      if ((junction.u.array() - x).matrix().norm() > 1e-6) continue;
      ++equal;
      double nearest = 1e300;
      for (int k = 1; k <= 4; ++k)
        nearest =
            std::min(nearest, std::abs(1 + slope(x) + 4 * std::pow(std::sin(k * std::numbers::pi / 10), 2)));
      CHECK(nearest < 1e-8);
    }
    CHECK(equal == 8);
    std::size_t of_equal_cells = 0;
    for (const DiagramBranch& each : diagram.branches) {
      const auto& points = each.branch.points;
      of_equal_cells += std::all_of(points.begin(), points.end(), [](const Point& point) {
        return (point.u.array() - point.u.mean()).matrix().norm() < 1e-6;
      });
      if (each.depth > 0) CHECK(each.branch.stop.reason == StopReason::closed);
    }
    CHECK(of_equal_cells == 1);
    CHECK(diagram.branches.size() == 11);
    CHECK(diagram.branch_points.size() == 20);
  }
}

TEST_CASE("where pieces meet, the half-branches next to the one traced are followed: |u| = |lambda|") {
  const auto sign = [](double x) { return x < 0 ? -1.0 : 1.0; };
  const auto problem =
      from_functions({.size = 1,
                      .parameters = {parameter("lambda", 0)},
                      .residual = [](In u, In p, Out F) { F[0] = std::abs(u[0]) - std::abs(p[0]); },
                      .jacobian = [=](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = sign(u[0]); },
                      .derivative = [=](In, In p, int, Out dF) { dF[0] = -sign(p[0]); },
                      .piece = [](In u, In p) { return 1u + (u[0] < 0 ? 1u : 0u) + (p[0] < 0 ? 2u : 0u); }});
  const Diagram diagram = trace_diagram(problem, at(-0.87, -0.87), window(-1, 1), {.depth = 1});
  CAPTURE(diagram.message);
  CHECK(diagram.complete);
  REQUIRE(diagram.branch_points.size() == 1);
  REQUIRE(diagram.branch_points[0].half_branches.size() == 4);
  CHECK(all_traced(diagram.branch_points[0]));
  REQUIRE(diagram.branches.size() == 3);
  check_order(diagram);
  std::vector<std::pair<double, double>> ends;
  for (const DiagramBranch& each : diagram.branches) {
    CHECK(largest(each.branch, [](double u, double l) { return std::abs(u) - std::abs(l); }) < 1e-12);
    if (each.depth == 0)
      ends.emplace_back(each.branch.points.front().u[0], each.branch.points.front().parameter);
    ends.emplace_back(each.branch.points.back().u[0], each.branch.points.back().parameter);
  }
  std::sort(ends.begin(), ends.end());
  REQUIRE(ends.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(std::abs(ends[i].first - (i < 2 ? -1 : 1)) < 1e-12);
    CHECK(ends[i].second == (i % 2 ? 1 : -1));
  }
}

TEST_CASE("a diagram whose search is stopped is not complete") {
  bool searched = false;
  const auto apart = from_functions(1, {{"l", ""}}, [&](In u, In p, Out F) {
    searched = searched || p[0] == 0.1;
    F[0] = (u[0] + 2) * ((u[0] - 1) * (u[0] - 1) + p[0] * p[0] - 0.25);
  });
  Options options = window(-1, 1);
  options.control = controls::polled([&] { return !searched; });
  const Diagram diagram = trace_diagram(apart, at(-2, -1), options, {.searches = {0.1}});
  CHECK(diagram.branches.size() == 1);
  CHECK_FALSE(diagram.complete);
  CHECK(diagram.message == "stopped by the caller");
}

TEST_CASE("a search finds the circle that no branch crosses, and both branches of an imperfect pitchfork") {
  // (u + 2)((u - 1)^2 + l^2 - 1/4) = 0.
  const auto apart =
      scalar([](double u, double l) { return (u + 2) * ((u - 1) * (u - 1) + l * l - 0.25); },
             [](double u, double l) { return (u - 1) * (u - 1) + l * l - 0.25 + 2 * (u + 2) * (u - 1); },
             [](double u, double l) { return 2 * (u + 2) * l; });
  CHECK(trace_diagram(apart, at(-2, -1), window(-1, 1)).branches.size() == 1);
  CHECK(trace_diagram(apart, at(-2, -1), window(-1, 1), {.searches = {0.9}}).branches.size() == 1);
  const Diagram isola = trace_diagram(apart, at(-2, -1), window(-1, 1), {.searches = {0.1, -0.3}});
  CHECK(isola.complete);
  REQUIRE(isola.branches.size() == 2);
  CHECK(isola.branches[1].branch.stop.reason == StopReason::closed);
  CHECK(isola.branches[1].origin == -1);
  CHECK(isola.branches[1].depth == 0);
  CHECK(largest(isola.branches[1].branch,
                [](double u, double l) { return (u - 1) * (u - 1) + l * l - 0.25; }) < 1e-9);
  const Diagram full = trace_diagram(apart, at(-2, -1), window(-1, 1), {.branches = 1, .searches = {0.1}});
  CHECK(full.message == "reached the maximum number of branches, 1");

  // 0.02 + l u - u^3: the branch at u < 0 has a fold at l = 3 (0.01)^(2/3).
  const auto imperfect =
      scalar([](double u, double l) { return 0.02 + l * u - u * u * u; },
             [](double u, double l) { return l - 3 * u * u; }, [](double u, double) { return u; });
  const Diagram both =
      trace_diagram(imperfect, at(0.02, -1), window(-1, 1), {.searches = {0.5, 0.9}}, {fold_monitor()});
  REQUIRE(both.branches.size() == 2);
  const std::vector<Event> folds = events_named(both.branches[1].branch, "fold");
  REQUIRE(folds.size() == 1);
  CHECK(std::abs(folds[0].point.parameter - 3 * std::pow(0.01, 2.0 / 3)) < 1e-11);
  CHECK(both.branches[1].begin.reason == StopReason::boundary);
  CHECK(both.branches[1].branch.stop.reason == StopReason::boundary);
}

TEST_CASE("what a search finds around a fold between two points is not another branch") {
  const auto parabola = scalar([](double u, double l) { return 1 - l - u * u; },
                               [](double u, double) { return -2 * u; }, [](double, double) { return -1.0; });
  const Diagram diagram =
      trace_diagram(parabola, at(-1.4, -0.96), window(-1, 2), {.searches = {1 - 1e-7, 1 - 1e-5, 0.3}});
  CHECK(diagram.branches.size() == 1);
}

TEST_CASE(
    "a half-branch beyond the depth that a search has come upon has a branch, and no reason against it") {
  const Diagram diagram =
      trace_diagram(pitchfork(), at(0, -0.93), window(-1, 1), {.depth = 0, .searches = {0.5}});
  REQUIRE(diagram.branch_points.size() == 1);
  REQUIRE(diagram.branches.size() == 2);
  CHECK(all_traced(diagram.branch_points[0]));
  for (const HalfBranch& half : diagram.branch_points[0].half_branches) CHECK(half.untraced.empty());
}

TEST_CASE("a branch that is found by a search is left at its branch points, too") {
  // (u + 2)(l v - v^3), v = u - 3: the line u = -2, and a pitchfork at u = 3.
  const auto apart = from_functions(1, {parameter("l", 0)}, [](In u, In p, Out F) {
    const double v = u[0] - 3, l = p[0];
    F[0] = (u[0] + 2) * (l * v - v * v * v);
  });
  const Diagram diagram = trace_diagram(apart, at(-2, -0.93), window(-1, 1), {.searches = {-0.51}});
  CHECK(diagram.complete);
  REQUIRE(diagram.branches.size() == 3);
  CHECK(diagram.branches[1].origin == -1);
  CHECK(diagram.branches[2].origin == 0);
  REQUIRE(diagram.branch_points.size() == 1);
  CHECK(all_traced(diagram.branch_points[0]));
  CHECK(std::abs(diagram.branch_points[0].parameter) < 1e-9);
  CHECK(largest(diagram.branches[2].branch, [](double u, double l) { return (u - 3) * (u - 3) - l; }) < 1e-8);
}
