// Curves of resonance peaks over a parameter.

#include "catch.hpp"
#include "controls.hpp"
#include "size.hpp"

#include "lib/analyses/curves/curves.hpp"
#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

using namespace arcslip;
using observables::CurveRange;
using observables::ResponseBranch;
using observables::ResponsePoint;
using observables_test::curves_with;
using observables_test::events;
using std::numbers::pi;
using test_size::sized;

namespace {

CurveRange over_load(double from, double to) {
  return {"damper.normal_load", from, to, 18, 22};
}

/// In the window of the scene.
CurveRange curve_range(const scene::Scene& s, const std::string& parameter, double from, double to) {
  const auto& window = scenes::window(s);
  return {parameter, from, to, window.from, window.to};
}

ResponseBranch paper_peaks(int order, double from = 0.01, double to = 500, double damping = 0.134) {
  scene::Scene s = scenes::paper(order);
  scene::set(s, "c.value", damping);
  const auto branches = observables::resonance_peaks(s, over_load(from, to));
  REQUIRE(branches.size() == 1);
  return branches.front();
}

}  // namespace

TEST_CASE("the curve of peaks ends at each load from 0.01 N to 500 N in the exact peak", "[numbers]") {
  const std::vector<std::pair<int, double>> orders = {{55, 5e-8}, {101, 5e-9}};
  for (const auto& [order, tolerance] : orders)
    for (const auto& exact : reference::exact("resonance_peaks")) {
      const double load = exact["normal_load"];
      CAPTURE(order, load);
      // From 0.01 N on, and the first load from 0.1 N down.
      const ResponseBranch branch =
          load > 0.01 ? paper_peaks(order, 0.01, load) : paper_peaks(order, 0.1, load);
      CHECK(branch.status == observables::Status::complete);
      const ResponsePoint& end = branch.points.back();
      CHECK(end.over == load);
      CHECK(reference::error(end.amplitude, exact["amplitude"]) < tolerance);
      CHECK(reference::error(end.omega / scenes::hertz, exact["frequency_hz"]) < 2e-8);
      CHECK(std::abs(end.elements[0].stick_percent - exact["stick_percent"].get<double>()) < 1e-4);
    }
}

TEST_CASE("from 0.01 N to 500 N the peaks are one curve, whose least peak is the exact optimum") {
  for (const auto& exact : reference::exact("optima")) {
    const double damping = exact["c"];
    CAPTURE(damping);
    const ResponseBranch branch = paper_peaks(101, damping > 0 ? 0.01 : 2, 500, damping);
    CHECK(branch.status == observables::Status::complete);
    CHECK(branch.points.front().over == (damping > 0 ? 0.01 : 2));
    CHECK(branch.points.back().over == 500);
    CHECK(std::is_sorted(branch.points.begin(), branch.points.end(),
                         [](const auto& a, const auto& b) { return a.over < b.over; }));
    REQUIRE(branch.events.size() == 1);
    const auto& optimum = branch.events[0];
    CHECK(optimum.kind == "minimum");
    CHECK_FALSE(optimum.nonsmooth);
    CHECK(reference::error(optimum.point.amplitude, exact["amplitude"]) < 5e-9);
    CHECK(reference::error(optimum.point.over, exact["normal_load"]) < 1e-7);
    CHECK(reference::error(optimum.point.omega / scenes::hertz, exact["frequency_hz"]) < 1e-8);
  }
}

TEST_CASE("one harmonic, no damping: peaks are p/(1 - pi f0/(4 p))/kd, least at Fn = pi N") {
  const ResponseBranch branch = paper_peaks(1, 2, 100, 0);
  for (const ResponsePoint& point : branch.points) {
    const double p = 0.5 * point.over;
    CAPTURE(point.over);
    CHECK(reference::error(point.amplitude, p / (1 - pi / (4 * p)) / 3500) < 1e-9);
  }
  const auto optimum = events(branch, "minimum");
  REQUIRE(optimum.size() == 1);
  CHECK(reference::error(optimum[0].point.over, pi) < 1e-9);
  CHECK(reference::error(optimum[0].point.amplitude, pi / 3500) < 1e-12);
}

TEST_CASE("the chords of a curve of peaks are off the closed form by less than half a pixel of its figure") {
  const auto exact = [](double load) {
    const double p = 0.5 * load;
    return p / (1 - pi / (4 * p)) / 3500;
  };
  constexpr double half_a_pixel = 3e-3;  // of amplitude or load, where 800 pixels are two decades
  const auto points = paper_peaks(1, 1.7, 100, 0).points;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const ResponsePoint &a = points[i - 1], &b = points[i];
    const double middle = 0.5 * (a.over + b.over), share = pi / (2 * middle);
    const double steepness = std::abs(1 - share / (1 - share));  // d ln A/d ln Fn
    CAPTURE(middle);
    CHECK(reference::error(0.5 * (a.amplitude + b.amplitude), exact(middle)) <
          half_a_pixel * std::max(1.0, steepness));
  }
}

TEST_CASE("without damping the peaks go to infinity at Fn = pi f0/(4 mu), where the curve ends and says so") {
  // At the beginning of the range the peak is unbounded: the curve comes from the other end.
  const ResponseBranch branch = paper_peaks(1, 0.5, 100, 0);
  CHECK(branch.status == observables::Status::complete);
  CHECK(branch.stop.reason == observables::reasons::unbounded);
  CHECK(branch.points.front().over == 100);
  CHECK(branch.points.back().over > pi / 2);
  CHECK(reference::error(branch.points.back().over, pi / 2) < 1e-4);
}

TEST_CASE("from full stick on the peak is that of the stuck oscillator: no slip above kd A/mu") {
  const double K = 17890 + 3500, m = 1.24, c = 0.134;
  const double omega = std::sqrt(K / m - c * c / (2 * m * m));
  const double amplitude = 1 / (c * std::sqrt(K / m - c * c / (4 * m * m)));
  const double load = 3500 * amplitude / 0.5;  // 397.74 N
  for (double share : {-1e-3, -1e-6, -1e-9, 1e-9, 1e-6, 1e-3}) {
    const ResponseBranch branch = paper_peaks(55, 300, load * (1 + share));
    CAPTURE(share, branch.stop.message);
    CHECK(branch.status == observables::Status::complete);
    const ResponsePoint& end = branch.points.back();
    CHECK((end.elements[0].stick_percent == 100) == (share > 0));
    if (share > 0) CHECK(reference::error(end.amplitude, amplitude) < 1e-11);
    if (share > 0) CHECK(reference::error(end.omega, omega) < 1e-11);
    CHECK(std::abs(end.amplitude / amplitude - 1) <= std::abs(share) + 1e-11);
  }
}

namespace {

double distance(const ResponsePoint& a, const ResponsePoint& b) {
  return std::max(reference::error(a.amplitude, b.amplitude), reference::error(a.omega, b.omega));
}

// Every curve that comes to `load` ends in a peak of the frequency response there. Returns how many there
// are.
int compare(const scene::Scene& s, const std::string& parameter, double from, double load, int& corners) {
  scene::Scene at = s;
  scene::set(at, parameter, load);
  const auto frf = observables::frequency_response(at, scenes::window(at)).front();
  int compared = 0;
  for (const auto& curve : observables::resonance_peaks(s, curve_range(s, parameter, from, load))) {
    CAPTURE(curve.stop.message);
    corners += static_cast<int>(events(curve, "corner").size());
    if (curve.points.empty() || curve.points.back().over != load) continue;
    double nearest = 1;
    for (const auto& event : frf.events)
      nearest = std::min(nearest, distance(event.point, curve.points.back()));
    CHECK(nearest < 1e-8);
    ++compared;
  }
  return compared;
}

}  // namespace

TEST_CASE(
    "random structures: where a curve of peaks ends at a load, the frequency response there has that peak") {
  int compared = 0, corners = 0;
  for (std::uint64_t seed = 0; seed < sized(10u, 2u); ++seed) {
    const scene::Scene s = random_scenes::make(seed, random_scenes::Excitation::first);
    for (double load : {0.13, 0.4, 1.0, 2.0, 5.0}) {
      CAPTURE(seed, s.dofs.size(), load);
      compared += compare(s, s.elements[0].name + ".normal_load", 0.1, load, corners);
    }
  }
  CHECK(compared >= sized(40, 4));
  // peaks that sit, for a range of loads, where an element passes from stick to slip
  if (!test_size::sanitized) CHECK(corners >= 4);
}

TEST_CASE(
    "peaks over a stiffness that no element sees, of a mass that no element sees, are those of responses") {
  scene::Scene s = scenes::chain(5, false);
  scene::set(s, "s.stiffness", 0);  // so that there is one response at each frequency
  int corners = 0;
  for (double stiffness : {0.55, 0.7, 0.9, 1.2, 1.5}) {
    CAPTURE(stiffness);
    CHECK(compare(s, "kc.value", 0.5, stiffness, corners) >= 2);
  }
}

namespace {

/// A mass with an absorber of a tenth of it next to, which friction ties to it more and more firmly: one
/// resonance where it slips, two where it sticks.
scene::Scene absorber() {
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["main", "absorber"],
      "masses": [{"name": "m", "at": "main", "value": 1}, {"name": "ma", "at": "absorber", "value": 0.1}],
      "springs": [{"name": "k", "at": "main", "value": 1},
                  {"name": "ka", "between": ["absorber", "main"], "value": 0.01}],
      "dampers": [{"name": "c", "at": "main", "value": 0.04},
                  {"name": "ca", "between": ["absorber", "main"], "value": 0.004}]},
    "elements": [{"name": "d1", "type": "jenkins", "between": ["absorber", "main"], "stiffness": 0.08,
                  "friction_coefficient": 0.5, "normal_load": 1}],
    "excitation": [{"name": "f", "at": "main", "cosine": 1}],
    "harmonics": {"order": 5}, "response": {"at": "main"},
    "studies": [{"kind": "frf", "from": 0.6, "to": 1.4}]})");
}

CurveRange normal_load_range(const scene::Scene& s, double from, double to) {
  return curve_range(s, "d1.normal_load", from, to);
}

/// Each peak of the responses between is on one curve, and on one only. Returns how many there are.
int check_between(const scene::Scene& s, const CurveRange& range) {
  const auto curves = observables::resonance_peaks(s, range);
  int peaks = 0;
  constexpr int loads = 9;
  for (int k = 0; k < loads; ++k) {
    const double load = range.from * std::pow(range.to / range.from, (k + 0.4) / loads);
    scene::Scene at = s;
    scene::set(at, range.over, load);
    for (const auto& branch : observables::frequency_response(at, scenes::window(s)))
      for (const auto& peak : events(branch, "peak")) {
        CAPTURE(load, peak.point.omega / scenes::hertz);
        CHECK(curves_with(curves, peak.point, load) == 1);
        ++peaks;
      }
  }
  return peaks;
}

}  // namespace

TEST_CASE(
    "a peak that is born within the range of a parameter is followed, in both directions of the range") {
  const scene::Scene s = absorber();
  for (const auto& [from, to] : {std::pair(0.1, 20.0), std::pair(20.0, 0.1)}) {
    const auto curves = observables::resonance_peaks(s, normal_load_range(s, from, to));
    // Where the absorber sticks there are two masses on springs: the resonances of the closed form.
    std::vector<double> stuck;
    for (const auto& curve : curves) {
      CHECK(curve.status == observables::Status::complete);
      for (const auto* end : {&curve.points.front(), &curve.points.back()})
        if (end->over == 20) stuck.push_back(end->omega);
    }
    REQUIRE(stuck.size() == 2);
    for (const double w : stuck) {
      const auto amplitude = [](double x) {
        const std::complex<double> ka(0.09, 0.004 * x), k(1, 0.04 * x);
        return std::abs((ka - 0.1 * x * x) / ((k + ka - x * x) * (ka - 0.1 * x * x) - ka * ka));
      };
      const double h = 1e-5;
      const double slope = (amplitude(w + h) - amplitude(w - h)) / (2 * h);
      const double second = (amplitude(w + h) - 2 * amplitude(w) + amplitude(w - h)) / (h * h);
      CHECK(second < 0);
      CHECK(std::abs(slope / second) < 1e-8);
    }
    CHECK(check_between(s, normal_load_range(s, from, to)) >= 14);
  }
}

TEST_CASE(
    "each peak of responses between two loads is on one curve: born, split, from a corner, and gone again",
    "[numbers]") {
  // Seeds whose peaks at 0.01 N are not all that there are between: one is there between two loads only (15).
  for (std::uint64_t seed : {3, 4, 13, 15, 19, 20, 25, 37}) {
    const scene::Scene s = random_scenes::make(seed, random_scenes::Excitation::first);
    CAPTURE(seed);
    check_between(s, normal_load_range(s, 0.01, 100));
  }
}

TEST_CASE("a peak that meets a minimum of the amplitude ends there, and the curve says so") {
  const scene::Scene s = random_scenes::make(4, random_scenes::Excitation::first);
  const CurveRange range = normal_load_range(s, 0.1, 1);
  bool ended = false;
  for (const auto& curve : observables::resonance_peaks(s, range)) {
    if (curve.stop.reason != observables::reasons::fold) continue;
    ended = true;
    CHECK(curve.status == observables::Status::complete);
    REQUIRE_FALSE(events(curve, "fold").empty());
    const double last = events(curve, "fold").back().point.over;
    CHECK(curve.points.back().over == last);
    CHECK(events(curve, "minimum").empty());  // A falls along the whole curve
    // Beyond there is one peak less than before.
    const auto peaks = [&](double load) {
      scene::Scene at = s;
      scene::set(at, range.over, load);
      return events(observables::frequency_response(at, scenes::window(at)).front(), "peak").size();
    };
    const double back = curve.points.front().over < last ? 0.99 : 1.01;
    CHECK(peaks(back * last) == peaks(last / back) + 1);
  }
  CHECK(ended);
}

TEST_CASE("a peak that leaves the window of the frequency ends at its edge") {
  CurveRange range = over_load(0.1, 10);
  range.frequency_to = 20;
  const auto branch = observables::resonance_peaks(scenes::paper(15), range).front();
  CHECK(branch.status == observables::Status::complete);
  CHECK(branch.stop.reason == observables::reasons::boundary);
  CHECK(reference::error(branch.points.back().omega, 20 * scenes::hertz) < 1e-11);
  CHECK(branch.points.back().over < 10);
}

TEST_CASE("where there is no peak in the window, the study says so") {
  CurveRange range = over_load(0.1, 10);
  range.frequency_from = 21.5;
  const auto branches = observables::resonance_peaks(scenes::paper(15), range);
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::failed);
  CHECK(branches[0].stop.reason == observables::reasons::start_failed);
  CHECK(branches[0].stop.message.find("no resonance peak was found at damper.normal_load = 0.1") == 0);
}

TEST_CASE("peaks below a share of the highest one next to them start no curve, and others all of theirs") {
  const scene::Scene s =
      scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "dofs": ["a", "b"], "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 1}],
    "springs": [{"name": "ka", "at": "a", "value": 100}, {"name": "kb", "between": ["b", "a"], "value": 100}],
    "dampers": [{"name": "c", "between": ["b", "a"], "value": 0.3}]},
    "excitation": [{"name": "f", "at": "b", "cosine": 1}], "harmonics": {"order": 1}, "response": {"at": "b"}})");
  const CurveRange range{"f.cosine", 1, 2, 4, 20};
  const auto all = observables::resonance_peaks(s, range);
  REQUIRE(all.size() == 2);
  // The same at all forces.
  const double low = all[1].points.front().amplitude / all[0].points.front().amplitude;
  REQUIRE(low < 0.9);
  const auto above = observables::high_resonance_peaks(s, range, 1.001 * low),
             below = observables::high_resonance_peaks(s, range, 0.999 * low);
  REQUIRE(above.size() == 1);
  CHECK(above[0].points.back().amplitude == all[0].points.back().amplitude);
  REQUIRE(below.size() == 2);
  CHECK(below[1].points.back().amplitude == all[1].points.back().amplitude);
}

TEST_CASE("a study of peaks ends with the callback, and no other curve is begun") {
  const auto compute = [](const studies::Case& at, const control::Control& of_case) {
    return observables::resonance_peaks(at.scene, over_load(0.1, 10), of_case);
  };
  const auto branches = studies::for_each<ResponseBranch>(
      scenes::paper(1), scene::Combinations({{"c.value", {0.1, 0.2}}}), compute,
      controls::reporting([](const control::Progress& progress) { return progress.points < 5; }));
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].status == observables::Status::stopped);
  CHECK(branches[0].stop.reason == observables::reasons::user);
  CHECK(branches[0].points.size() == 5);
}

TEST_CASE(
    "a peak that another instant of the period surpasses ends there: the response has it before, not "
    "beyond") {
  const scene::Scene s = random_scenes::make(5, random_scenes::Excitation::first_and_second);
  const CurveRange range = normal_load_range(s, 1, 3);
  const auto branches = observables::resonance_peaks(s, range);
  const auto surpassed = std::find_if(branches.begin(), branches.end(), [](const ResponseBranch& branch) {
    return branch.stop.reason == observables::reasons::fold && events(branch, "fold").empty();
  });
  REQUIRE(surpassed != branches.end());
  CHECK(surpassed->status == observables::Status::complete);
  const ResponsePoint& end = surpassed->points.back();
  const auto has_peak = [&](double load) {
    scene::Scene with = s;
    scene::set(with, range.over, load);
    const auto branch = observables::frequency_response(
                            with, {end.omega / scenes::hertz * 0.99, end.omega / scenes::hertz * 1.01})
                            .front();
    return std::any_of(branch.events.begin(), branch.events.end(), [&](const auto& event) {
      return event.kind == "peak" && std::abs(event.point.omega / end.omega - 1) < 1e-3;
    });
  };
  const double back = surpassed->points.front().over > end.over ? 1 : -1;
  CHECK(has_peak(end.over * (1 + 3e-3 * back)));
  CHECK_FALSE(has_peak(end.over * (1 - 3e-3 * back)));
}

TEST_CASE("in a window that begins within a hysteresis the peaks of the upper responses have their curve") {
  // With one harmonic, x'' + c x' + x + k x^3 = f cos wt has its peak a where w^2 = 1 + 3/4 k a^2 - c^2/2 and
  // (c a)^2 (w^2 + c^2/4) = f^2.
  const double c = 0.05, k = 0.1;
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.05}]},
    "elements": [{"name": "s", "type": "cubic_spring", "at": "x", "stiffness": 0.1}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.2}], "harmonics": {"order": 1}, "response": {"at": "x"}})");
  const auto from_rest = observables::frequency_response(s, {1.25, 1.29});
  REQUIRE(from_rest[0].points.front().amplitude < 1);  // the lower of three
  const auto curves = observables::resonance_peaks(s, {"f.cosine", 0.2, 0.25, 1.25, 1.5});
  REQUIRE(curves.size() == 1);
  CHECK(curves[0].status == observables::Status::complete);
  CHECK(curves[0].points.front().over == 0.2);
  CHECK(curves[0].points.back().over == 0.25);
  for (const ResponsePoint& point : curves[0].points) {
    const double square = 1 + 0.75 * k * point.amplitude * point.amplitude - c * c / 2;
    CHECK(std::abs(point.omega / std::sqrt(square) - 1) < 1e-9);
    CHECK(std::abs(c * point.amplitude * std::sqrt(square + c * c / 4) / point.over - 1) < 1e-9);
  }
}
