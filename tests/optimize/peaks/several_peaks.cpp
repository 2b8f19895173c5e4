// Structures with several peaks and several dampers.

#include "catch.hpp"

#include "optimize/row.hpp"

#include <arcslip/optimize/evaluation/reasons.hpp>
#include <arcslip/optimize/search/optimum.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

using namespace arcslip;
using optimize::Optimum;

TEST_CASE("two dampers on two masses: two peaks are equally high, and their gradients cancel") {
  const scene::Scene s = row(2, 2, 7);
  const Optimum found = optimize::optimum(s, over_loads(2, 8, 45));
  CAPTURE(found.stop.message);
  CHECK(found.status == observables::Status::complete);
  CHECK(found.epigraph);
  REQUIRE(found.certificate);
  const auto& peaks = found.certificate->peaks;
  REQUIRE(peaks.size() == 2);
  CHECK(std::abs(peaks[0].amplitude / peaks[1].amplitude - 1) < 1e-9);
  CHECK(peaks[0].weight > 0);
  CHECK(peaks[0].weight + peaks[1].weight == Approx(1));
  CHECK(found.certificate->stationarity < 1e-6);
  CHECK(found.certificate->others_lower);

  // In every direction the highest peak of a new frequency response grows.
  CHECK(highest_peak(s, found.design, 8, 45) == Approx(found.amplitude).epsilon(1e-9));
  for (int k = 0; k < 8; ++k) {
    const double angle = k * std::numbers::pi / 4;
    const std::vector<double> nearby = {found.design[0] * (1 + 1e-2 * std::cos(angle)),
                                        found.design[1] * (1 + 1e-2 * std::sin(angle))};
    CHECK(highest_peak(s, nearby, 8, 45) > found.amplitude);
  }
}

TEST_CASE("two dampers: without gradients the same optimum comes out, and with a tie a higher one") {
  const scene::Scene s = row(2, 2, 5);
  const auto problem = over_loads(2, 8, 45);
  const double best = optimize::optimum(s, problem, {.certificate = false}).amplitude;
  const Optimum by_models =
      optimize::optimum(s, problem, {.algorithm = "LN_BOBYQA", .evaluations = 300, .certificate = false});
  CHECK_FALSE(by_models.epigraph);
  CHECK(by_models.amplitude >= best * (1 - 1e-9));
  CHECK(by_models.amplitude == Approx(best).epsilon(1e-4));

  scene::Scene tied = s;
  scenes::tie(tied, "load", {"d0.normal_load", "d1.normal_load"});
  const Optimum one = optimize::optimum(tied, {{{"load", 0.05, 50}}, 8, 45}, {.certificate = false});
  CHECK(one.status == observables::Status::complete);
  CHECK(one.amplitude > best);
}

TEST_CASE("a damper that sticks where the search begins slips where it ends") {
  scene::Scene s = row(2, 2, 5);
  auto problem = over_loads(2, 8, 45);
  const Optimum slipping = optimize::optimum(s, problem, {.certificate = false});
  for (const char* const parameter : {"d1.normal_load", "d1.friction_coefficient"}) {
    problem.over[1].name = parameter;
    s = row(2, 2, 5);
    scene::set(s, parameter, 40);
    // Steps of LD_MMA below 1e-7 follow the rounding of the peaks, and may never end.
    for (const auto& [algorithm, step] : {std::pair{"LD_SLSQP", 1e-9}, std::pair{"LD_MMA", 1e-7}}) {
      const Optimum found = optimize::optimum(
          s, problem, {.algorithm = algorithm, .tolerances = {.x_absolute = step}, .certificate = false});
      CAPTURE(parameter, algorithm, found.stop.message);
      CHECK(found.status == observables::Status::complete);
      CHECK(found.amplitude == Approx(slipping.amplitude).epsilon(1e-7));
      CHECK(std::any_of(found.notes.begin(), found.notes.end(), [](const std::string& note) {
        return note.find("a friction element sticks") != std::string::npos;
      }));
    }
  }
}

TEST_CASE("three dampers on five masses: a global search without gradients finds nothing below",
          "[numbers]") {
  const scene::Scene s = row(5, 3, 3);
  const auto problem = over_loads(3, 2, 20);
  const Optimum found = optimize::optimum(s, problem, {.certificate = false});
  const Optimum global =
      optimize::optimum(s, problem, {.algorithm = "GN_DIRECT_L", .evaluations = 800, .certificate = false});
  CHECK(global.evaluations.size() == 800);
  CHECK(std::none_of(global.notes.begin(), global.notes.end(),
                     [](const std::string& note) { return note.find("a new peak") != std::string::npos; }));
  CHECK(global.amplitude == Approx(found.amplitude).epsilon(1e-10));
  CHECK(highest_peak(s, global.design, 2, 20) == Approx(global.amplitude).epsilon(1e-9));
}

TEST_CASE("a damper that sticks whatever its load within the bounds stays as it is") {
  scene::Scene s = row(2, 2, 5);
  scene::set(s, "d1.normal_load", 40);
  auto problem = over_loads(2, 8, 45);
  problem.over[1].lower = 30;
  const Optimum both = optimize::optimum(s, problem, {.certificate = false});
  problem.over.pop_back();
  const Optimum first = optimize::optimum(s, problem, {.certificate = false});
  CHECK(both.status == observables::Status::complete);
  CHECK(both.amplitude == Approx(first.amplitude).epsilon(1e-9));
}

TEST_CASE("a linear limit on the loads holds, and is active where the optimum without it lies beyond") {
  const scene::Scene s = row(2, 2, 5);
  auto problem = over_loads(2, 8, 45);
  const Optimum without = optimize::optimum(s, problem, {.certificate = false});
  problem.linear_limits = {{.weights = {{"d0.normal_load", 1}, {"d1.normal_load", 1}}, .at_most = 2}};
  REQUIRE(without.design[0] + without.design[1] > 2);
  const Optimum found = optimize::optimum(s, problem, {.certificate = false});
  CHECK(found.status == observables::Status::complete);
  CHECK(found.feasible);
  CHECK(found.design[0] + found.design[1] == Approx(2).epsilon(1e-6));
  CHECK(found.amplitude > without.amplitude);
}

TEST_CASE("at an end of the window two extremes of the motion are equally high at the optimum") {
  // x = X1 cos(t - phi1) + b X2 cos(2 t - phi2): with b changes its sign what the higher harmonic adds to one
  // extreme and takes from the other, so that none of it is best.
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "Hz",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "between": ["x", "ground"], "value": 1000}],
      "dampers": [{"name": "c", "between": ["x", "ground"], "value": 2}]},
    "elements": [],
    "excitation": [{"name": "first", "at": "x", "cosine": 1},
                   {"name": "second", "at": "x", "harmonic": 2, "cosine": 0.7}],
    "harmonics": {"order": 4}, "response": {"at": "x"},
    "studies": [{"kind": "frf", "from": 7, "to": 12}]})");
  const Optimum found = optimize::optimum(s, {{{"second.cosine", -1, 2}}, 7, 12});
  CAPTURE(found.stop.message);
  REQUIRE(found.stop.reason == optimize::reasons::end_of_window);
  CHECK(found.epigraph);
  const double omega = 7 * 2 * std::numbers::pi;
  CHECK(found.amplitude == Approx(1 / std::hypot(1000 - omega * omega, 2 * omega)).epsilon(1e-7));
  CHECK(std::abs(found.design[0]) < 1e-6);
  REQUIRE(found.certificate);
  REQUIRE(found.certificate->peaks.size() == 2);
  for (const auto& peak : found.certificate->peaks) {
    CHECK(peak.kind == optimize::PeakKind::lower_end);
    CHECK(peak.weight == Approx(0.5).epsilon(1e-6));
  }
}
