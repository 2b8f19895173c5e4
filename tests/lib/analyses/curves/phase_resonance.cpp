// Curves of phase resonance over a parameter.
#include "lib/analyses/modes_and_time/modes.hpp"

#include <arcslip/analyses/curves/curves.hpp>

#include <algorithm>
#include <cmath>

using namespace modes;
using observables::CurveRange;
using observables::Resonance;

namespace {

std::vector<ResponseBranch> phase_resonances(const scene::Scene& s, const CurveRange& range) {
  CurveRange of_phase = range;
  of_phase.resonance = Resonance::phase;
  return observables::resonance_peaks(s, of_phase);
}

const char* const contact =
    R"({"name": "d", "type": "jenkins", "at": "x", "stiffness": 0.25, "friction_coefficient": 0.5,
        "normal_load": 0.4})";

}  // namespace

TEST_CASE("without friction phase resonance is at the natural frequency at any damping") {
  scene::Scene s = oscillator(contact, 1, 0.3);
  scene::set(s, "d.normal_load", 0);
  const auto curves = phase_resonances(s, {"c.value", 0.05, 1, 0.5, 2});
  REQUIRE(curves.size() == 1);
  CHECK(curves[0].status == observables::Status::complete);
  CHECK(curves[0].of == "phase_resonance");
  CHECK(curves[0].points.size() > 5);
  for (const ResponsePoint& point : curves[0].points) {
    CHECK(point.omega == Approx(1).epsilon(1e-12));
    CHECK(point.amplitude == Approx(1 / point.over).epsilon(1e-11));
    CHECK(std::abs(std::abs(point.phase) - std::acos(0.0)) < 1e-11);
  }
  CHECK(curves[0].events.front().kind == "phase_resonance");
  CHECK(curves[0].events.back().point.over == 1);
}

TEST_CASE("with one harmonic the motion of one mass in phase resonance is that of its mode") {
  const scene::Scene s = oscillator(contact, 1, 0.02);
  const auto curves = phase_resonances(s, {"f.cosine", 0.02, 0.8, 0.5, 2});
  REQUIRE(curves.size() == 1);
  CHECK(curves[0].status == observables::Status::complete);
  CHECK(curves[0].points.size() > 10);
  std::size_t slipping = 0;
  for (std::size_t i = 0; i < curves[0].points.size(); i += 10) {
    const ResponsePoint& point = curves[0].points[i];
    const double A = point.amplitude;
    const ResponsePoint free = at_end(mode(s, 1, 0.9 * A, A), A);
    CAPTURE(point.over, A);
    CHECK(point.omega == Approx(free.omega).epsilon(1e-10));
    CHECK(point.over == Approx(2 * free.damping_ratio * free.omega * free.omega * A).epsilon(1e-9));
    slipping += point.elements[0].stick_percent < 100;
  }
  CHECK(slipping > 3);
}

TEST_CASE("with all harmonics phase resonance and the mode part with the damping, and meet without it") {
  // At the amplitude 1, of a contact that slips in most of the period.
  double before = 0;
  for (const double load : {0.1, 0.05, 0.025, 0.0125}) {
    scene::Scene s = oscillator(contact, 31, 0);
    scene::set(s, "d.normal_load", load);
    const auto curves = phase_resonances(s, {"f.cosine", load / 10, 4 * load, 0.5, 2});
    REQUIRE_FALSE(curves.empty());
    const auto& points = curves[0].points;
    const auto at = std::find_if(points.begin(), points.end(),
                                 [](const ResponsePoint& point) { return point.amplitude > 1; });
    REQUIRE(at != points.end());
    const ResponsePoint free = at_end(mode(s, 1, 0.9 * at->amplitude, at->amplitude), at->amplitude);
    const double apart = std::abs(at->omega / free.omega - 1);
    CAPTURE(load, free.damping_ratio, apart);
    CHECK(apart > 0);
    CHECK(apart < free.damping_ratio * free.damping_ratio);
    if (before > 0) CHECK(apart < 0.2 * before);  // it falls as the third power of the damping ratio
    before = apart;
  }
}

TEST_CASE("an antiresonance at the force is no phase resonance") {
  const std::string spring = R"({"name": "s", "type": "cubic_spring", "at": "x1", "stiffness": 1e-12})";
  std::string text = two_masses(spring, 1, "x1");
  text.insert(text.find("\"springs\""), R"("dampers": [{"name": "c", "at": "x1", "value": 0.01}], )");
  const scene::Scene s = parse(text);
  const auto curves = phase_resonances(s, {"c.value", 0.005, 0.02, 0.5, 2.5});
  REQUIRE(curves.size() == 2);
  double lower = curves[0].points.front().omega, upper = curves[1].points.front().omega;
  if (lower > upper) std::swap(lower, upper);
  CHECK(lower == Approx(1).epsilon(1e-3));
  CHECK(upper == Approx(std::sqrt(3)).epsilon(1e-3));
}
