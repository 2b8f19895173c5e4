// Long sweeps. Reduced by default; ARCSLIP_FULL=1 runs them in full.

#include "catch.hpp"

#include "lib/analyses/responses/extremes_check.hpp"
#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"

#include <cstdlib>

using namespace arcslip;

namespace {

bool full() {
  return std::getenv("ARCSLIP_FULL") != nullptr;
}

}  // namespace

TEST_CASE("resonance peaks are exact to 5e-9 with 101 harmonics, at every load") {
  for (const auto& exact : reference::exact("resonance_peaks")) {
    const double load = exact["normal_load"];
    if (!full() && load != 2 && load != 3 && load != 100) continue;
    const scene::Scene s = scenes::paper(101, load);
    const auto branches = observables::frequency_response(s, scenes::window(s));
    REQUIRE(branches[0].events.size() == 1);
    const auto& peak = branches[0].events[0].point;
    CAPTURE(load);
    CHECK(reference::error(peak.amplitude, exact["amplitude"]) < 5e-9);
    CHECK(reference::error(peak.omega / scenes::hertz, exact["frequency_hz"]) < 2e-8);
    CHECK(std::abs(peak.elements[0].stick_percent - exact["stick_percent"].get<double>()) < 1e-4);
  }
}

TEST_CASE("responses at fixed frequency are exact to 5e-9 with 101 harmonics") {
  for (const auto& exact : reference::exact("fixed_frequency")) {
    const auto point = scenes::response_at(scenes::paper(101, exact["normal_load"]), exact["frequency_hz"]);
    CHECK(reference::error(point.amplitude, exact["amplitude"]) < 5e-9);
    CHECK(std::abs(point.elements[0].stick_percent - exact["stick_percent"].get<double>()) < 1e-4);
  }
}

TEST_CASE("every extreme that takes long ends as it should") {
  for (const auto& extreme : extremes::all())
    if (extreme.takes_long) check(extreme);
}

TEST_CASE("low frequencies with many slip phases: 0.1 Hz to 1 Hz at 0.1 N, order past the resonance") {
  scene::Scene s = scenes::paper(full() ? 251 : 101, 0.1);
  scenes::window(s).from = full() ? 0.1 : 0.25;
  scenes::window(s).to = full() ? 1 : 0.4;
  const auto branches = observables::frequency_response(s, scenes::window(s));
  CHECK(branches[0].status == observables::Status::complete);
  std::size_t most = 0;
  for (const auto& point : branches[0].points) {
    CHECK(std::isfinite(point.amplitude));
    most = std::max(most, point.elements[0].slip_angles.size());
  }
  CHECK(most >= 6);
}
