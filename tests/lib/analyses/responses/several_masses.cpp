#include "catch.hpp"
#include "controls.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/results/reasons.hpp>

#include <complex>
#include <numbers>
#include <string>

using namespace arcslip;

TEST_CASE("an observed mass that no element touches has the peaks of its own motion") {
  const scene::Scene s = scenes::chain(7, false);
  const auto branches = observables::frequency_response(s, scenes::window(s));
  REQUIRE(branches.size() == 1);
  const auto& branch = branches[0];
  CHECK(branch.status == observables::Status::complete);
  CHECK(branch.solver.unknowns == 2 * 8);
  int peaks = 0;
  for (const auto& event : branch.events) {
    if (event.kind != "peak") continue;
    ++peaks;
    // The amplitude at neighbouring frequencies is less.
    for (double shift : {-1e-4, 1e-4})
      CHECK(scenes::response_at(s, event.point.omega * (1 + shift)).amplitude < event.point.amplitude);
  }
  CHECK(peaks >= 2);
  for (const auto& point : branch.points) CHECK(std::isfinite(point.amplitude));
}

namespace {

// A mass on a spring and 24 friction dampers, whose slip begins at 24 amplitudes.
scene::Scene many_dampers() {
  scene::Scene s = scenes::paper(100, 3);
  const scene::Part damper = s.elements.front();
  s.elements.clear();
  for (int k = 0; k < 24; ++k) {
    scene::Part each = damper;
    each.name = "d" + std::to_string(k);
    each.values[0] /= 24;
    each.values[2] *= (0.3 + 0.06 * k) / 24;
    s.elements.push_back(each);
  }
  return s;
}

}  // namespace

TEST_CASE("with many dampers kinks are passed, with the same peak and a curve within 1e-3") {
  scene::Scene s = many_dampers();
  const auto traced = [&](scene::Kinks kinks) {
    s.harmonics.kinks = kinks;
    return observables::frequency_response(s, scenes::window(s)).front();
  };
  const auto automatic = traced(scene::Kinks::automatic), passed = traced(scene::Kinks::passed),
             located = traced(scene::Kinks::located);
  CHECK(automatic.solver.residuals == passed.solver.residuals);
  CHECK(2 * passed.solver.residuals < located.solver.residuals);
  REQUIRE(passed.events.size() == located.events.size());
  for (std::size_t k = 0; k < passed.events.size(); ++k) {
    CHECK(passed.events[k].kind == located.events[k].kind);
    CHECK(reference::error(passed.events[k].point.omega, located.events[k].point.omega) < 1e-10);
    CHECK(reference::error(passed.events[k].point.amplitude, located.events[k].point.amplitude) < 1e-10);
  }
  for (std::size_t k = 0; k < passed.points.size(); k += 12) {
    const double frequency = passed.points[k].omega / (2 * std::numbers::pi);
    CHECK(reference::error(passed.points[k].amplitude, scenes::response_at(s, frequency).amplitude) < 1e-8);
  }
  s.elements.resize(20);
  const auto few = traced(scene::Kinks::automatic);
  CHECK(few.solver.residuals == traced(scene::Kinks::located).solver.residuals);
}

TEST_CASE("forces of an even harmonic bring in the mean and all harmonics") {
  const scene::Scene s = scenes::chain(6, true);
  const auto branches = observables::frequency_response(s, scenes::window(s));
  CHECK(branches[0].harmonics == std::vector<int>{0, 1, 2, 3, 4, 5, 6});
  CHECK(branches[0].status == observables::Status::complete);
  CHECK(branches[0].solver.unknowns == 2 * 13);
}

TEST_CASE("the paper's oscillator excited in its second harmonic at half the frequency responds as before") {
  scene::Scene s = scenes::paper(110, 3);
  s.excitation.front().harmonic = 2;
  const auto point = scenes::response_at(s, 10);
  CHECK(reference::error(point.amplitude, 0.000884939195111) < 5e-8);
  CHECK(std::abs(point.elements[0].stick_percent - 48.7055401) < 1e-4);
  CHECK(point.elements[0].slip_angles.size() == 4);
}

TEST_CASE("a structure without elements answers linearly, through all of its resonances") {
  scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b"], "masses": [{"name": "ma", "at": "a", "value": 1},
      {"name": "mb", "at": "b", "value": 1}],
      "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kb", "between": ["a", "b"], "value": 1}],
      "dampers": [{"name": "c", "at": "a", "value": 0.01}]},
    "excitation": [{"name": "f", "at": "a", "cosine": 1}], "harmonics": {"order": 1}, "response": {"at": "b"},
    "studies": [{"kind": "frf", "from": 0.2, "to": 2.5}]})");
  const auto branch = observables::frequency_response(s, scenes::window(s)).front();
  CHECK(branch.status == observables::Status::complete);
  CHECK(branch.events.size() == 2);
  for (const auto& point : branch.points) {
    const std::complex<double> i(0, 1);
    const double w = point.omega;
    const std::complex<double> a = 2 - w * w + 0.01 * i * w, b = 1 - w * w;
    CHECK(reference::error(point.amplitude, std::abs(1.0 / (a * b - 1.0))) < 1e-11);
  }
}

TEST_CASE("two combinations of two lists are four branches, the last list fastest") {
  const scene::Scene s = scenes::paper(1);
  const auto branches =
      scenes::frequency_responses(s, {{"c.value", {0.1, 0.2}}, {"damper.normal_load", {2, 3}}});
  REQUIRE(branches.size() == 4);
  CHECK(branches[1].set[0] == std::pair<std::string, double>{"c.value", 0.1});
  CHECK(branches[1].set[1] == std::pair<std::string, double>{"damper.normal_load", 3});
  CHECK(branches[2].set[0].second == 0.2);
}

TEST_CASE("the progress callback sees every point and stops the study") {
  const scene::Scene s = scenes::paper(1);
  double last = 0;
  const auto branches = scenes::frequency_responses(
      s, {{"damper.normal_load", {1, 2, 3}}}, controls::reporting([&](const control::Progress& progress) {
        if (progress.branch == 0) {
          CHECK(progress.share_done >= last);
          last = progress.share_done;
        }
        return progress.branch == 0 || progress.points < 10;
      }));
  REQUIRE(branches.size() == 2);
  CHECK(last == 1);
  CHECK(branches[1].status == observables::Status::stopped);
  CHECK(branches[1].stop.reason == observables::reasons::user);
  CHECK(branches[1].points.size() == 10);
}
