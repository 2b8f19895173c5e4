// Stability of smooth oscillators next to AUTO-07p (0.9.2): collocation in 200 intervals of 4 points, with
// the force by two further equations, x = a: a' = a + w b - a (a^2 + b^2), b' = -w a + b - b (a^2 + b^2).
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

using namespace arcslip;

namespace {

using Complex = std::complex<double>;

// x'' + c x' + k x + square x^2 + x^3 = f cos w t
scene::Scene oscillator(double c, double k, double square, double f, int order) {
  scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 1}]},
    "elements": [{"name": "s", "type": "polynomial_spring", "at": "x", "coefficients": {"2": )" +
                                 std::to_string(square) + R"(, "3": 1.0}}],
    "excitation": [{"name": "f", "at": "x", "cosine": 1}], "response": {"at": "x"}})");
  scene::set(s, "c.value", c);
  scene::set(s, "k.value", k);
  scene::set(s, "f.cosine", f);
  s.harmonics.order = order;
  return s;
}

struct Orbit {
  double omega;
  int unstable;
  Complex first, second;  // to six digits
};

void check(const scene::Scene& s, const std::vector<Orbit>& orbits) {
  for (const Orbit& orbit : orbits) {
    observables::PointSettings settings;
    settings.frequency = orbit.omega;
    settings.stability = true;
    bool found = false;
    for (const auto& response : observables::point_responses(s, settings)) {
      REQUIRE(response.point.stability);
      const auto& stability = *response.point.stability;
      REQUIRE(stability.multipliers.size() == 2);
      const auto near = [&](Complex a, Complex b) {
        return std::abs(stability.multipliers[0] - a) < 6e-6 && std::abs(stability.multipliers[1] - b) < 6e-6;
      };
      if (!near(orbit.first, orbit.second) && !near(orbit.second, orbit.first)) continue;
      found = true;
      CHECK(stability.unstable == orbit.unstable);
      CHECK(stability.error < 1e-6);
    }
    CAPTURE(orbit.omega, orbit.first);
    CHECK(found);
  }
}

}  // namespace

TEST_CASE("a Duffing oscillator has AUTO's multipliers on all three parts of its response, and its folds") {
  const scene::Scene s = oscillator(0.1, 1, 0, 0.5, 25);
  check(s, {{0.8, 0, {-0.543972, 0.400041}, {-0.543972, -0.400041}},
            {1.2, 0, {-0.181322, 0.748002}, {-0.181322, -0.748002}},
            {1.6, 0, {0.384022, 0.726470}, {0.384022, -0.726470}},
            {2.0, 0, {0.690203, 0.504007}, {0.690203, -0.504007}},
            {2.0, 1, 1.64207, 0.444805},
            {1.6, 1, 2.19622, 0.307452},
            {1.6, 0, {-0.367512, 0.734960}, {-0.367512, -0.734960}},
            {2.0, 0, {-0.853012, 0.0526677}, {-0.853012, -0.0526677}}});
  const auto branch = observables::frequency_response(s, {0.6, 2.5, true}).front();
  std::vector<double> folds;
  for (const auto& event : branch.events) {
    CHECK((event.kind == "fold" || event.kind == "peak"));
    if (event.kind == "fold") folds.push_back(event.point.omega);
  }
  REQUIRE(folds.size() == 2);
  CHECK(std::abs(folds[0] - 2.2119353170) < 2e-9);
  CHECK(std::abs(folds[1] - 1.4386701455) < 2e-9);
}

TEST_CASE("an oscillator in a double well has AUTO's multipliers next to its period doubling") {
  const scene::Scene s = oscillator(0.3, 2, 3, 0.265581786056, 25);
  check(s, {{1.25, 0, {-0.430182, 0.190534}, {-0.430182, -0.190534}},
            {1.18, 1, -1.20614, -0.167823},
            {1.15, 1, -1.53192, -0.126740},
            {1.12, 1, -1.89622, -0.0979933}});
}
