// The accuracy that modes are told to have, beside the energy integral of conservative oscillators.
#include "catch.hpp"
#include "random.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/studies/mode_accuracy.hpp"

#include <arcslip/results/json_writer.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

using namespace arcslip;
using Json = nlohmann::json;

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

constexpr double wanted = 1e-4;

Json modes_of(const Oscillator& of, double from, double to) {
  std::ostringstream text;
  text.precision(17);
  text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"dofs": ["x"],
    "masses": [{"name": "m", "at": "x", "value": )"
       << of.m << R"(}], "springs": [{"name": "k", "at": "x", "value": )" << of.k << R"(}]},
    "elements": [{"name": "b", "type": "cubic_spring", "at": "x", "stiffness": )"
       << of.b
       << R"(}, {"name": "d", "type": "bilinear_spring", "at": "x", "stiffness": 0, "stiffness_beyond": )"
       << of.d << R"(, "corner": )" << of.corner << R"(, "one_sided": true}],
    "excitation": [{"name": "f", "at": "x", "cosine": 1}], "response": {"at": "x"}, "harmonics": {"accuracy": )"
       << wanted << R"(},
    "studies": [{"kind": "modes", "mode": 1, "amplitude": [)"
       << from << ", " << to << "]}]}";
  std::ostringstream json;
  results::write_json(json, studies::run(scenes::parse(text.str())));
  return Json::parse(json.str())["branches"][0];
}

}  // namespace

TEST_CASE(
    "the energy integral gives the frequency of a mass between two springs, and of a Duffing oscillator") {
  // Half a period of each spring: frequencies 1 and 2.
  CHECK(std::abs(Oscillator{1, 1, 0, 3, 0}.frequency(1) * 3 / 4 - 1) < 1e-9);
  CHECK(std::abs(Oscillator{1, 1, 1, 0, 0}.frequency(1) / 1.31777606497 - 1) < 1e-9);
}

TEST_CASE(
    "conservative modes over four decades are within the accuracy that is told, beside energy integrals") {
  const std::uint64_t count = mode_accuracy::conservative.count();
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    test_random::Random random(seed);
    Oscillator of{random.logarithmic(0.1, 10), random.logarithmic(0.1, 1e4), 0, 0, 0};
    // A cubic force as large as that of the spring at the amplitude 1, and a corner around it.
    if (!random.one_in(4)) of.b = of.k * random.logarithmic(0.1, 10);
    if (!random.one_in(3)) of.d = of.k * random.logarithmic(0.1, 10);
    of.corner = random.logarithmic(0.1, 10);
    const Json branch = modes_of(of, 1e-2, 1e2);
    CAPTURE(seed, of.m, of.k, of.b, of.d, of.corner, branch["accuracy"].dump(), branch["stop"].dump());
    CHECK(branch["status"] == "complete");
    const Json& error = branch["accuracy"]["error"];
    if (error.is_null()) continue;
    const double told = error;
    for (const Json& point : branch["points"]) {
      const double amplitude = point["amplitude"], frequency = point["frequency"];
      CAPTURE(amplitude);
      const double away = std::abs(frequency / of.frequency(amplitude) - 1);
      CHECK(away < 2 * told + 1e-8);  // at some amplitudes only is it looked at
      if (told <= wanted) CHECK(away < wanted);
    }
  }
}
