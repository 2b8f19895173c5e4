// Prediction, correction and the control of steps.

#include "catch.hpp"

#include "graphs.hpp"

#include <numbers>
#include <utility>

using namespace graphs;

namespace {

Branch cusp_branch(const Options& options) {
  return trace(cusp(), {Vector::Constant(1, -1.3), Vector{{-1.0, 1.0}}, 0, 1}, options, {fold_monitor()});
}

}  // namespace

TEST_CASE("the folds of mu + x - x^3 are found with and without chord steps") {
  for (bool chord : {false, true}) {
    Options options = window(-1, 1);
    options.newton.chord = chord;
    const Branch branch = cusp_branch(options);
    CAPTURE(chord, branch.stop.message);
    CHECK(branch.stop.reason == StopReason::boundary);
    REQUIRE(branch.events.size() == 2);
    CHECK(std::abs(branch.events[0].point.parameter - 0.3849001794597505) < 1e-14);
    CHECK(std::abs(branch.events[1].point.parameter + 0.3849001794597505) < 1e-14);
    for (const Point& point : branch.points)
      CHECK(std::abs(point.parameter - (std::pow(point.u[0], 3) - point.u[0])) < 1e-12);
  }
}

TEST_CASE("a closed branch ends where it began, at the length of its way round") {
  for (int direction : {1, -1})
    for (double start : {0.0, 0.6, -0.95}) {
      const Vector p{{start}}, u{{std::sqrt(1 - start * start)}};
      Options options = window(-2, 2);
      options.step.curve_tolerance = 1e-9;
      const Branch branch = trace(circle(), {u, p, 0, direction}, options, {fold_monitor()});
      REQUIRE(branch.stop.reason == StopReason::closed);
      CHECK(branch.events.size() == 2);
      CHECK(branch.points.back().u == branch.points.front().u);
      CHECK(branch.points.back().parameter == branch.points.front().parameter);
      CHECK(branch.points.back().arclength == Approx(2 * std::numbers::pi).epsilon(1e-3));
    }
}

TEST_CASE(
    "the curve between the points is as near to the branch as curve_tolerance asks, and no closer than need "
    "be") {
  std::size_t points_before = 0;
  for (double tolerance : {1e-3, 1e-5, 1e-7, 1e-9}) {
    Options options = window(-1, 1);
    options.step.curve_tolerance = tolerance;
    options.step.largest_parameter = 10;
    options.step.angle = 0.5;
    const Branch branch = cusp_branch(options);
    REQUIRE(branch.stop.reason == StopReason::boundary);
    double worst = 0;
    for (int k = 0; k <= 2000; ++k) {
      const Point at = interpolate(branch, branch.points.back().arclength * k / 2000);
      const double x = at.u[0], slope = 3 * x * x - 1;
      worst = std::max(
          worst, std::abs(at.parameter - (x * x * x - x)) / std::sqrt(1 + slope * slope) / (1 + std::abs(x)));
    }
    CAPTURE(tolerance, worst, branch.points.size());
    CHECK(worst < tolerance);
    CHECK(branch.points.size() > points_before);
    points_before = branch.points.size();
  }
  CHECK(points_before < 700);
}

TEST_CASE("the curve is as near to the branch, relative to |u|, where |u| is small in scales") {
  for (double tolerance : {1e-3, 1e-5, 1e-7}) {
    constexpr double size = 1e-4;
    const auto wave = [](double p) { return size * (2 + std::sin(9 * p)); };
    const auto slope = [](double p) { return size * 9 * std::cos(9 * p); };
    Options options = window(-1, 1);
    options.step.curve_tolerance = tolerance;
    options.step.largest_parameter = 10;
    const Branch branch = trace(graph(wave, slope), on(wave, -1), options);
    REQUIRE(branch.stop.reason == StopReason::boundary);
    double worst = 0;
    for (int k = 0; k <= 2000; ++k) {
      const Point at = interpolate(branch, branch.points.back().arclength * k / 2000);
      worst = std::max(worst, std::abs(at.u[0] / wave(at.parameter) - 1));
    }
    CAPTURE(tolerance, worst, branch.points.size());
    CHECK(worst < tolerance);
    CHECK(branch.points.size() < 300);
  }
}

TEST_CASE("a resonance in the part of a step before a kink is seen as in any other step") {
  // From p = -0.5 to a kink at 0.1 the branch is straight, but for a bump in the middle; so its slopes and
  // its change from end to end tell of none.
  constexpr double middle = -0.2, width = 0.04, height = 0.05;
  const auto bump = [=](double p) { return height * std::exp(-std::pow((p - middle) / width, 2)); };
  const auto u_of = [=](double p) { return 2 + (p < 0.1 ? -0.5 : 0.3) * (p - 0.1) + bump(p); };
  const auto slope = [=](double p) {
    return (p < 0.1 ? -0.5 : 0.3) - 2 * (p - middle) / (width * width) * bump(p);
  };
  const auto problem = graph(u_of, slope, [](In, In p) { return p[0] < 0.1 ? 1 : 2; });
  Options options = window(-0.5, 1);
  options.step.curve_tolerance = 1e-4;
  options.step.largest_parameter = 10;
  options.step.largest_angle = 1.2;
  options.step.initial = 0.9;
  const Branch branch = trace(problem, on(u_of, -0.5), options, {peak_of_u()});
  REQUIRE(branch.stop.reason == StopReason::boundary);
  REQUIRE(branch.events.size() == 1);
  CHECK(branch.events[0].located);
  CHECK(std::abs(slope(branch.events[0].point.parameter)) < 1e-9);
}

TEST_CASE("resonances narrower than a tenth of a step are seen, wherever in a step they lie") {
  constexpr int places = 20;
  for (const auto& [height, width] : {std::pair{3e-4, 4e-4}, std::pair{1e-3, 2e-4}})
    for (int k = 0; k < places; ++k) {
      const double step = 1.0 / 150, middle = 0.5 + k * step / places, h = height, w = width;
      const auto line = [=](double p) { return std::pow(p - middle, 2) + w * w; };
      const auto u_of = [=](double p) { return 1 + 0.2 * p + h * w * w / line(p); };
      const auto slope = [=](double p) { return 0.2 - 2 * h * w * w * (p - middle) / std::pow(line(p), 2); };
      Options options = window(0, 1);
      options.step.largest_parameter = step;
      options.step.curve_tolerance = 1e-5;
      const Branch branch = trace(graph(u_of, slope), on(u_of, 0), options, {peak_of_u()});
      CAPTURE(height, width, k, branch.counts.points);
      CHECK(branch.events.size() == 1);
      CHECK(branch.counts.points < 220);
    }
}

TEST_CASE("a kink next to the start of a window that is narrow next to p does not close the branch") {
  const auto slope = [](double u) { return u < 2 ? 1.0 : 1.5; };
  const auto problem = from_functions(
      {.size = 1,
       .parameters = {parameter("p", 0, 1e-4)},
       .residual = [=](In u, In p, Out F) { F[0] = slope(u[0]) * (u[0] - 2) - (p[0] - 1) / 1e-4; },
       .jacobian = [=](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = slope(u[0]); },
       .derivative = [](In, In, int, Out dF) { dF[0] = -1e4; },
       .piece = [](In u, In) { return u[0] < 2 ? 1 : 2; }});
  Options options = window(1 - 5e-7, 1 + 1e-4);
  options.step.initial = 0.002;
  const Branch branch =
      trace(problem, {Vector{{2.0}}, Vector{{options.lower}}, 0, 1}, options, {kink_monitor()});
  CAPTURE(branch.stop.message);
  CHECK(branch.stop.reason == StopReason::boundary);
  CHECK(branch.events.size() == 1);
}

TEST_CASE("a step before a sharp turn is shortened as its error is seen to fall") {
  // Of 0.2 rad within 1e-5, 1e-3 behind the start.
  constexpr double width = 1e-5, place = 0.3;
  const auto u_of = [](double p) { return 2 + 0.1 * std::hypot(p - place, width); };
  const auto slope = [](double p) { return 0.1 * (p - place) / std::hypot(p - place, width); };
  const auto problem = graph(u_of, slope, [](In, In) { return 1; });
  Options options = window(-0.5, 1);
  options.step.curve_tolerance = 1e-3;
  options.step.largest_parameter = 0.3;
  options.step.initial = 0.25;
  int first = 0;
  options.on_rejection = [&](const Rejection& now) { first += now.parameter == place - 1e-3 ? 1 : 0; };
  const Branch branch = trace(problem, on(u_of, place - 1e-3), options);
  REQUIRE(branch.stop.reason == StopReason::boundary);
  CAPTURE(branch.counts.rejected_steps, branch.points.size(), first);
  CHECK(first <= 3);
}

TEST_CASE("no point of a branch lies between its ends' arclengths and beyond") {
  const Branch branch = cusp_branch(window(-1, 1));
  CHECK(interpolate(branch, branch.points.back().arclength * (1 + 1e-15)).parameter ==
        branch.points.back().parameter);
  CHECK_THROWS_AS(interpolate(branch, -1e-3), std::out_of_range);
  CHECK_THROWS_AS(interpolate(branch, branch.points.back().arclength + 1e-3), std::out_of_range);
  const Point& middle = branch.points[branch.points.size() / 2];
  CHECK((interpolate(branch, middle.arclength).u - middle.u).norm() < 1e-14);
}

TEST_CASE("steps are no longer than step.largest") {
  Options options = window(-1, 1);
  options.step.largest = 0.004;
  const Branch branch = cusp_branch(options);
  for (std::size_t k = 1; k < branch.points.size(); ++k)
    CHECK(branch.points[k].arclength - branch.points[k - 1].arclength < 0.0041);
}

TEST_CASE("a branch starts along a tangent that is given") {
  const double s = std::sqrt(0.5);
  for (double sign : {1.0, -1.0}) {
    // At the fold itself, where the parameter reports no direction.
    const Branch branch =
        trace(circle(), {Vector{{1e-9}}, Vector{{1.0}}, 0, 1, Vector{{sign, 0.0}}}, window(-2, 2));
    REQUIRE(branch.points.size() > 3);
    CHECK(branch.points[2].u[0] * sign > 0);
    CHECK(branch.stop.reason == StopReason::closed);
  }
  CHECK_THROWS_AS(trace(circle(), {Vector{{s}}, Vector{{s}}, 0, 1, Vector{{1.0}}}, window(-2, 2)),
                  std::invalid_argument);
}

TEST_CASE("at p = 0, where a step relative to p would be none, the largest step in p still holds") {
  Options options = window(0, 1);
  options.step.initial = 0.5;
  options.step.largest_parameter = 0.01;
  options.step.relative_parameter = 0.1;
  options.points = 2;
  const auto line = from_functions(1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = u[0] - p[0]; });
  const Branch branch = trace(line, at(0, 0), options);
  CHECK(branch.points.back().parameter == Approx(0.01));
}

TEST_CASE("a helix that passes its start nearer than steps are long is not closed") {
  for (double scale : {1e3, 1e4, 1e5}) {  // of the angle: the pitch in scales is 2 pi / scale
    Functions f;
    f.size = 2;
    f.parameters = {parameter("x", 0)};
    f.scales = Vector{{scale, 1.0}};
    f.residual = [](In u, In p, Out F) {
      F[0] = p[0] - std::cos(u[0]);
      F[1] = u[1] - std::sin(u[0]);
    };
    f.jacobian = [](In u, In, Eigen::Ref<Matrix> J) { J << std::sin(u[0]), 0, -std::cos(u[0]), 1; };
    f.derivative = [](In, In, int, Out dF) { dF << 1, 0; };
    Options options = window(-2, 2);
    options.step.largest_parameter = 1;
    options.points = 200;
    const Branch branch =
        trace(from_functions(f), {Vector{{0.5, std::sin(0.5)}}, Vector{{std::cos(0.5)}}, 0, 1}, options);
    CAPTURE(scale, branch.stop.message);
    CHECK(branch.stop.reason == StopReason::point_limit);
    CHECK(std::abs(branch.points.back().u[0] - 0.5) > 12);
    for (const Point& point : branch.points) CHECK(std::abs(point.parameter - std::cos(point.u[0])) < 1e-8);
  }
}

TEST_CASE("the parameter moves no further in a step than asked for, where the branch turns towards it too") {
  // p = 5 u^2, from its vertex, in a scale in which it is flat there.
  const auto problem =
      from_functions({.size = 1,
                      .parameters = {parameter("p", 0, 100)},
                      .residual = [](In u, In p, Out F) { F[0] = p[0] - 5 * u[0] * u[0]; },
                      .jacobian = [](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = -10 * u[0]; },
                      .derivative = [](In, In, int, Out dF) { dF[0] = 1; }});
  Options options = window(-1, 3);
  options.step.largest_parameter = 0.02;
  options.step.initial = 0.4;
  const Branch branch = trace(problem, {Vector{{0.0}}, Vector{{0.0}}, 0, 1, Vector{{1.0, 0.0}}}, options);
  CHECK(branch.stop.reason == StopReason::boundary);
  for (std::size_t k = 1; k < branch.points.size(); ++k)
    CHECK(branch.points[k].parameter - branch.points[k - 1].parameter < 0.031);
}

TEST_CASE("a quantity's curve departs from the chords between its points by no more than asked for") {
  // u = 1 + 1/(1 + 9 p^2)
  const auto q = [](double p) { return 1 + 1 / (1 + 9 * p * p); };
  const auto slope = [](double p) { return -18 * p / std::pow(1 + 9 * p * p, 2); };
  // The largest share over all chords, of q or of p, whichever is less.
  const auto departure = [&](double tolerance) {
    Monitor monitor{.name = "extreme", .value = [](const Accepted& now) { return now.tangent[0]; }};
    monitor.quantity = [](const Accepted& now) { return now.u[0]; };
    monitor.chord_tolerance = tolerance;
    Options options = window(-3, 3);
    options.step.largest_parameter = 1;
    const Branch branch = trace(graph(q, slope), on(q, -3), options, {monitor});
    CHECK(branch.stop.reason == StopReason::boundary);
    REQUIRE(branch.events.size() == 1);
    CHECK(std::abs(branch.events[0].point.parameter) < 1e-9);
    double largest = 0;
    for (std::size_t k = 1; k < branch.points.size(); ++k) {
      const double a = branch.points[k - 1].parameter, b = branch.points[k].parameter;
      for (const double share : {0.2, 0.35, 0.5, 0.65, 0.8}) {
        const double p = a + share * (b - a), off = std::abs(q(p) - q(a) - share * (q(b) - q(a)));
        largest = std::max(largest, std::min(off / q(p), off / std::abs(slope(p) * p)));
      }
    }
    return largest;
  };
  CHECK(departure(0) > 5e-3);
  CHECK(departure(1e-3) < 1.2e-3);
  CHECK(departure(1e-4) < 1.2e-4);
}

TEST_CASE("a branch that is all but straight takes the steps that its window asks for, in any unit of p") {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    const double end = 1e4 * unit;
    const auto problem = from_functions(
        1, {{"p", ""}}, [=](In u, In p, Out F) { F[0] = u[0] - 1e-3 * std::sin(p[0] / (1e3 * unit)); });
    const Branch branch = trace(problem, at(0, 0), window(0, end));
    CAPTURE(unit, branch.counts.points);
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.counts.points > 100);
    CHECK(branch.counts.points < 110);
  }
}

TEST_CASE("relative_state limits the change of u, not the whole step") {
  const auto problem =
      from_functions(1, {parameter("p", 0)}, [](In u, In p, Out F) { F[0] = u[0] - 0.01 * p[0]; });
  Options options = window(0, 1000);
  options.step.largest_parameter = 100;
  options.step.relative_state = 0.1;
  const Branch branch = trace(problem, at(0, 0), options);
  double largest = 0;
  for (std::size_t k = 1; k < branch.points.size(); ++k) {
    const double before = branch.points[k - 1].u[0], change = branch.points[k].u[0] - before;
    CHECK(change < 0.1 * (1 + before) * (1 + 1e-8));  // du/dp by differences
    largest = std::max(largest, change / (1 + before));
  }
  CHECK(largest > 0.099);
}

TEST_CASE("a scale that is given is kept, whatever the window") {
  for (const double scale : {0.1, 10.0}) {
    const auto problem =
        from_functions(1, {parameter("p", 0, scale)}, [](In u, In p, Out F) { F[0] = u[0] - 0 * p[0]; });
    const Branch branch = trace(problem, at(0, 0), window(0, 1));
    CHECK(branch.points.back().arclength == Approx(1 / scale));
  }
  const auto problem =
      from_functions(1, {{"p", "", 0, 0, 0, 5}}, [](In u, In p, Out F) { F[0] = u[0] - 0 * p[0]; });
  const Branch branch = trace(problem, at(0, 0), window(0, 100));
  CHECK(branch.points.back().arclength == Approx(1));
}
