// Steps over kinks, and pieces of the branch that both of their ends hide.

#include "catch.hpp"

#include "graphs.hpp"

#include <algorithm>
#include <cmath>

using namespace graphs;

namespace {

// u = 2 + sin p + sum of c_k |p - a_k|, with 60 kinks of either sign.
struct ManyKinks {
  static constexpr int count = 60;
  static double place(int k) { return -0.9 + 4.7 * k / count + 0.02 * std::sin(5.0 * k); }
  static double strength(int k) { return 2e-3 * std::cos(3.0 * k); }
  static double value(double p) {
    double u = 2 + std::sin(p);
    for (int k = 0; k < count; ++k) u += strength(k) * std::abs(p - place(k));
    return u;
  }
  static double slope_of_kinks(double p) {
    double sum = 0;
    for (int k = 0; k < count; ++k) sum += p > place(k) ? strength(k) : -strength(k);
    return sum;
  }
  static double slope(double p) { return std::cos(p) + slope_of_kinks(p); }
  static std::uint64_t piece(double p) {
    std::uint64_t passed = 0;
    for (int k = 0; k < count; ++k) passed += p > place(k);
    return passed;
  }
  static Branch branch(const Options& options, const std::vector<Monitor>& monitors) {
    return trace(graph(value, slope, [](In, In p) { return piece(p[0]); }), on(value, -1), options, monitors);
  }
};

}  // namespace

TEST_CASE("a step with more kinks than are found is made shorter: a resonance beyond them is seen") {
  constexpr double middle = 0.5, width = 0.04, height = 0.05;
  constexpr int kinks = 20;
  const auto bump = [=](double p) { return height * std::exp(-std::pow((p - middle) / width, 2)); };
  const auto u_of = [=](double p) {
    double u = 2 - 0.5 * p + bump(p);
    for (int k = 0; k < kinks; ++k) u += 0.001 * std::abs(p - 0.01 * k);
    return u;
  };
  const auto slope = [=](double p) {
    double du = -0.5 - 2 * (p - middle) / (width * width) * bump(p);
    for (int k = 0; k < kinks; ++k) du += p < 0.01 * k ? -0.001 : 0.001;
    return du;
  };
  const auto problem = graph(u_of, slope, [](In, In p) {
    int passed = 0;
    while (passed < kinks && p[0] >= 0.01 * passed) ++passed;
    return static_cast<std::uint64_t>(passed);
  });
  Options options = window(-0.5, 1.5);
  options.step.curve_tolerance = 1e-4;
  options.step.largest_parameter = 10;
  options.step.initial = 1.7;
  const Branch branch = trace(problem, on(u_of, -0.5), options, {peak_of_u()});
  REQUIRE(branch.stop.reason == StopReason::boundary);
  REQUIRE(branch.events.size() == 1);
  CHECK(std::abs(slope(branch.events[0].point.parameter)) < 1e-9);
}

TEST_CASE("a kink too small to turn the branch is passed whatever curve_tolerance asks next to it") {
  const auto slope = [](double u) { return u < 0 ? 1.0 : 1.5; };
  const auto problem =
      from_functions({.size = 1,
                      .parameters = {parameter("p", 0)},
                      .residual = [=](In u, In p, Out F) { F[0] = slope(u[0]) * u[0] - std::sin(p[0]); },
                      .jacobian = [=](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = slope(u[0]); },
                      .derivative = [](In, In p, int, Out dF) { dF[0] = -std::cos(p[0]); },
                      .piece = [](In u, In) { return u[0] < 0 ? 1 : 2; }});
  for (double tolerance : {1e-4, 1e-7, 1e-10}) {
    Options options = window(-1, 1);
    options.step.curve_tolerance = tolerance;
    const Branch branch = trace(problem, {Vector{{std::sin(-0.913)}}, Vector{{-0.913}}, 0, 1}, options);
    CAPTURE(tolerance, branch.stop.message);
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.counts.rejected_steps < 10);
  }
}

TEST_CASE(
    "many kinks are passed where the curve allows it, and a maximum between them is located all the same") {
  for (double tolerance : {1e-3, 1e-4, 1e-5}) {
    Options options = window(-1, 4);
    options.step.curve_tolerance = tolerance;
    options.step.largest_parameter = 10;
    options.step.pass_kinks = true;
    const Branch branch = ManyKinks::branch(options, {peak_of_u()});
    REQUIRE(branch.stop.reason == StopReason::boundary);
    REQUIRE(branch.events.size() == 1);
    const double at = branch.events[0].point.parameter;
    CHECK(std::abs(at - std::acos(-ManyKinks::slope_of_kinks(at))) < 1e-12);
    double worst = 0;
    for (int k = 0; k <= 5000; ++k) {
      const Point point = interpolate(branch, branch.points.back().arclength * k / 5000);
      const double exact = ManyKinks::value(point.parameter);
      worst = std::max(worst, std::abs(point.u[0] - exact) / exact);
    }
    options.step.pass_kinks = false;
    const Branch located = ManyKinks::branch(options, {peak_of_u()});
    CAPTURE(tolerance, worst, branch.points.size(), branch.counts.residuals, located.points.size(),
            located.counts.residuals);
    CHECK(worst < tolerance);
    CHECK(2 * branch.counts.residuals < located.counts.residuals);
  }
}

TEST_CASE("a piece that the branch enters and leaves within a step is seen by the curve") {
  // u = 2 + p + h (p - a)(b - p) between a and b, and 2 + p elsewhere. A third of the longest step, and more.
  const auto b = GENERATE(0.32, 0.41);
  constexpr double a = 0.21;
  const double height = 0.08 / ((b - a) * (b - a));
  const auto inside = [=](double p) { return p > a && p < b; };
  const auto u_of = [=](double p) { return 2 + p + (inside(p) ? height * (p - a) * (b - p) : 0.0); };
  const auto slope = [=](double p) { return 1 + (inside(p) ? height * (a + b - 2 * p) : 0.0); };
  const auto problem = graph(u_of, slope, [=](In, In p) { return inside(p[0]) ? 2 : 1; });
  for (double initial = 0.05; initial < 0.65; initial += 0.01) {
    Options options = window(-1, 1);
    options.step.curve_tolerance = 1e-3;
    options.step.largest_parameter = 0.3;
    options.step.initial = initial;
    options.step.pass_kinks = true;
    const Branch branch = trace(problem, on(u_of, -1), options, {peak_of_u()});
    REQUIRE(branch.stop.reason == StopReason::boundary);
    double worst = 0;
    for (int k = 0; k <= 2000; ++k) {
      const Point at = interpolate(branch, branch.points.back().arclength * k / 2000);
      const double departure = std::abs(at.u[0] - u_of(at.parameter)) / std::hypot(1, slope(at.parameter));
      worst = std::max(worst, departure / u_of(at.parameter));
    }
    CAPTURE(b, initial, worst, branch.points.size());
    CHECK(worst < 1e-3);
  }
}

TEST_CASE("kinks that a monitor asks for are located where others would be passed") {
  Options options = window(-1, 4);
  options.step.curve_tolerance = 1e-3;
  options.step.pass_kinks = true;
  const Branch branch = ManyKinks::branch(options, {kink_monitor()});
  for (int k = 0; k < ManyKinks::count; ++k) {
    if (std::abs(ManyKinks::strength(k)) < 5e-4) continue;
    double nearest = 1;
    for (const Event& event : branch.events)
      nearest = std::min(nearest, std::abs(event.point.parameter - ManyKinks::place(k)));
    CAPTURE(k);
    CHECK(nearest < 1e-9);
  }
}

TEST_CASE("where kinks are passed one that is not is found as the curve needs it, a peak exactly") {
  // u = 3 + a wave + s (p - c), s = 1 before c and another slope beyond it.
  constexpr double c = 0.237;
  for (const double beyond : {4.0, 0.02, -4.0}) {
    const auto on_side = [=](double p, double side) { return 3 + 0.02 * std::sin(3 * p) + side * (p - c); };
    const auto u_of = [=](double p) { return on_side(p, p < c ? 1 : beyond); };
    const auto slope = [=](double p) { return 0.06 * std::cos(3 * p) + (p < c ? 1 : beyond); };
    const auto problem = graph(u_of, slope, [=](In, In p) { return p[0] < c ? 1 : 2; });
    Options options = window(-0.4, 0.6);
    options.step.curve_tolerance = 1e-3;
    options.step.largest_parameter = 0.2;
    options.step.pass_kinks = true;
    const Branch branch = trace(problem, on(u_of, -0.4), options, {peak_of_u()});
    REQUIRE(branch.stop.reason == StopReason::boundary);
    double nearest = 1;
    for (const Point& point : branch.points) nearest = std::min(nearest, std::abs(point.parameter - c));
    CAPTURE(beyond, nearest);
    if (beyond < 0) {
      REQUIRE(branch.events.size() == 1);
      CHECK(std::abs(branch.events[0].point.parameter - c) < 1e-11);
      CHECK(branch.events[0].nonsmooth);
      continue;
    }
    CHECK(branch.events.empty());
    if (beyond < 1) {  // where u bends too much to pass it: a point of the branch
      CHECK(nearest < 2e-5);
      CHECK(nearest > 1e-11);
      continue;
    }
    double worst = 0;
    for (int k = 0; k <= 5000; ++k) {
      const Point at = interpolate(branch, branch.points.back().arclength * k / 5000);
      const double p = at.parameter;
      const auto from = [&](double side) {  // of the branch, either side of which is nearby at the kink
        return std::abs(at.u[0] - on_side(p, side)) / std::hypot(1, 0.06 * std::cos(3 * p) + side);
      };
      const double own = from(p < c ? 1 : beyond), other = from(p < c ? beyond : 1);
      worst = std::max(worst, (std::abs(p - c) < 0.01 ? std::min(own, other) : own) / u_of(p));
    }
    CAPTURE(worst);
    CHECK(worst < 1e-3);
  }
}

TEST_CASE("kinks are passed by the error of the curve alone: without a tolerance of it they are not") {
  Options options = window(-1, 4);
  options.step.pass_kinks = true;
  CHECK_THROWS_AS(ManyKinks::branch(options, {}), std::invalid_argument);
}
