// Nonlinear modes against closed forms.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/observables/nonlinear_modes.hpp>
#include <arcslip/observables/reasons.hpp>

#include <cmath>
#include <string>

using namespace arcslip;
using observables::ResponseBranch;
using observables::ResponsePoint;
using scenes::parse;

namespace {

// One mass, m = k = 1 unless told, with elements.
scene::Scene oscillator(const std::string& elements, int order, const std::string& more = "",
                        double damping = 0, const std::string& excitation = R"("harmonic": 1, "cosine": 1)") {
  return parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}],
      "dampers": [{"name": "c", "at": "x", "value": )" +
               std::to_string(damping) + R"(}])" + more + R"(},
    "elements": [)" +
               elements + R"(], "excitation": [{"name": "f", "at": "x", )" + excitation +
               R"(}], "harmonics": {"order": )" + std::to_string(order) + R"(},
    "response": {"at": "x"}, "studies": [{"kind": "frf", "from": 0.5, "to": 2}]})");
}

ResponseBranch mode(const scene::Scene& s, int number, double from, double to) {
  return observables::nonlinear_modes(s, {number, from, to}).front();
}

// The last point of a branch that must be complete.
ResponsePoint at_end(const ResponseBranch& branch, double amplitude) {
  INFO(branch.stop.message);
  REQUIRE(branch.status == observables::Status::complete);
  CHECK(branch.stop.reason == observables::reasons::boundary);
  CHECK(branch.points.back().amplitude == Approx(amplitude).epsilon(1e-14));
  return branch.points.back();
}

const char* cubic = R"({"name": "s", "type": "cubic_spring", "at": "x", "stiffness": 1})";

// omega of x'' + x + x^3 = 0 at the amplitude A: pi sqrt(1 + A^2) / (2 K(m)), m = A^2/(2 (1 + A^2)).
double duffing(double A) {
  const double m = A * A / (2 * (1 + A * A));
  return std::numbers::pi * std::sqrt(1 + A * A) / (2 * std::comp_ellint_1(std::sqrt(m)));
}

}  // namespace

TEST_CASE("the frequency and the energy of a Duffing oscillator are those of its elliptic functions") {
  CHECK(duffing(1) == Approx(1.31777606497).epsilon(1e-11));
  const ResponseBranch branch = mode(oscillator(cubic, 31), 1, 1e-6, 1);
  const ResponsePoint last = at_end(branch, 1);
  CHECK(last.omega == Approx(1.31777606497).epsilon(1e-11));
  CHECK(std::abs(last.damping_ratio) < 1e-14);
  CHECK(last.energy == Approx(0.75).epsilon(1e-12));
  CHECK(branch.points.front().omega == Approx(1).epsilon(1e-12));
  CHECK(branch.points.size() > 100);
  for (const ResponsePoint& point : branch.points) {
    const double A = point.amplitude;
    CHECK(point.omega == Approx(duffing(A)).epsilon(1e-11));
    CHECK(point.energy == Approx(A * A / 2 + A * A * A * A / 4).epsilon(1e-11));
  }
  CHECK(branch.events.empty());
}

TEST_CASE(
    "with one harmonic the frequency of a Duffing oscillator is sqrt(1 + 3/4 A^2), over eight decades") {
  const ResponseBranch branch = mode(oscillator(cubic, 1), 1, 1e-4, 1e4);
  at_end(branch, 1e4);
  for (const ResponsePoint& point : branch.points)
    CHECK(point.omega == Approx(std::sqrt(1 + 0.75 * point.amplitude * point.amplitude)).epsilon(1e-12));
}

TEST_CASE("a mass on springs of frequencies 1 and 2 on its two sides swings at 4/3 at every amplitude") {
  const std::string spring =
      R"({"name": "s", "type": "bilinear_spring", "at": "x", "stiffness": 0, "stiffness_beyond": 3, "corner": 0,
          "one_sided": true})";
  double before = 0;
  for (const int order : {8, 16, 32, 64}) {
    const ResponseBranch branch = mode(oscillator(spring, order), 1, 1e-5, 1e3);
    at_end(branch, 1e3);
    double worst = 0;
    for (const ResponsePoint& point : branch.points) worst = std::max(worst, std::abs(point.omega - 4.0 / 3));
    CAPTURE(order, worst);
    // The corner of the force leaves harmonics of order N^-4 in the motion.
    if (before > 0) CHECK(worst < before / 8);
    before = worst;
  }
  CHECK(before < 1e-7);
}

TEST_CASE("one mass with one Jenkins element has the frequency, the loss and the damping of its loop") {
  const std::string damper =
      R"({"name": "d", "type": "jenkins", "at": "x", "stiffness": 0.25, "friction_coefficient": 0.5,
          "normal_load": 0.4})";
  const ResponseBranch branch = mode(oscillator(damper, 1), 1, 1e-4, 2);
  const ResponsePoint& first = branch.points.front();
  const ResponsePoint last = at_end(branch, 2);
  CHECK(first.omega == Approx(std::sqrt(1.25)).epsilon(1e-12));
  CHECK(std::abs(first.damping_ratio) < 1e-14);
  CHECK(first.energy_friction == 0);
  CHECK(first.elements[0].stick_percent == 100);
  CHECK(last.omega == Approx(1.04564932447).epsilon(1e-11));
  CHECK(last.energy_friction == Approx(0.96).epsilon(1e-12));
  CHECK(last.damping_ratio == Approx(0.03493487961).epsilon(1e-9));
  CHECK(last.energy_input == Approx(0.96).epsilon(1e-12));
  CHECK(std::abs(last.energy_viscous) < 1e-13);
  CHECK(last.energy == Approx(0.5 * 4 * last.omega * last.omega).epsilon(1e-11));
}
