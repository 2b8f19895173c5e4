// Curves of resonance peaks over a parameter.

#include "catch.hpp"

#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"
#include "lib/observables/reference.hpp"

#include <arcslip/observables/curves.hpp>

#include <algorithm>
#include <cmath>

using namespace arcslip;
using observables::ResponseBranch;
using observables::ResponsePoint;
constexpr double pi = std::numbers::pi;

namespace {

scene::Study over_load(double from, double to) {
  scene::Study study;
  study.name = "peaks";
  study.kind = scene::StudyKind::peaks;
  study.over = "damper.normal_load";
  study.from = from;
  study.to = to;
  study.frequency_from = 18;
  study.frequency_to = 22;
  return study;
}

ResponseBranch paper_peaks(int order, double from = 0.01, double to = 500, double damping = 0.134) {
  scene::Scene s = scenes::paper(order);
  scene::set(s, "c.value", damping);
  const auto branches = observables::resonance_peaks(s, over_load(from, to));
  REQUIRE(branches.size() == 1);
  return branches.front();
}

std::vector<observables::ResponseEvent> events(const ResponseBranch& branch, const std::string& kind) {
  std::vector<observables::ResponseEvent> found;
  for (const auto& event : branch.events)
    if (event.kind == kind) found.push_back(event);
  return found;
}

}  // namespace

TEST_CASE("the curve of peaks ends at each load from 0.01 N to 500 N in the exact peak") {
  const std::vector<std::pair<int, double>> orders = {{55, 5e-8}, {101, 5e-9}};
  for (const auto& [order, tolerance] : orders)
    for (const auto& exact : reference::exact("resonance_peaks")) {
      const double load = exact["normal_load"];
      CAPTURE(order, load);
      // From 0.01 N on, and the first load from 0.1 N down.
      const ResponseBranch branch = load > 0.01 ? paper_peaks(order, 0.01, load) : paper_peaks(order, 0.1, load);
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

TEST_CASE("without damping the peaks go to infinity at Fn = pi f0/(4 mu), where the curve ends and says so") {
  // At the beginning of the range the peak is unbounded: the curve comes from the other end.
  const ResponseBranch branch = paper_peaks(1, 0.5, 100, 0);
  CHECK(branch.status == observables::Status::complete);
  CHECK(branch.stop.reason == "unbounded");
  CHECK(branch.points.front().over == 100);
  CHECK(std::abs(branch.points.back().over - pi / 2) < 1e-5);
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

TEST_CASE("random structures: peaks on the curves are those of frequency responses at five loads") {
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const scene::Scene s = random_scenes::make(seed, random_scenes::Excitation::first);
    scene::Study study = over_load(0.1, 5);
    study.over = s.elements[0].name + ".normal_load";
    study.frequency_from = s.studies[0].from;
    study.frequency_to = s.studies[0].to;
    CAPTURE(seed);
    for (double load : {0.13, 0.4, 1.0, 2.0, 5.0}) {
      study.to = load;
      CAPTURE(load);
      const auto curves = observables::resonance_peaks(s, study);
      scene::Scene at = s;
      scene::set(at, study.over, load);
      const auto frf = observables::frequency_response(at, at.studies[0]).front();
      for (const auto& curve : curves) {
        CAPTURE(curve.stop.message);
        if (curve.stop.reason != "boundary" || curve.points.back().over != load) {
          std::printf("seed %d load %g: %s %s\n", (int)seed, load, curve.stop.reason.c_str(), curve.stop.message.c_str());
          continue;
        }
        const ResponsePoint& end = curve.points.back();
        if (std::min(end.omega - at.studies[0].from * scenes::hertz, at.studies[0].to * scenes::hertz - end.omega) < 1e-9) continue;
        double nearest = 1;
        for (const auto& event : frf.events)
          nearest = std::min(nearest, std::max(reference::error(event.point.amplitude, end.amplitude),reference::error(event.point.omega, end.omega)));
        CHECK(nearest < 1e-8);
        ++compared;
      }
    }
  }
  CHECK(compared > 50);
}
