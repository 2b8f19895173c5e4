// The paper's oscillator against its closed-form solution, piece by piece (tests/reference/exact_1dof.json).

#include "catch.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"

#include <numbers>

using namespace arcslip;
using std::numbers::pi;

TEST_CASE("resonance peaks at every load from 0.01 N to 500 N are exact to 5e-8 with 55 harmonics") {
  const auto peaks = reference::exact("resonance_peaks");
  REQUIRE(peaks.size() == 10);
  for (const auto& exact : peaks) {
    const double load = exact["normal_load"];
    const scene::Scene s = scenes::paper(55, load);
    const auto branches = observables::frequency_response(s, scenes::window(s));
    CAPTURE(load);
    REQUIRE(branches.size() == 1);
    CHECK(branches[0].status == observables::Status::complete);
    CHECK(branches[0].points.size() >= 150);
    REQUIRE(branches[0].events.size() == 1);
    const auto& peak = branches[0].events[0];
    CHECK(peak.kind == "peak");
    CHECK_FALSE(peak.nonsmooth);
    CHECK(reference::error(peak.point.amplitude, exact["amplitude"]) < 5e-8);
    CHECK(reference::error(peak.point.omega / scenes::hertz, exact["frequency_hz"]) < 2e-8);
    CHECK(std::abs(peak.point.elements[0].stick_percent - exact["stick_percent"].get<double>()) < 1e-4);
    CHECK(std::abs(peak.point.energy_friction - exact["energy_friction"].get<double>()) <
          1e-7 * exact["energy_friction"].get<double>() + 1e-15);
  }
}

TEST_CASE("responses at fixed frequency are exact to 5e-8 with 55 harmonics") {
  const auto points = reference::exact("fixed_frequency");
  REQUIRE(points.size() == 15);
  for (const auto& exact : points) {
    const auto point = scenes::response_at(scenes::paper(55, exact["normal_load"]), exact["frequency_hz"]);
    CAPTURE(exact["normal_load"].get<double>(), exact["frequency_hz"].get<double>());
    CHECK(reference::error(point.amplitude, exact["amplitude"]) < 5e-8);
    CHECK(std::abs(point.elements[0].stick_percent - exact["stick_percent"].get<double>()) < 1e-4);
    CHECK(std::abs(point.energy_friction - exact["energy_friction"].get<double>()) <
          1e-7 * exact["energy_friction"].get<double>() + 1e-15);
  }
}

TEST_CASE(
    "one harmonic, no damping: the peak at Fn = pi N is p/(1 - pi f0/(4 p))/kd, in half stick and half "
    "slip") {
  scene::Scene s = scenes::paper(1, pi);
  scene::set(s, "c.value", 0);
  const auto branches = observables::frequency_response(s, scenes::window(s));
  REQUIRE(branches.size() == 1);
  REQUIRE(branches[0].events.size() == 1);
  const auto& peak = branches[0].events[0].point;
  CHECK(std::abs(peak.amplitude / (pi / 3500) - 1) < 1e-10);
  CHECK(std::abs(peak.elements[0].stick_percent - 50) < 1e-8);
  CHECK(std::abs(peak.phase - pi / 2) < 1e-9);
}

TEST_CASE("what the forces put in, friction and dampers take out") {
  for (double hz : {18.5, 19.4, 20.0, 21.5}) {
    const auto point = scenes::response_at(scenes::paper(15, 2), hz);
    // Work of f0 cos: pi f0 b_1.
    const double input = pi * point.coefficients[1];
    CHECK(std::abs(point.energy_friction + point.energy_viscous - input) < 1e-12 * input);
  }
}

TEST_CASE("slip begins and ends where the exact response says: theta* - theta_0 is the share of stick") {
  const auto point = scenes::response_at(scenes::paper(55, 3), 20);
  const auto& damper = point.elements[0];
  REQUIRE(damper.slip_angles.size() == 2);
  REQUIRE(damper.reversal_angles.size() == 2);
  CHECK(std::abs(damper.slip_angles[1] - damper.slip_angles[0] - pi) < 1e-12);
  double stick = damper.slip_angles[0] - damper.reversal_angles[0];
  while (stick < 0) stick += pi;
  CHECK(std::abs(100 * stick / pi - 48.7055401) < 1e-4);
}

TEST_CASE("at low frequency the order needed is that of the resonance, and too low an order is flagged") {
  // 0.2 Hz, 0.1 N: order 55 converges with 2 slip phases and tau = 37.2; order 401 has 10 and tau = 41.4.
  const auto low = scenes::response_at(scenes::paper(55, 0.1), 0.2);
  CHECK(low.truncation_flagged);
  CHECK(low.elements[0].slip_angles.size() == 2);
  CHECK(std::abs(low.elements[0].stick_percent - 37.2) < 0.05);
  const auto high = scenes::response_at(scenes::paper(401, 0.1), 0.2);
  CHECK_FALSE(high.truncation_flagged);
  CHECK(high.elements[0].slip_angles.size() == 10);
  CHECK(std::abs(high.elements[0].stick_percent - 41.4) < 0.05);
}
