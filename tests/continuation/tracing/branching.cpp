// Branch points on the way of a branch: followed through, located, described.

#include "catch.hpp"

#include "continuation/problems.hpp"

#include <numbers>

using namespace problems;

namespace {

// lambda u - u^power = 0, and eps for an imperfection.
std::shared_ptr<const Problem> imperfect_form(int power, double eps = 0) {
  return from_functions(
      {.size = 1,
       .parameters = {parameter("lambda", 0)},
       .residual = [=](In u, In p, Out F) { F[0] = p[0] * u[0] - std::pow(u[0], power) + eps; },
       .jacobian = [=](In u, In p,
                       Eigen::Ref<Matrix> J) { J(0, 0) = p[0] - power * std::pow(u[0], power - 1); },
       .derivative = [](In u, In, int, Out dF) { dF[0] = u[0]; }});
}

}  // namespace

TEST_CASE(
    "the branch u = 0 passes a transcritical point and a pitchfork at 0, in few steps, with both tangents") {
  for (int power : {2, 3})
    for (int direction : {1, -1})
      for (double from : {0.93, 0.731, 0.5}) {
        const Vector start{{-direction * from}};
        const Branch branch = trace(imperfect_form(power), {Vector{{0.0}}, start, 0, direction},
                                    window(-1, 1), {branch_point_monitor(), fold_monitor()});
        CAPTURE(power, direction, from, branch.stop.message);
        CHECK(branch.stop.reason == StopReason::boundary);
        CHECK(branch.points.back().parameter == direction);
        REQUIRE(branch.events.size() == 1);
        CHECK(branch.events[0].monitor == "branch_point");
        CHECK(std::abs(branch.events[0].point.parameter) < 1e-12);
        CHECK(std::abs(branch.events[0].point.u[0]) < 1e-12);
        const BranchPoint& crossing = std::get<BranchPoint>(branch.events[0].data);
        CHECK(crossing.type ==
              (power == 2 ? BranchPoint::Type::transcritical : BranchPoint::Type::pitchfork));
        REQUIRE(crossing.tangents.size() == 2);
        CHECK((crossing.tangents[0] - Vector{{0.0, direction * 1.0}}).norm() < 1e-9);
        const Vector other = power == 2 ? Vector{{1.0, 1.0}}.normalized() : Vector{{1.0, 0.0}};
        CHECK(std::abs(std::abs(crossing.tangents[1].dot(other)) - 1) < 1e-9);
        CHECK(branch.counts.rejected_steps < 5);
      }
}

TEST_CASE("an imperfect pitchfork has no branch point, and its branch is not left") {
  for (double eps : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const Branch branch = trace(imperfect_form(3, eps), {Vector{{eps}}, Vector{{-1.0}}, 0, 1}, window(-1, 1),
                                {branch_point_monitor(), fold_monitor()});
    CAPTURE(eps, branch.stop.message);
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.points.back().u[0] > 0.9);
    CHECK(branch.events.empty());
    for (const Point& point : branch.points) CHECK(point.u[0] > 0);
  }
}

TEST_CASE("the straight rod buckles at (2/h)^2 sin^2(k pi h/2), by pitchforks, with sparse LU") {
  const int n = 60;
  const Branch branch = trace(from_functions(rod(n)), {Vector::Zero(n), Vector{{1.0}}, 0, 1}, window(0, 100),
                              {branch_point_monitor()});
  CHECK(branch.stop.reason == StopReason::boundary);
  CHECK(branch.linear_solver == "KLU");
  REQUIRE(branch.events.size() == 3);
  for (int k = 1; k <= 3; ++k) {
    const double half = std::sin(k * std::numbers::pi / (2.0 * (n + 1)));
    const Event& event = branch.events[static_cast<std::size_t>(k - 1)];
    CHECK(std::abs(event.point.parameter / (4.0 * (n + 1) * (n + 1) * half * half) - 1) < 1e-10);
    CHECK(std::get<BranchPoint>(event.data).type == BranchPoint::Type::pitchfork);
  }
}

TEST_CASE("a branch point where pieces meet is recognised: |u| = |p|") {
  const auto sign = [](double x) { return x < 0 ? -1.0 : 1.0; };
  const auto problem =
      from_functions({.size = 1,
                      .parameters = {parameter("p", 0)},
                      .residual = [](In u, In p, Out F) { F[0] = std::abs(u[0]) - std::abs(p[0]); },
                      .jacobian = [=](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = sign(u[0]); },
                      .derivative = [=](In, In p, int, Out dF) { dF[0] = -sign(p[0]); },
                      .piece = [](In u, In p) { return 1u + (u[0] < 0 ? 1u : 0u) + (p[0] < 0 ? 2u : 0u); }});
  const Branch branch =
      trace(problem, {Vector{{-0.87}}, Vector{{-0.87}}, 0, 1}, window(-1, 1), {branch_point_monitor()});
  CHECK(branch.stop.reason == StopReason::boundary);
  CHECK(std::abs(branch.points.back().u[0]) == Approx(1));
  REQUIRE(branch.events.size() == 1);
  CHECK(branch.events[0].nonsmooth);
  CHECK(std::abs(branch.events[0].point.parameter) < 1e-6);
}

TEST_CASE("an observer that says stop at a branch point stops the branch there") {
  int events = 0;
  const Branch branch = trace(imperfect_form(3), {Vector{{0.0}}, Vector{{-0.93}}, 0, 1}, window(-1, 1),
                              {branch_point_monitor()}, [&](const Accepted&, const Event* event) {
                                if (event) ++events;
                                return !event;
                              });
  CHECK(events == 1);
  CHECK(branch.stop.reason == StopReason::user);
  CHECK(branch.points.back().parameter < 0.1);
}

TEST_CASE("a terminal event shortly before a branch point of the same step is the one that ends the branch") {
  Monitor crossing = branch_point_monitor(),
          before{"before", [](const Accepted& now) { return now.parameter + 0.001; }};
  crossing.terminal = before.terminal = true;
  Options options = window(-1, 1);
  options.step.initial = options.step.largest_parameter = 0.1;
  const Branch branch =
      trace(imperfect_form(3), {Vector{{0.0}}, Vector{{-0.93}}, 0, 1}, options, {crossing, before});
  CHECK(branch.stop.message == "reached the terminal event \"before\" at -0.001");
  CHECK(branch.events.size() == 1);
}

TEST_CASE("a branch point beyond the window is no event, and ends no branch") {
  for (double upper : {-0.01, -0.001, -1e-5}) {
    Monitor crossing = branch_point_monitor();
    crossing.terminal = true;
    Options options = window(-1, upper);
    options.step.initial = options.step.largest_parameter = 0.1;
    const Branch branch =
        trace(imperfect_form(3), {Vector{{0.0}}, Vector{{-0.93}}, 0, 1}, options, {crossing});
    CAPTURE(upper, branch.stop.message);
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.points.back().parameter == upper);
    CHECK(branch.events.empty());
  }
}

TEST_CASE("a problem that throws next to the branch on which it is evaluated ends no trace by an exception") {
  for (double domain : {1e-5, 1e-6, 1e-8}) {
    const auto problem = from_functions(
        {.size = 1,
         .parameters = {parameter("lambda", 0)},
         .residual =
             [=](In u, In p, Out F) {
               if (std::abs(u[0]) > domain) throw std::runtime_error("outside");
               F[0] = p[0] * u[0] - std::pow(u[0], 3);
             },
         .jacobian = [](In u, In p, Eigen::Ref<Matrix> J) { J(0, 0) = p[0] - 3 * u[0] * u[0]; },
         .derivative = [](In u, In, int, Out dF) { dF[0] = u[0]; }});
    Branch branch;
    CHECK_NOTHROW(branch = trace(problem, {Vector{{0.0}}, Vector{{-0.93}}, 0, 1}, window(-1, 1),
                                 {branch_point_monitor()}));
    CAPTURE(domain, branch.stop.message);
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.events.size() == 1);
  }
}

TEST_CASE(
    "an observer is reported of each branch point, also where the bordered matrix is zero to the last bit") {
  for (int power : {2, 3, 5})
    for (double from : {1.0, 0.75, 0.5, 0.125}) {
      int reported = 0;
      const Branch branch =
          trace(imperfect_form(power), {Vector{{0.0}}, Vector{{-from}}, 0, 1}, window(-1, 1),
                {branch_point_monitor()}, [&](const Accepted& now, const Event* event) {
                  reported += event ? 1 : 0;
                  return !event || std::abs(now.parameter) < 1e-12;
                });
      CAPTURE(power, from, branch.stop.message);
      CHECK(branch.events.size() == 1);
      CHECK(reported == 1);
      CHECK(branch.stop.reason == StopReason::boundary);
    }
}
