// The highest value at an end of the window: where the peak is, in closed form.

#include "catch.hpp"
#include "contains.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/optimize/evaluation/reasons.hpp>
#include <arcslip/optimize/search/optimum.hpp>

#include <algorithm>
#include <cmath>
#include <string>

using namespace arcslip;
using observables::Status;
using optimize::Optimum;

namespace {

constexpr double natural = 10 * scenes::hertz;

/// 1 kg at 10 Hz; over the damper, whose largest value is best everywhere.
scene::Scene oscillator() {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "Hz", "structure": {"dofs": ["x"],
    "masses": [{"name": "m", "at": "x", "value": 1}], "springs": [{"name": "k", "at": "x", "frequency": 10}],
    "dampers": [{"name": "c", "at": "x", "value": 2}]},
    "excitation": [{"name": "f", "at": "x", "cosine": 1}], "response": {"at": "x"}, "harmonics": {"order": 1}})");
}

Optimum over_damper(double least, double most, double from, double to) {
  return optimize::optimum(oscillator(), {{{"c.value", least, most}}, from, to});
}

double amplitude(double c, double hz) {
  const double w = hz * scenes::hertz;
  return 1 / std::hypot(natural * natural - w * w, c * w);
}

}  // namespace

TEST_CASE("a window that misses the resonance is no complete answer, and the window to take is reported") {
  for (const bool upper : {true, false}) {
    CAPTURE(upper);
    const Optimum found = upper ? over_damper(1, 5, 5, 8) : over_damper(1, 5, 12, 15);
    CAPTURE(found.stop.message);
    CHECK(found.status == Status::stopped);
    CHECK(found.stop.reason == optimize::reasons::end_of_window);
    REQUIRE(found.design.size() == 1);
    CHECK(std::abs(found.design[0] - 5) < 1e-12);
    CHECK(std::abs(found.amplitude / amplitude(5, upper ? 8 : 12) - 1) < 1e-9);
    const char* at = upper ? "largest at the upper end of the window, 8 Hz"
                           : "largest at the lower end of the window, 12 Hz";
    CHECK(contains(found.stop.message, at));
    // The peak of c = 5 N s/m: 1/(c sqrt(w^2 - c^2/4)) at sqrt(w^2 - c^2/2).
    CHECK(contains(found.stop.message, "over the bounds natural frequencies lie at 10 Hz; from "));
    CHECK(contains(
        found.stop.message,
        upper ? "from 5 to 11 Hz this design has a peak of 0.0031856 m at 9.9842 Hz: take that window"
              : "from 9.09 to 15 Hz this design has a peak of 0.0031856 m at 9.9842 Hz: take that window"));
  }
  const Optimum inside = over_damper(1, 5, 5, 11);
  CHECK(inside.status == Status::complete);
  CHECK(std::abs(inside.amplitude - 1 / (5 * std::sqrt(natural * natural - 25.0 / 4))) <
        1e-9 * inside.amplitude);
}

// The slider holds the mass: 1 kg on 2 k, or sqrt(2) 10 Hz.
TEST_CASE("loads without influence on the highest value are no complete answer in a window that misses") {
  scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "Hz",
    "structure": {"dofs": ["x"],
      "masses": [{"name": "m", "at": "x", "value": 1}], "springs": [{"name": "k", "at": "x", "frequency": 10}],
      "dampers": [{"name": "c", "at": "x", "value": 2}]},
    "elements": [{"name": "s", "type": "jenkins", "at": "x", "stiffness": 3947.8417604357433,
      "friction_coefficient": 1, "normal_load": 30}],
    "excitation": [{"name": "f", "at": "x", "cosine": 1}], "response": {"at": "x"}, "harmonics": {"order": 1}})");
  const Optimum found = optimize::optimum(s, {{{"s.normal_load", 20, 50}}, 5, 9});
  CAPTURE(found.stop.message);
  CHECK(found.status == Status::stopped);
  CHECK(found.stop.reason == optimize::reasons::end_of_window);
  const double w = 9 * scenes::hertz;
  CHECK(std::abs(found.amplitude * std::hypot(2 * natural * natural - w * w, 2 * w) - 1) < 1e-9);
  CHECK(contains(found.stop.message, "largest at the upper end of the window, 9 Hz"));
  CHECK(contains(found.stop.message, "this design has a peak of "));
  CHECK(contains(found.stop.message, " at 14.1"));
  REQUIRE(!found.notes.empty());
  CHECK(contains(found.notes.back(), "the amplitude does not depend on s.normal_load within the bounds"));
}

TEST_CASE(
    "where the amplitude is largest at an end of the window and there is no resonance beyond, that is said") {
  // Above 1/sqrt(2) of critical damping there is no peak: the amplitude falls from rest on.
  const double critical = 2 * natural;
  for (const auto& [from, to] : {std::pair(2.0, 20.0), std::pair(12.0, 20.0)}) {
    CAPTURE(from);
    const Optimum found = over_damper(0.8 * critical, 1.2 * critical, from, to);
    CAPTURE(found.stop.message);
    CHECK(found.status == Status::complete);
    CHECK(std::abs(found.amplitude / amplitude(1.2 * critical, from) - 1) < 1e-9);
    REQUIRE(!found.notes.empty());
    CHECK(contains(found.notes.back(), "the amplitude is largest at the lower end of the window"));
    CHECK(contains(found.notes.back(), "this design has no resonance beyond: the amplitude rises on, to "));
  }
}

// x is a Duffing oscillator of which 1.6 rad/s lies in the hysteresis: 0.337518 and 1.591910 m by integration
// in time, and the upper branch has its peak of about 2.3178 m at 2.2119 rad/s. y has its resonance at 3
// rad/s.
TEST_CASE("a window that begins within a hysteresis: a higher branch than the one of the peaks is reported") {
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x", "y"],
      "masses": [{"name": "mx", "at": "x", "value": 1}, {"name": "my", "at": "y", "value": 1}],
      "springs": [{"name": "kx", "at": "x", "value": 1}, {"name": "ky", "at": "y", "value": 9}],
      "dampers": [{"name": "cx", "at": "x", "value": 0.1}, {"name": "cy", "at": "y", "value": 0.08}]},
    "elements": [{"name": "n", "type": "cubic_spring", "at": "x", "stiffness": 1}],
    "excitation": [{"name": "fx", "at": "x", "cosine": 0.5}, {"name": "fy", "at": "y", "cosine": 0.3}],
    "response": {"direction": {"x": 1, "y": 1}}, "harmonics": {"order": 9}})");
  const Optimum found = optimize::optimum(s, {{{"cy.value", 0.05, 0.1}}, 1.6, 4});
  CAPTURE(found.stop.message);
  CHECK(found.status == Status::complete);
  REQUIRE(found.certificate);
  CHECK(!found.certificate->others_lower);
  REQUIRE(!found.certificate->others.empty());
  CHECK(std::count_if(found.certificate->others.begin(), found.certificate->others.end(),
                      [](const auto& each) { return each.found_by == "search at the ends"; }) == 1);
  const auto& other = found.certificate->others[0];
  CHECK(other.found_by == "search at the ends");
  CHECK(std::abs(other.amplitude - 2.3178) < 0.3 / (9 - other.omega * other.omega));  // y there
  CHECK(std::abs(other.omega / 2.2119 - 1) < 1e-2);
}

TEST_CASE("a case in which nothing moves is not said to lie at an end of the window") {
  optimize::OptimumProblem problem{{{"c.value", 1, 5}}, 5, 15};
  problem.cases = {{{{"f.cosine", 0}}, 1}, {{{"f.cosine", 1}}, 1}};
  problem.criterion = optimize::Criterion::mean;
  CHECK(optimize::optimum(oscillator(), problem).status == Status::complete);
}
