#include "catch.hpp"

#include "continuation/problems.hpp"

#include <arcslip/continuation/correction/corrector.hpp>

#include <algorithm>
#include <memory>
#include <vector>

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

TEST_CASE("a maximum at a kink is found with the minimum just beyond it, however near, from both sides") {
  // u = p before the kink and p/0.8 beyond, q = p + p^2 + 4 (1 + d)(p - u): of slopes 1 and -d at the kink,
  // with a minimum at p = d/2, lower by d^2/4, and another one at p = -1/2.
  for (double d : {1e-2, 1e-3, 1e-4, 1e-5})
    for (double from : {-0.9137, -0.8513, 0.7331}) {
      const double g = 4 * (1 + d);
      const auto slope = [=](const Accepted& now) {
        const double p = now.parameter, du = now.tangent[0], dp = now.tangent[1];
        return (1 + 2 * p + g) * dp - g * du;
      };
      const auto q = [=](const Accepted& now) {
        return now.parameter + now.parameter * now.parameter + g * (now.parameter - now.u[0]);
      };
      const double u = from < 0 ? from : from / 0.8;
      const Branch branch =
          trace(broken(1, 0.8), {Vector::Constant(1, u), Vector::Constant(1, from), 0, from < 0 ? 1 : -1},
                window(-0.95, 1),
                {{"maximum", slope, Crossing::falling, q}, {"minimum", slope, Crossing::rising, q}});
      CAPTURE(d, from, branch.points.size(), branch.counts.rejected_steps);
      const auto maxima = events_named(branch, "maximum"), minima = events_named(branch, "minimum");
      REQUIRE(maxima.size() == 1);
      CHECK(maxima[0].nonsmooth);
      CHECK(std::abs(maxima[0].point.parameter) < 1e-14);
      REQUIRE(minima.size() == 2);
      const Event& beyond = minima[from < 0 ? 1 : 0];
      CHECK_FALSE(beyond.nonsmooth);
      CHECK(std::abs(beyond.point.parameter - d / 2) < 1e-12);
    }
}

TEST_CASE("a slope of another sign at the kink alone is no extremum") {
  // Where u = 0 to rounding, dq/ds of q = u is given with the other sign, as derivatives by what is of no
  // length there may be.
  for (double above : {0.8, 2.0})
    for (double from : {-0.9137, -0.8513, 0.7331}) {
      const auto slope = [](const Accepted& now) {
        return std::abs(now.u[0]) < 1e-11 ? -now.tangent[0] : now.tangent[0];
      };
      const auto q = [](const Accepted& now) { return now.u[0]; };
      const Branch branch =
          trace(broken(1, above),
                {Vector::Constant(1, from < 0 ? from : from / above), Vector::Constant(1, from), 0,
                 from < 0 ? 1 : -1},
                window(-0.95, 1),
                {{"maximum", slope, Crossing::falling, q}, {"minimum", slope, Crossing::rising, q}});
      CAPTURE(above, from);
      CHECK(branch.stop.reason == StopReason::boundary);
      CHECK(branch.events.empty());
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

namespace {

// u with slopes s_0, s_1, ... between the kinks.
std::shared_ptr<const Problem> polygon(std::vector<double> slopes, std::vector<double> kinks) {
  const auto piece = [=](double u) {
    return static_cast<std::size_t>(std::upper_bound(kinks.begin(), kinks.end(), u) - kinks.begin());
  };
  const auto value = [=](double u) {
    double p = slopes[0] * u;
    for (std::size_t k = 0; k < piece(u); ++k) p += (slopes[k + 1] - slopes[k]) * (u - kinks[k]);
    return p;
  };
  return from_functions({.size = 1,
                         .parameters = {parameter("p", 0)},
                         .residual = [=](In u, In p, Out F) { F[0] = value(u[0]) - p[0]; },
                         .jacobian = [=](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = slopes[piece(u[0])]; },
                         .derivative = [](In, In, int, Out dF) { dF[0] = -1; },
                         .piece = [=](In u, In) { return piece(u[0]); }});
}

}  // namespace

TEST_CASE("three kinks in one step are three events in their order") {
  for (double from : {-0.9, -0.8731}) {
    const Branch branch = trace(polygon({1, 1.2, 1.1, 1.3}, {0, 1e-3, 2e-3}),
                                {Vector{{from}}, Vector{{from}}, 0, 1}, window(-1, 1), {kink_monitor()});
    REQUIRE(branch.events.size() == 3);
    for (int k = 0; k < 3; ++k)
      CHECK(std::abs(branch.events[static_cast<std::size_t>(k)].point.u[0] - k * 1e-3) < 1e-9);
  }
}

TEST_CASE("two nonsmooth folds within one step are both events where kinks are looked for") {
  for (double d : {1e-3, 1e-4, 1e-5})
    for (double back : {-0.5, -2.0})
      for (double from : {-0.9, -0.8731, -0.7}) {
        const Branch branch = trace(polygon({1, back, 1}, {0, d}), {Vector{{from}}, Vector{{from}}, 0, 1},
                                    window(-1, 1), {fold_monitor(), kink_monitor()});
        CAPTURE(d, back, from, branch.stop.message, branch.points.size());
        CHECK(branch.stop.reason == StopReason::boundary);
        const auto folds = events_named(branch, "fold"), kinks = events_named(branch, "kink");
        REQUIRE(folds.size() == 2);
        REQUIRE(kinks.size() == 2);
        for (std::size_t k = 0; k < 2; ++k) {
          CHECK(folds[k].nonsmooth);
          CHECK(std::abs(folds[k].point.u[0] - static_cast<double>(k) * d) < 1e-9);
          CHECK(std::abs(kinks[k].point.u[0] - static_cast<double>(k) * d) < 1e-9);
        }
        CHECK(std::get<Kink>(kinks[0].data).after[1] * back > 0);
      }
}

TEST_CASE("a second kink just beyond a corner is an event of its own") {
  for (double d : {1e-5, 3e-6, 1e-6})
    for (double from : {-0.9137, -0.8513, -0.7331}) {
      const Branch branch = trace(polygon({1, -3, -1}, {0, d}), {Vector{{from}}, Vector{{from}}, 0, 1},
                                  window(-1, 1), {fold_monitor(), kink_monitor()});
      CAPTURE(d, from, branch.stop.message);
      CHECK(branch.stop.reason == StopReason::boundary);
      CHECK(events_named(branch, "fold").size() == 1);
      const auto kinks = events_named(branch, "kink");
      REQUIRE(kinks.size() == 2);
      CHECK(std::abs(kinks[0].point.u[0]) < 1e-9);
      CHECK(std::abs(kinks[1].point.u[0] - d) < 1e-9);
      CHECK(std::abs(std::get<Kink>(kinks[0].data).after[1] / std::get<Kink>(kinks[0].data).after[0] + 3) <
            1e-9);
    }
}

TEST_CASE("a kink on a curved branch is located with few factorizations, at the end of its piece") {
  // sin u + max(0, u - d) / 2 = p
  for (double d : {0.0, 0.3, 0.71}) {
    const auto problem = from_functions(
        {.size = 1,
         .parameters = {parameter("p", 0)},
         .residual = [=](In u, In p, Out F) { F[0] = std::sin(u[0]) + std::max(0.0, u[0] - d) / 2 - p[0]; },
         .jacobian = [=](In u, In, Eigen::Ref<Matrix> J) { J(0, 0) = std::cos(u[0]) + (u[0] > d ? 0.5 : 0); },
         .derivative = [](In, In, int, Out dF) { dF[0] = -1; },
         .piece = [=](In u, In) { return u[0] > d ? 2 : 1; }});
    const Start start{Vector{{-0.9}}, Vector{{std::sin(-0.9)}}, 0, 1};
    const Branch without = trace(problem, start, window(-1, 1));
    const Branch with = trace(problem, start, window(-1, 1), {kink_monitor()});
    CAPTURE(d);
    REQUIRE(with.events.size() == 1);
    CHECK(std::abs(with.events[0].point.u[0] - d) < 1e-12);
    CHECK(with.events[0].point.u[0] <= d);
    CHECK(with.counts.factorizations - without.counts.factorizations <= 12);
    CHECK(with.counts.residuals - without.counts.residuals <= 120);
  }
}

TEST_CASE("a corner is passed where the piece just beyond it ends at once") {
  // As where one element turns at 0 and another one at d: a step along the tangent between them leads
  // nowhere.
  for (double d : {1e-10, 1e-11, 1e-12})
    for (double back : {-3.0, -20.0})
      for (double from : {-0.9137, -0.8513, -0.7331}) {
        const Branch branch = trace(polygon({1, 0.9, back}, {0, d}), {Vector{{from}}, Vector{{from}}, 0, 1},
                                    window(-1, 1), {fold_monitor()});
        CAPTURE(d, back, from, branch.points.size(), branch.stop.message);
        CHECK(branch.stop.reason == StopReason::boundary);
        CHECK(branch.points.back().parameter == -1);
        REQUIRE(branch.events.size() == 1);
        CHECK(std::abs(branch.events[0].point.u[0] - d) < 1e-9);
        CHECK(branch.counts.rejected_steps < 40);
      }
}

TEST_CASE("the parameter moves no further beyond a kink than in any other step") {
  // Where it hardly moves before the kink, steps are long.
  for (double above : {10.0, 100.0})
    for (double from : {-5.0, -4.7, -4.3}) {
      const Branch branch = trace(polygon({1e-3, above}, {0}), {Vector{{from}}, Vector{{1e-3 * from}}, 0, 1},
                                  window(-1, 1), {fold_monitor()});
      CAPTURE(above, from);
      CHECK(branch.stop.reason == StopReason::boundary);
      for (std::size_t k = 1; k < branch.points.size(); ++k)
        CHECK(branch.points[k].parameter - branch.points[k - 1].parameter < 1.6 * 0.02);
    }
}

TEST_CASE("corrections to and fro across a kink are no rounding: there is no solution") {
  const double gap = 2e-8;  // |u_2| + gap = 0 has none, however near zero it comes
  const auto problem =
      from_functions({.size = 2,
                      .parameters = {parameter("p", 0)},
                      .residual =
                          [=](In u, In p, Out F) {
                            F[0] = u[0] - 1 - p[0];
                            F[1] = std::abs(u[1]) + gap;
                          },
                      .jacobian = [](In u, In, Eigen::Ref<Matrix> J) { J << 1, 0, 0, u[1] < 0 ? -1 : 1; },
                      .derivative = [](In, In, int, Out dF) { dF << -1, 0; },
                      .piece = [](In u, In) { return u[1] < 0 ? 1 : 2; }});
  Counts counts;
  Corrector corrector(*problem, Vector::Zero(1), 0, {}, counts);
  Vector v{{1.0, 1e-9, 0.0}};
  const Correction correction = corrector.correct(v, Vector{{0.0, 0.0, 1.0}}, false);
  CHECK(correction.last < NewtonOptions{}.rounding_level);
  CHECK_FALSE(correction.converged);
}

TEST_CASE(
    "a maximum just beyond where a quantity goes over from one to another is found, wherever points lie") {
  // q is the larger of -4 p and 2 d p - p^2: a minimum at 0, where they cross, and a maximum at d.
  const auto line = from_functions({.size = 1,
                                    .parameters = {parameter("p", 0)},
                                    .residual = [](In u, In p, Out F) { F[0] = u[0] - p[0]; },
                                    .jacobian = [](In, In, Eigen::Ref<Matrix> J) { J(0, 0) = 1; },
                                    .derivative = [](In, In, int, Out dF) { dF[0] = -1; }});
  for (double d : {3e-3, 1e-3, 1e-4, 1e-5})
    for (int k = 0; k < 40; ++k)
      for (int direction : {1, -1}) {
        const auto second = [=](double p) { return p > 0 && p < 2 * d + 4; };
        const auto slope = [=](const Accepted& now) {
          const double p = now.parameter;
          return (second(p) ? 2 * (d - p) : -4.0) * now.tangent[1];
        };
        const auto q = [=](const Accepted& now) {
          const double p = now.parameter;
          return second(p) ? 2 * d * p - p * p : -4 * p;
        };
        Monitor maximum{"maximum", slope, Crossing::falling, q};
        maximum.part = [=](const Accepted& now) { return second(now.parameter) ? 1 : 0; };
        const double from = direction * (-0.9 + 5e-4 * k);
        const Branch branch =
            trace(line, {Vector{{from}}, Vector{{from}}, 0, direction}, window(-1, 1), {maximum});
        CAPTURE(d, from, branch.points.size());
        REQUIRE(branch.events.size() == 1);
        CHECK_FALSE(branch.events[0].nonsmooth);
        CHECK(std::abs(branch.events[0].point.parameter - d) < 1e-12);
      }
}

namespace {

// u = sin p + the sum of e_k max(0, p - p_k), e_k = -+1e-6, p_k = 0.01 k + 0.005: 250 kinks up to p = 2.5.
constexpr double weak = 1e-6;
double bend_of(int k) {
  return k % 2 == 0 ? -weak : weak;
}
double place_of(int k) {
  return 0.01 * k + 0.005;
}

std::shared_ptr<const Problem> many_weak_kinks() {
  const auto slopes = [](double p, auto&& add) {
    for (int k = 0; place_of(k) < p; ++k) add(bend_of(k), p - place_of(k));
  };
  return from_functions({.size = 1,
                         .parameters = {parameter("p", 0)},
                         .residual =
                             [=](In u, In p, Out F) {
                               F[0] = u[0] - std::sin(p[0]);
                               slopes(p[0], [&](double bend, double beyond) { F[0] -= bend * beyond; });
                             },
                         .jacobian = [](In, In, Eigen::Ref<Matrix> J) { J(0, 0) = 1; },
                         .derivative =
                             [=](In, In p, int, Out dF) {
                               dF[0] = -std::cos(p[0]);
                               slopes(p[0], [&](double bend, double) { dF[0] -= bend; });
                             },
                         .piece = [](In, In p) { return static_cast<std::uint64_t>(100 * p[0] + 0.5); }});
}

}  // namespace

TEST_CASE("kinks too weak to matter are passed without a look, and the maximum among them is exact") {
  Options options = window(0, 2.5);
  options.step.curve_tolerance = 1e-5;
  const Monitor maximum{"maximum", [](const Accepted& now) { return now.tangent[0]; }, Crossing::falling,
                        [](const Accepted& now) { return now.u[0]; }};
  const Branch branch = trace(many_weak_kinks(), at(0, 0), options, {maximum});
  REQUIRE(branch.stop.reason == StopReason::boundary);
  REQUIRE(branch.events.size() == 1);
  // 157 kinks lie below pi/2: their bends add up to that of the first.
  CHECK(std::abs(branch.events[0].point.parameter - std::acos(weak)) < 1e-11);
  CHECK(branch.counts.residuals < 10 * branch.counts.points);
  const Branch with = trace(many_weak_kinks(), at(0, 0), options, {maximum, kink_monitor()});
  CHECK(with.events.size() == 1);  // below 1e-4 rad they are no events
  CHECK(with.counts.residuals > 10 * branch.counts.residuals);
}

TEST_CASE("a maximum and a minimum at two kinks of one step are found, however weak the kinks") {
  // u = s p, of slope -s between p = 0 and p = d.
  for (const double slope : {1e-2, 1e-4, 1e-6})
    for (const double d : {5e-3, 1e-3})
      for (const double from : {-0.9137, -0.8513, -0.7331}) {
        const auto problem = from_functions(
            {.size = 1,
             .parameters = {parameter("p", 0)},
             .residual =
                 [=](In u, In p, Out F) {
                   F[0] = u[0] - slope * (p[0] - 2 * std::max(0.0, p[0]) + 2 * std::max(0.0, p[0] - d));
                 },
             .jacobian = [](In, In, Eigen::Ref<Matrix> J) { J(0, 0) = 1; },
             .derivative = [=](In, In p, int, Out dF) { dF[0] = p[0] > 0 && p[0] < d ? slope : -slope; },
             .piece = [=](In, In p) { return p[0] > d   ? 3
                                             : p[0] > 0 ? 2
                                                        : 1; }});
        const auto du = [](const Accepted& now) { return now.tangent[0]; };
        const auto u = [](const Accepted& now) { return now.u[0]; };
        Options options = window(-1, 1);
        options.step.curve_tolerance = 1e-5;
        const Branch branch =
            trace(problem, at(slope * from, from), options,
                  {{"maximum", du, Crossing::falling, u}, {"minimum", du, Crossing::rising, u}});
        CAPTURE(slope, d, from, branch.points.size());
        REQUIRE(branch.events.size() == 2);
        CHECK(branch.events[0].monitor == "maximum");
        CHECK(std::abs(branch.events[0].point.parameter) < 1e-11);
        CHECK(std::abs(branch.events[1].point.parameter - d) < 1e-11);
      }
}
