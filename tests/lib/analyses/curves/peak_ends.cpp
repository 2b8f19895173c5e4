// Where curves of peaks end, and what they pass: kinks of every kind at which a peak may sit.

#include "catch.hpp"
#include "size.hpp"

#include "lib/analyses/curves/curves.hpp"
#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>

#include <algorithm>
#include <cmath>

using namespace arcslip;
using observables::CurveRange;
using observables::FrequencyRange;
using observables::ResponseBranch;
using observables::ResponsePoint;
using observables_test::curves_with;

namespace {

// Four masses excited in the second and the third harmonic, so that the motion has a mean and no symmetry.
scene::Scene second_and_third() {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["d0", "d1", "d2", "d3"],
      "masses": [{"name": "m0", "at": "d0", "value": 4.398381241796437}, {"name": "m1", "at": "d1", "value": 8.158338264802918},
        {"name": "m2", "at": "d2", "value": 3.222924412015063}, {"name": "m3", "at": "d3", "value": 7.339795628496074}],
      "springs": [{"name": "k0", "at": "d0", "value": 0.9681139932995609},
        {"name": "k1", "between": ["d1", "d0"], "value": 0.9770899453784013},
        {"name": "k2", "between": ["d2", "d1"], "value": 1.3880884432525709},
        {"name": "k3", "between": ["d3", "d2"], "value": 0.8978587256859946}, {"name": "kg", "at": "d3", "value": 0.14609716898715444}],
      "dampers": [{"name": "c0", "at": "d0", "value": 0.5190054366796054},
        {"name": "c1", "between": ["d1", "d0"], "value": 0.4333344599931181},
        {"name": "c2", "between": ["d2", "d1"], "value": 0.8166628593365703},
        {"name": "c3", "between": ["d3", "d2"], "value": 0.24081825976045396}]},
    "elements": [{"name": "j0", "type": "jenkins", "at": "d0", "stiffness": 4.446784280131201,
      "friction_coefficient": 0.6, "normal_load": 93.07842435698176}],
    "excitation": [{"name": "f0", "between": ["d2", "d3"], "harmonic": 2, "cosine": -27.802400248111287, "sine": -8.562657697245623},
      {"name": "f1", "at": "d3", "harmonic": 3, "cosine": -1.4173039405520413, "sine": -1.9329045925466541}],
    "harmonics": {"order": 7}, "response": {"at": "d2"},
    "studies": [{"name": "frf", "kind": "frf", "from": 0.07893333620391295, "to": 0.6894580823190402}]})");
}

CurveRange peaks_over(const scene::Scene& s, const std::string& over, double from, double to) {
  const FrequencyRange& window = scenes::window(s);
  return {over, from, to, window.from, window.to};
}

std::vector<ResponsePoint> peaks_of(scene::Scene s, const std::string& over, double value,
                                    const FrequencyRange& window) {
  scene::set(s, over, value);
  std::vector<ResponsePoint> peaks;
  for (const ResponseBranch& branch : observables::frequency_response(s, window))
    for (const auto& event : branch.events)
      if (event.kind == "peak") peaks.push_back(event.point);
  return peaks;
}

/// Whether a response has it, near by: next to the end of a curve a peak and its minimum are narrower than a
/// step.
bool is_peak(const scene::Scene& s, const std::string& over, const ResponsePoint& point) {
  const double frequency = point.omega / scene::to_rad_per_s(s.frequency_unit);
  for (const double width : {2e-2, 1e-4, 1e-6}) {
    FrequencyRange window = scenes::window(s);
    window.from = std::max(window.from, (1 - width) * frequency);
    window.to = std::min(window.to, (1 + width) * frequency);
    for (const ResponsePoint& peak : peaks_of(s, over, point.over, window))
      if (std::abs(peak.omega / point.omega - 1) < 1e-5 &&
          std::abs(peak.amplitude / point.amplitude - 1) < 1e-7)
        return true;
  }
  return false;
}

/// Every curve is whole, and its points are peaks, but for those nearer than `next to` to its ends, relative;
/// each peak of responses between is on one curve.
void check_curves(const scene::Scene& s, const CurveRange& range, std::size_t every, double nearby = 0) {
  const auto curves = observables::resonance_peaks(s, range);
  for (const ResponseBranch& curve : curves) {
    CAPTURE(curve.stop.message);
    CHECK(curve.status == observables::Status::complete);
    const auto is_end = [&](const ResponsePoint& point, const ResponsePoint& end) {
      return std::abs(point.over / end.over - 1) < nearby;
    };
    for (std::size_t i = every / 2; i + 1 < curve.points.size(); i += every) {
      if (is_end(curve.points[i], curve.points.front()) || is_end(curve.points[i], curve.points.back()))
        continue;
      CAPTURE(curve.points[i].over, curve.points[i].omega);
      CHECK(is_peak(s, range.over, curve.points[i]));
    }
  }
  for (const double share : {0.07, 0.27, 0.47, 0.67, 0.87}) {
    const double over = range.from * std::pow(range.to / range.from, share);
    for (const ResponsePoint& peak : peaks_of(s, range.over, over, scenes::window(s))) {
      CAPTURE(over, peak.omega);
      CHECK(curves_with(curves, peak, over) == 1);
    }
  }
}

}  // namespace

TEST_CASE(
    "curves of peaks of a motion with a mean are whole, and nothing but peaks, over two decades of a load") {
  const scene::Scene s = second_and_third();
  check_curves(s, peaks_over(s, "j0.normal_load", 9.3, 930), test_size::sized(15u, 150u));
}

TEST_CASE(
    "curves of peaks leave corners with the root of the slip, pass where corners cross, and end where "
    "surpassed",
    "[numbers]") {
  using random_scenes::Excitation;
  struct Case {
    Excitation excitation;
    std::uint64_t seed;
    double from, to;
  };
  // In turn: the load changes with the root of the slip next to the corner; another instant of the motion
  // becomes the largest at a corner; the highest reversal of an element that sticks changes; full stick with
  // two highest reversals.
  for (const Case& each : {Case{Excitation::first, 7, 0.224333, 22.4333},
                           Case{Excitation::first_and_second, 8, 0.0276722, 2.76722},
                           Case{Excitation::first_and_second, 9, 0.060048, 6.0048},
                           Case{Excitation::first_and_second, 2, 0.0330558, 3.30558}}) {
    const scene::Scene s = random_scenes::make(each.seed, each.excitation);
    CAPTURE(each.seed);
    check_curves(s, peaks_over(s, "d1.normal_load", each.from, each.to), 40, 1e-3);
  }
}

TEST_CASE(
    "beyond full stick, where the load moves nothing, a curve of peaks takes large steps over 16 decades") {
  const scene::Scene s = scenes::paper(9);
  const auto curves =
      observables::resonance_peaks(s, {"damper.normal_load", 0.01, 145887082697502.3, 18, 22});
  REQUIRE(curves.size() == 1);
  CHECK(curves.front().status == observables::Status::complete);
  CHECK(curves.front().points.size() < 1000);
}
