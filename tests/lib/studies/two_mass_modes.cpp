// The accuracy that damped modes of two masses are reported to have, compared with shooting with Runge-Kutta
// steps.
#include "catch.hpp"
#include "random.hpp"

#include "lib/studies/first_mode.hpp"
#include "lib/studies/mode_accuracy.hpp"

#include <Eigen/LU>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>

using namespace arcslip;
using Json = nlohmann::json;
using mode_accuracy::wanted;

namespace two_mass_modes {
namespace {

/// x on the ground, with a cubic spring b and a slider of stiffness d and limit F, and y on x:
///   m1 x'' + (c1 - g m1) x' + c2 (x' - y') + k1 x + k2 (x - y) + b x^3 + f = 0
///   m2 y'' - g m2 y' + c2 (y' - x') + k2 (y - x) = 0.
/// The negative damping g makes it periodic.
struct Pair {
  double m1, k1, c1, m2, k2, c2, b, d, F;
};

using State = std::array<double, 5>;  // x, y, x', y', f

State rate(const Pair& of, double g, const State& s) {
  const auto [x, y, vx, vy, f] = s;
  const bool slips = std::abs(f) >= of.F && f * vx > 0;
  const double link = of.k2 * (x - y) + of.c2 * (vx - vy);
  return {vx, vy, g * vx - (of.c1 * vx + of.k1 * x + of.b * x * x * x + f + link) / of.m1,
          g * vy + link / of.m2, slips ? 0 : of.d * vx};
}

State stepped(const Pair& of, double g, const State& s, double h) {
  const auto after = [&](const State& slope, double time) {
    State next = s;
    for (std::size_t i = 0; i < next.size(); ++i) next[i] += time * slope[i];
    return next;
  };
  const State s1 = rate(of, g, s), s2 = rate(of, g, after(s1, h / 2)), s3 = rate(of, g, after(s2, h / 2)),
              s4 = rate(of, g, after(s3, h));
  State next = s;
  for (std::size_t i = 0; i < next.size(); ++i) next[i] += h / 6 * (s1[i] + 2 * s2[i] + 2 * s3[i] + s4[i]);
  next[4] = std::clamp(next[4], -of.F, of.F);
  return next;
}

struct Half {
  double time;
  State end;  // where x' is zero again
};

/// From x = A at rest. step: of time; the last one is shortened.
Half half_motion(const Pair& of, double A, double y, double vy, double g, double step) {
  State now{A, y, 0, vy, std::min(of.d * A, of.F)};
  double time = 0;
  constexpr int most_steps = 1'000'000;
  State next = stepped(of, g, now, step);
  for (int i = 0; next[2] < 0 && i < most_steps; ++i) {
    now = next;
    time += step;
    next = stepped(of, g, now, step);
  }
  double within = 0, beyond = step;
  for (int i = 0; i < 60; ++i) {
    const double middle = (within + beyond) / 2;
    (stepped(of, g, now, middle)[2] < 0 ? within : beyond) = middle;
  }
  return {time + within, stepped(of, g, now, within)};
}

/// A periodic motion; y and y' where x is at its largest, over it.
struct FreeMotion {
  double omega, damping_ratio, y = 0, vy = 0;
};

/// Of amplitude A of x: the state at rest of x and its negative after a half. Nothing: Newton's method
/// failed.
std::optional<FreeMotion> shot(const Pair& of, double A, const FreeMotion& guess) {
  constexpr int steps = 10'000;  // of a half
  const double step = std::numbers::pi / guess.omega / steps;
  Eigen::Vector3d z(guess.y, guess.vy / guess.omega,
                    2 * guess.damping_ratio);  // y and y'/omega over A, g/omega
  const auto residual = [&](const Eigen::Vector3d& at) -> Eigen::Vector3d {
    const Half half = half_motion(of, A, A * at[0], A * guess.omega * at[1], guess.omega * at[2], step);
    return {half.end[0] / A + 1, half.end[1] / A + at[0], half.end[3] / (A * guess.omega) + at[1]};
  };
  for (int i = 0; i < 15; ++i) {
    const Eigen::Vector3d r = residual(z);
    if (r.norm() < 1e-11) break;
    Eigen::Matrix3d J;
    for (int k = 0; k < 3; ++k) {
      const double h = 1e-6;
      J.col(k) =
          (residual(z + h * Eigen::Vector3d::Unit(k)) - residual(z - h * Eigen::Vector3d::Unit(k))) / (2 * h);
    }
    z -= J.lu().solve(r);
  }
  if (!(residual(z).norm() < 1e-8)) return {};
  const double omega =
      std::numbers::pi / half_motion(of, A, A * z[0], A * guess.omega * z[1], guess.omega * z[2], step).time;
  return FreeMotion{omega, guess.omega * z[2] / (2 * omega), z[0], guess.omega * z[1]};
}

/// Of amplitude `to`, from that of amplitude `from`, through amplitudes between them where need be. Nothing
/// where x comes to rest several times in a half.
std::optional<FreeMotion> followed(const Pair& of, double from, const FreeMotion& there, double to,
                                   int depth = 8) {
  const auto found = shot(of, to, there);
  if (found && std::abs(found->omega / there.omega - 1) < 0.1 && std::abs(found->y / there.y - 1) < 0.1)
    return found;  // no motion of another mode
  if (depth == 0) return {};
  const double between = std::sqrt(from * to);
  const auto half_way = followed(of, from, there, between, depth - 1);
  return half_way ? followed(of, between, *half_way, to, depth - 1) : std::nullopt;
}

/// The first mode without friction and damping.
FreeMotion linear_mode(const Pair& of) {
  const double k1 = of.k1 + of.d, a = (k1 + of.k2) / of.m1, d = of.k2 / of.m2,
               bc = of.k2 * of.k2 / (of.m1 * of.m2);
  const double square = (a + d) / 2 - std::sqrt((a - d) * (a - d) / 4 + bc);
  return {std::sqrt(square), 0, (of.k1 + of.d + of.k2 - of.m1 * square) / of.k2, 0};
}

Json mode_of(const Pair& of, double from, double to) {
  std::ostringstream text;
  text.precision(17);
  text << R"("structure": {"dofs": ["x", "y"],
    "masses": [{"name": "m1", "at": "x", "value": )"
       << of.m1 << R"(}, {"name": "m2", "at": "y", "value": )" << of.m2
       << R"(}], "springs": [{"name": "k1", "at": "x", "value": )" << of.k1
       << R"(}, {"name": "k2", "between": ["x", "y"], "value": )" << of.k2
       << R"(}], "dampers": [{"name": "c1", "at": "x", "value": )" << of.c1
       << R"(}, {"name": "c2", "between": ["x", "y"], "value": )" << of.c2
       << R"(}]}, "elements": [{"name": "b", "type": "cubic_spring", "at": "x", "stiffness": )" << of.b
       << R"(}, {"name": "s", "type": "jenkins", "at": "x", "stiffness": )" << of.d
       << R"(, "friction_coefficient": 1, "normal_load": )" << of.F << "}]";
  return mode_accuracy::first_mode(text.str(), from, to);
}

}  // namespace

TEST_CASE("shooting has the frequency and the shape of two linear masses") {
  // Masses of 1 on springs of 2, and a slider of 1 that does not slip: frequencies 1 and sqrt(6), y = 2 x in
  // the first.
  const Pair of{1, 2, 0, 1, 2, 0, 0, 1, 10};
  const auto found = shot(of, 3, linear_mode(of));
  REQUIRE(found);
  CHECK(std::abs(found->omega - 1) < 1e-9);
  CHECK(std::abs(found->y - 2) < 1e-9);
  CHECK(std::abs(found->damping_ratio) < 1e-9);
}

TEST_CASE(
    "damped modes of two masses over four decades are within the accuracy that is reported, compared with "
    "shooting") {
  const std::uint64_t count = mode_accuracy::two_masses.count();
  std::uint64_t complete = 0;
  int motions = 0;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    test_random::Random random(seed);
    const double m = random.logarithmic(0.1, 10), k = random.logarithmic(0.1, 1e4);
    Pair of{m, k, 0, m * random.logarithmic(0.2, 2), k * random.logarithmic(0.5, 5), 0, 0, 0, 0};
    of.c1 = 2 * std::sqrt(k * m) * random.logarithmic(1e-4, 0.02);
    of.c2 = 2 * std::sqrt(k * m) * random.logarithmic(1e-4, 0.02);
    if (random.one_in(2)) of.b = of.k1 * random.logarithmic(1e-4, 0.1);
    of.d = of.k1 * random.logarithmic(0.03, 1);
    of.F = of.d * random.logarithmic(0.03, 3);  // slips from an amplitude of about 1 on
    const Json branch = mode_of(of, 1e-2, 1e2);
    CAPTURE(seed, of.m1, of.k1, of.c1, of.m2, of.k2, of.c2, of.b, of.d, of.F, branch["accuracy"].dump(),
            branch["stop"].dump());
    // At an internal resonance the mode folds.
    const Json& events = branch["events"];
    if (branch["status"] != "complete" ||
        std::any_of(events.begin(), events.end(), [](const Json& event) { return event["kind"] == "fold"; }))
      continue;
    ++complete;
    const Json& error = branch["accuracy"]["error"];
    REQUIRE(error.is_number());
    const double reported = error;
    double highest = 0;
    const auto& points = branch["points"];
    REQUIRE(points.size() > 20);
    for (const Json& point : points) highest = std::max(highest, point["damping_ratio"].get<double>());
    FreeMotion exact = linear_mode(of);
    double last = points[0]["amplitude"];
    for (std::size_t i = 0; i < points.size(); i += 5) {
      const FreeMotion here{points[i]["frequency"], points[i]["damping_ratio"]};
      const double amplitude = points[i]["amplitude"];
      CAPTURE(amplitude, here.omega, here.damping_ratio);
      const auto next = followed(of, last, exact, amplitude);
      if (!next) break;
      exact = *next;
      last = amplitude;
      const double away = std::max(std::abs(here.omega / exact.omega - 1),
                                   std::abs(here.damping_ratio - exact.damping_ratio) / highest);
      CAPTURE(exact.omega, exact.damping_ratio);
      CHECK(away < 2 * reported + 1e-6);
      if (reported <= wanted) CHECK(away < wanted);
      ++motions;
    }
  }
  std::cout << complete << " modes, " << motions << " motions" << std::endl;
  CHECK(2 * complete > count);
  CHECK(motions > 10 * static_cast<int>(complete));
}

}  // namespace two_mass_modes
