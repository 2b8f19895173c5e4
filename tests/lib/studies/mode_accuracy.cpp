// The accuracy that modes are reported to have, next to the energy integral of conservative oscillators, and
// compared with shooting with Runge-Kutta steps of damped ones.
#include "catch.hpp"
#include "random.hpp"

#include "lib/studies/first_mode.hpp"
#include "lib/studies/mode_accuracy.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>

using namespace arcslip;
using Json = nlohmann::json;
using mode_accuracy::first_mode;
using mode_accuracy::wanted;

namespace {

/// m x'' + k x + b x^3 + d max(x - corner, 0) = 0.
struct Oscillator {
  double m, k, b, d, corner;

  double potential(double x) const {
    const double beyond = std::max(x - corner, 0.0);
    return k * x * x / 2 + b * x * x * x * x / 4 + d * beyond * beyond / 2;
  }
  double force(double x) const { return k * x + b * x * x * x + d * std::max(x - corner, 0.0); }

  /// The negative end of a motion from x > 0, where the potential is the same.
  double opposite(double x) const {
    double outer = -x, inner = 0;
    while (potential(outer) < potential(x)) outer *= 2;
    for (int i = 0; i < 100; ++i) {
      const double middle = (outer + inner) / 2;
      (potential(middle) < potential(x) ? inner : outer) = middle;
    }
    return (outer + inner) / 2;
  }

  /// The time from an end of the motion to a place on the way, by x = end + (place - end) s^2 and the
  /// midpoint rule over s with Richardson's extrapolation. V(end) - V(x) is the mean force times the
  /// distance.
  double time_between(double end, double place) const {
    const auto sum = [&](int count) {
      double all = 0;
      for (int i = 0; i < count; ++i) {
        const double s = (i + 0.5) / count, x = end + (place - end) * s * s;
        all += 2 * s * std::abs(place - end) / std::sqrt(2 / m * (potential(end) - potential(x))) / count;
      }
      return all;
    };
    return (4 * sum(20'000) - sum(10'000)) / 3;
  }

  /// rad/s, at an amplitude of half the way between the ends.
  double frequency(double amplitude) const {
    double lower = 0, upper = 2 * amplitude;
    for (int i = 0; i < 100; ++i) {
      const double middle = (lower + upper) / 2;
      (middle - opposite(middle) < 2 * amplitude ? lower : upper) = middle;
    }
    const double right = (lower + upper) / 2, left = opposite(right);
    return std::numbers::pi / (time_between(left, 0) + time_between(right, 0));
  }
};

/// Results of modes of one mass, with these elements.
Json modes_of(double m, double k, double c, const std::string& elements, double from, double to) {
  std::ostringstream text;
  text.precision(17);
  text << R"("structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": )" << m
       << R"(}], "springs": [{"name": "k", "at": "x", "value": )" << k
       << R"(}], "dampers": [{"name": "c", "at": "x", "value": )" << c << R"(}]}, "elements": [)" << elements
       << "]";
  return first_mode(text.str(), from, to);
}

std::string cubic_spring(double stiffness) {
  std::ostringstream text;
  text.precision(17);
  text << R"({"name": "b", "type": "cubic_spring", "at": "x", "stiffness": )" << stiffness << '}';
  return text.str();
}

std::string stop(double stiffness, double corner) {
  std::ostringstream text;
  text.precision(17);
  text << R"({"name": "d", "type": "bilinear_spring", "at": "x", "stiffness": 0, "stiffness_beyond": )"
       << stiffness << R"(, "corner": )" << corner << R"(, "one_sided": true})";
  return text.str();
}

std::string slider(double stiffness, double limit) {
  std::ostringstream text;
  text.precision(17);
  text << R"({"name": "s", "type": "jenkins", "at": "x", "stiffness": )" << stiffness
       << R"(, "friction_coefficient": 1, "normal_load": )" << limit << '}';
  return text.str();
}

/// m x'' + (c - g) x' + k x + b x^3 + f = 0 with the force f of a slider of stiffness d and limit F. The
/// negative damping g makes it periodic.
struct Damped {
  double m, k, c, b, d, F;
};

struct Half {
  double time, x;  // from x = A at rest to the next rest
};

/// By Runge-Kutta steps of fourth order. The slider sticks unless f would pass its limit. The last step is
/// shortened to where x' = 0.
Half half_motion(const Damped& of, double A, double g, double step) {
  using State = std::array<double, 3>;  // x, x', f
  const auto rate = [&](const State& y) {
    const bool slips = std::abs(y[2]) >= of.F && y[2] * y[1] > 0;
    return State{y[1], -((of.c - g) * y[1] + of.k * y[0] + of.b * y[0] * y[0] * y[0] + y[2]) / of.m,
                 slips ? 0 : of.d * y[1]};
  };
  const auto after = [](const State& y, const State& slope, double h) {
    return State{y[0] + h * slope[0], y[1] + h * slope[1], y[2] + h * slope[2]};
  };
  const auto stepped = [&](const State& y, double h) {
    const State s1 = rate(y), s2 = rate(after(y, s1, h / 2)), s3 = rate(after(y, s2, h / 2)),
                s4 = rate(after(y, s3, h));
    State next = y;
    for (std::size_t i = 0; i < 3; ++i) next[i] += h / 6 * (s1[i] + 2 * s2[i] + 2 * s3[i] + s4[i]);
    next[2] = std::clamp(next[2], -of.F, of.F);
    return next;
  };
  State y{A, 0, std::min(of.d * A, of.F)};
  double time = 0;
  constexpr int most_steps = 1'000'000;
  int steps = 0;
  for (State next = stepped(y, step); next[1] < 0 && steps < most_steps; next = stepped(y, step), ++steps) {
    y = next;
    time += step;
  }
  double within = 0, beyond = step;
  for (int i = 0; i < 60; ++i) {
    const double middle = (within + beyond) / 2;
    (stepped(y, middle)[1] < 0 ? within : beyond) = middle;
  }
  return {time + within, stepped(y, within)[0]};
}

struct FreeMotion {
  double omega, damping_ratio;
};

/// The periodic motion of amplitude A: x = -A after a half. guess: where to look for g and for the steps.
FreeMotion shot(const Damped& of, double A, const FreeMotion& guess) {
  const double step = 2 * std::numbers::pi / guess.omega / 40'000;
  const auto excess = [&](double g) { return half_motion(of, A, g, step).x + A; };
  double before = 2 * of.m * guess.omega * guess.damping_ratio;
  double now = before * (1 + 1e-3) + 1e-9 * of.m * guess.omega;
  double at_before = excess(before);
  for (int i = 0; i < 20; ++i) {
    const double at_now = excess(now);
    if (std::abs(at_now) < 1e-13 * A || at_now == at_before) break;
    const double next = now - at_now * (now - before) / (at_now - at_before);
    before = std::exchange(now, next);
    at_before = at_now;
  }
  const double omega = std::numbers::pi / half_motion(of, A, now, step).time;
  return {omega, now / (2 * of.m * omega)};
}

}  // namespace

TEST_CASE(
    "the energy integral gives the frequency of a mass between two springs, and of a Duffing oscillator") {
  // Half a period of each spring: frequencies 1 and 2.
  CHECK(std::abs(Oscillator{1, 1, 0, 3, 0}.frequency(1) * 3 / 4 - 1) < 1e-9);
  CHECK(std::abs(Oscillator{1, 1, 1, 0, 0}.frequency(1) / 1.31777606497 - 1) < 1e-9);
}

TEST_CASE(
    "conservative modes over four decades are within the accuracy that is reported, next to energy "
    "integrals") {
  const std::uint64_t count = mode_accuracy::conservative.count();
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    test_random::Random random(seed);
    Oscillator of{random.logarithmic(0.1, 10), random.logarithmic(0.1, 1e4), 0, 0, 0};
    // A cubic force as large as that of the spring at the amplitude 1, and a corner around it.
    if (!random.one_in(4)) of.b = of.k * random.logarithmic(0.1, 10);
    if (!random.one_in(3)) of.d = of.k * random.logarithmic(0.1, 10);
    of.corner = random.logarithmic(0.1, 10);
    const Json branch = modes_of(of.m, of.k, 0, cubic_spring(of.b) + ", " + stop(of.d, of.corner), 1e-2, 1e2);
    CAPTURE(seed, of.m, of.k, of.b, of.d, of.corner, branch["accuracy"].dump(), branch["stop"].dump());
    CHECK(branch["status"] == "complete");
    const Json& error = branch["accuracy"]["error"];
    REQUIRE(error.is_number());
    const double reported = error;
    for (const Json& point : branch["points"]) {
      const double amplitude = point["amplitude"], frequency = point["frequency"];
      CAPTURE(amplitude);
      const double away = std::abs(frequency / of.frequency(amplitude) - 1);
      CHECK(away < 2 * reported + 1e-8);  // at some amplitudes only is it looked at
      if (reported <= wanted) CHECK(away < wanted);
    }
  }
}

TEST_CASE("shooting has the frequency and the damping ratio of a linear oscillator") {
  const FreeMotion found = shot({2, 8, 0.4, 0, 0, 0}, 3, {2.1, 0.04});
  CHECK(std::abs(found.omega / 2 - 1) < 1e-10);
  CHECK(std::abs(found.damping_ratio / 0.05 - 1) < 1e-10);
}

TEST_CASE("damped modes over four decades are within the accuracy that is reported, compared with shooting") {
  const std::uint64_t count = mode_accuracy::damped.count();
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    test_random::Random random(seed);
    Damped of{random.logarithmic(0.1, 10), random.logarithmic(0.1, 1e4), 0, 0, 0, 0};
    of.c = 2 * std::sqrt(of.k * of.m) * random.logarithmic(1e-4, 0.05);
    if (random.one_in(2)) of.b = of.k * random.logarithmic(1e-3, 1);
    of.d = of.k * random.logarithmic(0.03, 3);
    of.F = of.d * random.logarithmic(0.03, 3);  // slips from an amplitude of about 1 on
    const Json branch = modes_of(of.m, of.k, of.c, cubic_spring(of.b) + ", " + slider(of.d, of.F), 1e-2, 1e2);
    CAPTURE(seed, of.m, of.k, of.c, of.b, of.d, of.F, branch["accuracy"].dump(), branch["stop"].dump());
    CHECK(branch["status"] == "complete");
    const Json& error = branch["accuracy"]["error"];
    REQUIRE(error.is_number());
    const double reported = error;
    double highest = 0;
    const auto& points = branch["points"];
    REQUIRE(points.size() > 20);
    for (const Json& point : points) highest = std::max(highest, point["damping_ratio"].get<double>());
    for (std::size_t i = random.below(20); i < points.size(); i += 20) {
      const FreeMotion here{points[i]["frequency"], points[i]["damping_ratio"]};
      const double amplitude = points[i]["amplitude"];
      const FreeMotion exact = shot(of, amplitude, here);
      const double away = std::max(std::abs(here.omega / exact.omega - 1),
                                   std::abs(here.damping_ratio - exact.damping_ratio) / highest);
      CAPTURE(amplitude, here.omega, exact.omega, here.damping_ratio, exact.damping_ratio);
      CHECK(away < 2 * reported + 1e-6);
      if (reported <= wanted) CHECK(away < wanted);
    }
  }
}
