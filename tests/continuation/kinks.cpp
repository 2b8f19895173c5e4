#include "catch.hpp"

#include "continuation/problems.hpp"

#include <memory>

using namespace problems;

namespace {

// a(u) - p = 0 with a piecewise linear of slope `below` for u < 0 and `above` for u > 0.
std::shared_ptr<const Problem> broken(double below, double above) {
  const auto slope = [=](double u) { return u < 0 ? below : above; };
  return from_functions({.size = 1,
                         .parameters = {parameter("p", 0)},
                         .residual = [=](In u, In p, Out F) { F[0] = slope(u[0]) * u[0] - p[0]; },
                         .jacobian = [=](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = slope(u[0]); },
                         .derivative = [](In, In, int, Out dF) { dF[0] = -1; },
                         .piece = [](In u, In) { return u[0] < 0 ? 1 : 2; }});
}

Branch through(double below, double above, double from) {
  const auto problem = broken(below, above);
  return trace(problem, {Vector::Constant(1, from / below), Vector::Constant(1, from), 0, 1}, window(-1, 1),
               {fold_monitor()});
}

}  // namespace

TEST_CASE("a kink of any angle is passed without turning back") {
  for (double above : {1.0, 0.3, 0.1, 1e-2, 5.0, 100.0, 1e4}) {
    const Branch branch = through(1, above, -0.9137);
    CAPTURE(above);
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.points.back().parameter == 1);
    CHECK(std::abs(branch.points.back().u[0] - 1 / above) < 1e-12 / above);
    CHECK(branch.events.empty());
    for (std::size_t k = 1; k < branch.points.size(); ++k)
      CHECK(branch.points[k].parameter > branch.points[k - 1].parameter);
  }
}

TEST_CASE("a nonsmooth fold is found at its kink, and says that it is nonsmooth") {
  for (double above : {-1.0, -0.2, -3.0, -0.05}) {
    const Branch branch = through(1, above, -0.9137);
    CAPTURE(above);
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.points.back().parameter == -1);
    CHECK(branch.points.back().u[0] == Approx(-1 / above));
    REQUIRE(branch.events.size() == 1);
    CHECK(branch.events[0].monitor == "fold");
    CHECK(branch.events[0].nonsmooth);
    CHECK(std::abs(branch.events[0].point.parameter) < 1e-9);
  }
}

TEST_CASE("a maximum before a sharp corner and a minimum beyond it are found, however close") {
  // q = u^3/3 - d^2 u: a maximum at u = -d, a minimum at u = d, and the corner between them at u = 0.
  for (double above : {-3.0, -20.0})
    for (double from : {-0.9137, -0.8513, -0.7331})
      for (double d : {3e-3, 1e-3, 3e-4}) {
        const Monitor extreme{
            "extreme", [=](const Accepted& now) { return (now.u[0] * now.u[0] - d * d) * now.tangent[0]; },
            Crossing::any,
            [=](const Accepted& now) { return now.u[0] * now.u[0] * now.u[0] / 3 - d * d * now.u[0]; }};
        const auto problem = broken(1, above);
        const Branch branch = trace(problem, {Vector::Constant(1, from), Vector::Constant(1, from), 0, 1},
                                    window(-1, 1), {extreme});
        CAPTURE(above, from, d, branch.points.size());
        CHECK(branch.stop.reason == StopReason::boundary);
        REQUIRE(branch.events.size() == 2);
        CHECK(std::abs(branch.events[0].point.u[0] + d) < 1e-9);
        CHECK(std::abs(branch.events[1].point.u[0] - d) < 1e-9);
        CHECK(branch.counts.rejected_steps < 40);
      }
}

TEST_CASE("a kink is an event at its place, with the tangents of both sides, whatever its angle") {
  for (double above : {0.9, 2.0, 20.0, -0.5, -3.0})
    for (double from : {-0.9, -0.531}) {
      const Branch branch =
          trace(broken(1, above), {Vector::Constant(1, from), Vector::Constant(1, from), 0, 1}, window(-1, 1),
                {kink_monitor(), fold_monitor()});
      CAPTURE(above, from, branch.stop.message);
      CHECK(branch.stop.reason == StopReason::boundary);
      const auto kinks = events_named(branch, "kink");
      REQUIRE(kinks.size() == 1);
      CHECK(std::abs(kinks[0].point.u[0]) < 1e-9);
      CHECK(std::abs(kinks[0].point.parameter) < 1e-9);
      const Kink& kink = std::get<Kink>(kinks[0].data);
      CHECK((kink.before - Vector{{1.0, 1.0}}.normalized()).norm() < 1e-9);
      CHECK((kink.after - Vector{{1.0, above}}.normalized()).norm() < 1e-9);
      CHECK(events_named(branch, "fold").size() == (above < 0 ? 1 : 0));
    }
}

TEST_CASE("a change of piece that leaves the tangent as it was is no kink") {
  const auto problem =
      from_functions({.size = 1,
                      .parameters = {parameter("p", 0)},
                      .residual = [](In u, In p, Out F) { F[0] = u[0] - p[0] * std::abs(p[0]); },
                      .jacobian = [](In, In, Eigen::Ref<Matrix> J) { J(0, 0) = 1; },
                      .derivative = [](In, In p, int, Out dF) { dF[0] = -2 * std::abs(p[0]); },
                      .piece = [](In, In p) { return p[0] < 0 ? 1 : 2; }});
  const Branch branch =
      trace(problem, {Vector{{-0.81}}, Vector{{-0.9}}, 0, 1}, window(-1, 1), {kink_monitor()});
  CHECK(branch.stop.reason == StopReason::boundary);
  CHECK(branch.events.empty());
}

TEST_CASE("three kinks in one step are three events in their order") {
  // Slopes 1, 1.2, 1.1, 1.3 between u = 0, 1e-3 and 2e-3.
  const auto piece = [](double u) { return u < 0 ? 1 : u < 1e-3 ? 2 : u < 2e-3 ? 3 : 4; };
  const auto value = [](double u) {
    return u < 0 ? u : u < 1e-3 ? 1.2 * u : u < 2e-3 ? 1.2e-3 + 1.1 * (u - 1e-3) : 2.3e-3 + 1.3 * (u - 2e-3);
  };
  const auto slope = [=](double u) {
    return std::array{1.0, 1.2, 1.1, 1.3}[static_cast<std::size_t>(piece(u) - 1)];
  };
  const auto problem =
      from_functions({.size = 1,
                      .parameters = {parameter("p", 0)},
                      .residual = [=](In u, In p, Out F) { F[0] = value(u[0]) - p[0]; },
                      .jacobian = [=](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = slope(u[0]); },
                      .derivative = [](In, In, int, Out dF) { dF[0] = -1; },
                      .piece = [=](In u, In) { return piece(u[0]); }});
  const Branch branch =
      trace(problem, {Vector{{-0.9}}, Vector{{-0.9}}, 0, 1}, window(-1, 1), {kink_monitor()});
  REQUIRE(branch.events.size() == 3);
  for (int k = 0; k < 3; ++k)
    CHECK(std::abs(branch.events[static_cast<std::size_t>(k)].point.u[0] - k * 1e-3) < 1e-9);
}
