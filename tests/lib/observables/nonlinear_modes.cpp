// Nonlinear modes against closed forms.
#include "catch.hpp"

#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/model/model.hpp>
#include <arcslip/observables/nonlinear_modes.hpp>
#include <arcslip/observables/reasons.hpp>
#include <arcslip/studies/figures.hpp>

#include <algorithm>

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
  CHECK(branch.events.size() == 2);  // its ends
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

namespace {

// The paper's oscillator with one harmonic: a force cosine and a loss of the friction in closed form.
struct ClosedForm {
  double m = 0, k = 0, c = 0, kd = 0, limit = 0;

  double stiffness(double A) const {
    const double onset = limit / kd;
    if (A <= onset) return kd;
    const double theta = std::acos(1 - 2 * onset / A);
    return kd / std::numbers::pi * (theta - 0.5 * std::sin(2 * theta));
  }
  double loss(double A) const { return A <= limit / kd ? 0 : 4 * limit * (A - limit / kd); }
  double omega(double A) const { return std::sqrt((k + stiffness(A)) / m); }
  double damping(double A) const {
    const double w = omega(A);
    return c / (2 * m * w) + loss(A) / (2 * std::numbers::pi * m * w * w * A * A);
  }
};

double value_of(const scene::Scene& s, const std::string& name) {
  const model::Model built = model::build(s);
  return built.parameters[static_cast<std::size_t>(model::parameter_index(built, name))].value;
}

ClosedForm closed_form(const scene::Scene& s) {
  return {value_of(s, "m.value"), value_of(s, "k.value"), value_of(s, "c.value"),
          value_of(s, "damper.stiffness"),
          value_of(s, "damper.friction_coefficient") * value_of(s, "damper.normal_load")};
}

// m = 1, k and a Jenkins element, with a mass of the structure "m2" coupled.
std::string two_masses(const std::string& elements, int order, const std::string& response) {
  return R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x1", "x2"],
      "masses": [{"name": "m1", "at": "x1", "value": 1}, {"name": "m2", "at": "x2", "value": 1}],
      "springs": [{"name": "k1", "at": "x1", "value": 1}, {"name": "k12", "between": ["x1", "x2"], "value": 1},
                  {"name": "k2", "at": "x2", "value": 1}]},
    "elements": [)" +
         elements + R"(], "excitation": [{"name": "f", "at": "x1", "cosine": 1}],
    "harmonics": {"order": )" +
         std::to_string(order) + R"(}, "response": {"at": ")" + response +
         R"("}, "studies": [{"kind": "frf", "from": 0.5, "to": 2}]})";
}

const char* cubic_at_x1 = R"({"name": "s", "type": "cubic_spring", "at": "x1", "stiffness": 0.5})";

std::string failure(const scene::Scene& s, int number, double from, double to,
                    const results::Reason& reason) {
  const ResponseBranch branch = mode(s, number, from, to);
  CHECK(branch.status == observables::Status::failed);
  CHECK(branch.stop.reason == reason);
  CHECK(branch.points.empty());
  CHECK(branch.events.empty());
  return branch.stop.message;
}

void check_contains(const std::string& text, const std::string& part) {
  INFO(text);
  CHECK(text.find(part) != std::string::npos);
}

}  // namespace

TEST_CASE(
    "with one harmonic the paper's oscillator has the mode of the describing function of its friction") {
  const scene::Scene s = scenes::paper(1);
  const ClosedForm exact = closed_form(s);
  const double onset = exact.limit / exact.kd;
  const ResponseBranch branch = mode(s, 1, 1e-3 * onset, 1e3 * onset);
  at_end(branch, 1e3 * onset);
  double largest = 0, where = 0;
  for (const ResponsePoint& point : branch.points) {
    const double A = point.amplitude;
    CAPTURE(A / onset);
    CHECK(point.omega == Approx(exact.omega(A)).epsilon(1e-12));
    CHECK(point.damping_ratio == Approx(exact.damping(A)).epsilon(1e-12));
    CHECK(point.energy_friction == Approx(exact.loss(A)).epsilon(1e-11).margin(1e-14 * exact.k * A * A));
    CHECK(point.energy_total() == Approx(point.energy_input).epsilon(1e-11));
  }
  for (double A = onset; A < 10 * onset; A *= 1.00001)
    if (exact.damping(A) > largest) largest = exact.damping(where = A);
  const auto maximum = std::find_if(branch.events.begin(), branch.events.end(),
                                    [](const auto& e) { return e.kind == "maximum"; });
  REQUIRE(maximum != branch.events.end());
  CHECK(maximum->point.damping_ratio == Approx(largest).epsilon(1e-9));
  CHECK(maximum->point.amplitude == Approx(where).epsilon(1e-4));
  CHECK(branch.events.front().kind == "start");
  CHECK(branch.events.back().kind == "end");
}

TEST_CASE("a damper that sticks throughout is a spring, and the mode keeps the viscous damping") {
  const scene::Scene s = scenes::paper(7, 1e6);
  const ClosedForm exact = closed_form(s);
  const double omega = std::sqrt((exact.k + exact.kd) / exact.m);
  const ResponseBranch branch = mode(s, 1, 1e-8, 1);
  at_end(branch, 1);
  CHECK(branch.events.size() == 2);
  for (const ResponsePoint& point : branch.points) {
    CHECK(point.omega == Approx(omega).epsilon(1e-13));
    CHECK(point.damping_ratio == Approx(exact.c / (2 * exact.m * omega)).epsilon(1e-12));
    CHECK(point.elements[0].stick_percent == 100);
  }
}

TEST_CASE("two masses: modes 1 and sqrt 3 at low energy, and the closed form of one harmonic up to sqrt 2") {
  const scene::Scene s = parse(two_masses(cubic_at_x1, 1, "x2"));
  const ResponseBranch first = mode(s, 1, 1e-4, 1e7), second = mode(s, 2, 1e-4, 1e-2);
  CHECK(first.points.front().omega == Approx(1).epsilon(1e-8));
  CHECK(at_end(second, 1e-2).omega > second.points.front().omega);
  CHECK(second.points.front().omega == Approx(std::sqrt(3)).epsilon(1e-8));
  CHECK(at_end(first, 1e7).omega == Approx(std::sqrt(2)).epsilon(1e-4));
  for (const ResponsePoint& point : first.points) {
    const double delta = 2 - point.omega * point.omega;  // x1 = delta x2, x1 delta + 3/8 x1^3 = x2
    const double x1 = std::sqrt((1 / delta - delta) / 0.375);
    if (point.amplitude < 0.1) continue;  // where the difference above loses its digits
    CHECK(point.amplitude == Approx(x1 / delta).epsilon(1e-8));
  }
}

TEST_CASE(
    "the out-of-phase mode leaves its second mass at rest: the amplitude there has a fold in closed form") {
  // With one harmonic x2 = x1/d, 3/8 x1^2 = 1/d - d, d = 2 - omega^2: x2 is largest at d = -sqrt 3.
  const ResponseBranch branch = mode(parse(two_masses(cubic_at_x1, 1, "x2")), 2, 1e-3, 2);
  CHECK(branch.status == observables::Status::stopped);
  CHECK(branch.stop.reason == observables::reasons::boundary);
  check_contains(branch.stop.message, "turned back at 1.0131");
  REQUIRE(branch.events.size() == 3);
  CHECK(branch.events[1].kind == "fold");
  CHECK(branch.events[1].point.omega == Approx(std::sqrt(2 + std::sqrt(3))).epsilon(1e-6));
  CHECK(branch.events[1].point.amplitude == Approx(std::sqrt(16 / (9 * std::sqrt(3)))).epsilon(1e-12));
  CHECK(branch.points.back().amplitude == Approx(1e-3).epsilon(1e-12));
}

TEST_CASE("the mode of a van der Pol oscillator without damping in total is its limit cycle") {
  // mu = 1: period 6.6632868593231, amplitude 2.0086198608748 (Amore, Boyd & Fernandez 2018).
  const scene::Scene s =
      oscillator(R"({"name": "v", "type": "van_der_pol", "at": "x", "coefficient": 1, "amplitude": 1})", 41);
  const ResponseBranch branch = mode(s, 1, 0.1, 2.0086198608748);
  const ResponsePoint last = at_end(branch, 2.0086198608748);
  CHECK(branch.points.front().damping_ratio < -0.4);
  CHECK(std::abs(last.damping_ratio) < 1e-10);
  CHECK(2 * std::numbers::pi / last.omega == Approx(6.6632868593231).epsilon(1e-10));
}

TEST_CASE("a mass that meets a stop has the period of its two half motions") {
  const double gap = 0.5, k = 8;
  const scene::Scene s =
      oscillator(R"({"name": "g", "type": "gap_spring", "at": "x", "stiffness": 8, "gap": 0.5})", 63);
  const ResponseBranch branch = mode(s, 1, 0.01, 5);
  at_end(branch, 5);
  double worst = 0;
  for (const ResponsePoint& point : branch.points) {
    if (point.amplitude < gap) {
      CHECK(point.omega == Approx(1).epsilon(1e-12));
      continue;
    }
    // Beyond the gap the mass swings with omega_2 about x_e, by r; on the other side by a about 0.
    const double omega_2 = std::sqrt(1 + k), x_e = k * gap / (1 + k);
    const auto r = [&](double a) {
      return std::sqrt((a * a - gap * gap) / (1 + k) + (gap - x_e) * (gap - x_e));
    };
    double lower = gap, upper = 20;
    for (int i = 0; i < 80; ++i) {
      const double a = 0.5 * (lower + upper);
      (0.5 * (a + x_e + r(a)) < point.amplitude ? lower : upper) = a;
    }
    const double time =
        2 * (std::numbers::pi - std::acos(gap / lower)) + 2 / omega_2 * std::acos((gap - x_e) / r(lower));
    worst = std::max(worst, std::abs(point.omega * time / (2 * std::numbers::pi) - 1));
    CHECK(point.energy == Approx(0.5 * lower * lower).epsilon(1e-4));
  }
  CHECK(worst < 1e-6);
}

TEST_CASE("a static load shifts the mode of a spring to its stiffness at rest, and counts as no amplitude") {
  // x + x^3 = 2 at x = 1: stiffness 1 + 3 x^2 = 4.
  const scene::Scene s =
      oscillator(cubic, 9, "", 0.1, R"("harmonic": 0, "cosine": 2}, {"name": "g", "at": "x", "cosine": 1)");
  const ResponseBranch branch = mode(s, 1, 1e-6, 1e-2);
  at_end(branch, 1e-2);
  CHECK(branch.points.front().omega == Approx(2).epsilon(1e-9));
  CHECK(branch.points.front().damping_ratio == Approx(0.1 / 4).epsilon(1e-9));
  CHECK(branch.points.front().coefficients[0] == Approx(1).epsilon(1e-9));
  CHECK(branch.points.front().energy == Approx(0.5 * 1e-12 * 4).epsilon(1e-3));
  CHECK(branch.points.back().omega < 2);
}

TEST_CASE("a preloaded stop is closed at rest, and a degree of freedom without mass follows its springs") {
  const scene::Scene closed =
      oscillator(R"({"name": "g", "type": "gap_spring", "at": "x", "stiffness": 3, "gap": -0.5})", 9);
  CHECK(mode(closed, 1, 1e-3, 0.1).points.front().omega == Approx(2).epsilon(1e-12));
  const std::string text = R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x", "y"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}, {"name": "c", "between": ["x", "y"], "value": 2}]},
    "elements": [{"name": "d", "type": "jenkins", "at": "y", "stiffness": 6, "friction_coefficient": 0.5,
                  "normal_load": 1}],
    "excitation": [{"name": "f", "at": "x", "cosine": 1}], "harmonics": {"order": 5},
    "response": {"at": "x"}, "studies": [{"kind": "frf", "from": 0.5, "to": 2}]})";
  const ResponseBranch branch = mode(parse(text), 1, 1e-6, 1e6);
  CHECK(branch.points.front().omega == Approx(std::sqrt(1 + 1 / (1.0 / 2 + 1.0 / 6))).epsilon(1e-12));
  CHECK(at_end(branch, 1e6).omega == Approx(1).epsilon(1e-5));
  check_contains(failure(parse(text), 2, 1e-6, 1, observables::reasons::no_mode),
                 "mode 2 does not exist: the structure has 1 mode");
}

TEST_CASE(
    "laws with unknowns of their own, sampled laws and sampled friction have modes, with energies that "
    "balance") {
  const char* bouc_wen =
      R"({"name": "b", "type": "bouc_wen", "at": "x", "stiffness": 1, "elastic_share": 0.2,
          "yield_displacement": 0.1})";
  const char* jenkins =
      R"({"name": "d", "type": "jenkins", "at": "x", "stiffness": 0.25, "friction_coefficient": 0.5,
          "normal_load": 0.4})";
  const ResponseBranch exact = mode(oscillator(jenkins, 5), 1, 1e-3, 10);
  scene::Scene sampled = oscillator(jenkins, 5);
  sampled.harmonics.friction = scene::Friction::sampled;
  CHECK(at_end(mode(sampled, 1, 1e-3, 10), 10).damping_ratio ==
        Approx(exact.points.back().damping_ratio).epsilon(1e-3));
  const ResponseBranch hysteretic = mode(oscillator(bouc_wen, 9), 1, 1e-4, 10);
  at_end(hysteretic, 10);
  CHECK(hysteretic.points.front().omega == Approx(std::sqrt(2)).epsilon(1e-3));
  for (const ResponsePoint& point : hysteretic.points)
    CHECK(point.energy_total() == Approx(point.energy_input).epsilon(1e-9));
}

TEST_CASE("where there is no mode to follow a branch says why") {
  using namespace observables::reasons;
  const scene::Scene s = parse(two_masses(cubic_at_x1, 3, "x2"));
  check_contains(failure(s, 3, 1e-3, 1, no_mode), "mode 3 does not exist: the structure has 2 modes");
  check_contains(
      failure(oscillator(R"({"name": "d", "type": "coulomb", "at": "x", "friction_coefficient": 0.5,
                             "normal_load": 0.4})",
                         3),
              1, 1e-3, 1, no_mode),
      "the friction of \"d\" has no stiffness");
  check_contains(failure(oscillator(R"({"name": "s", "type": "bilinear_spring", "at": "x", "stiffness": -3,
                                        "stiffness_beyond": 3, "corner": 1})",
                                    3),
                         1, 1e-3, 1, no_mode),
                 "mode 1 does not oscillate: the structure at rest is unstable");
  // A free pair of masses, first in odd harmonics and then with a mean.
  const auto floating = [](const std::string& excitation) {
    return parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x1", "x2"],
      "masses": [{"name": "m1", "at": "x1", "value": 1}, {"name": "m2", "at": "x2", "value": 1}],
      "springs": [{"name": "k12", "between": ["x1", "x2"], "value": 1}]},
    "elements": [{"name": "s", "type": "cubic_spring", "between": ["x1", "x2"], "stiffness": 0.5}],
    "excitation": [{"name": "f", "at": "x1", "cosine": 1)" +
                 excitation + R"(}],
    "harmonics": {"order": 3}, "response": {"at": "x1"},
    "studies": [{"kind": "frf", "from": 0.5, "to": 2}]})");
  };
  check_contains(
      failure(floating(""), 1, 1e-3, 1, no_mode),
      "mode 1 is a motion that no spring resists, of frequency 0; the first mode that oscillates is "
      "mode 2");
  CHECK(mode(floating(""), 2, 1e-4, 1).points.front().omega == Approx(std::sqrt(2)).epsilon(1e-6));
  check_contains(failure(floating(R"(, "harmonic": 2)"), 2, 1e-3, 1, start_failed),
                 "no spring holds the mean position of \"x1\"");
  // Mode 2 of three equal masses between walls does not move the one in the middle.
  const scene::Scene node = parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b", "c"],
      "masses": [{"name": "ma", "at": "a", "value": 1}, {"name": "mb", "at": "b", "value": 1},
                 {"name": "mc", "at": "c", "value": 1}],
      "springs": [{"name": "ka", "at": "a", "value": 1}, {"name": "kab", "between": ["a", "b"], "value": 1},
                  {"name": "kbc", "between": ["b", "c"], "value": 1}, {"name": "kc", "at": "c", "value": 1}]},
    "elements": [{"name": "s", "type": "cubic_spring", "at": "b", "stiffness": 0.5}],
    "excitation": [{"name": "f", "at": "a", "cosine": 1}], "harmonics": {"order": 3},
    "response": {"at": "b"}, "studies": [{"kind": "frf", "from": 0.5, "to": 2}]})");
  check_contains(failure(node, 2, 1e-3, 1, no_mode), "mode 2 does not move the response");
  scene::Scene linear = node;
  linear.responses.front().direction = {{0, 1.0}};
  check_contains(failure(linear, 2, 1e-3, 1, no_mode),
                 "mode 2 moves no element: it is linear, of 1.4142136 rad/s and the damping ratio 0");
  // Two blades that nothing couples, and two of different stiffness: 1/k of the dampers shifts no other mode.
  const auto pair = [](double k2) {
    return parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", )" +
                 scenes::uncoupled({{"a", 1, 1, 0.1}, {"b", 1, k2, 0.1}}) +
                 R"(, "elements": [{"name": "s", "type": "cubic_spring", "at": "a", "stiffness": 0.5},
                                   {"name": "t", "type": "cubic_spring", "at": "b", "stiffness": 0.5}],
    "excitation": [{"name": "f", "at": "a", "cosine": 1}], "harmonics": {"order": 3},
    "response": {"at": "b"}, "studies": [{"kind": "frf", "from": 0.5, "to": 2}]})");
  };
  check_contains(failure(pair(1), 1, 1e-3, 1, no_mode), "mode 1 has the frequency of mode 2");
  CHECK(mode(pair(1.21), 2, 1e-4, 1).points.front().omega == Approx(1.1).epsilon(1e-6));
  // Harmonics without the fundamental: a motion of three periods with two harmonics.
  scene::Scene subharmonic = oscillator(cubic, 2);
  subharmonic.harmonics.period = 3;
  check_contains(failure(subharmonic, 1, 1e-3, 1, no_mode), "the fundamental is not among the harmonics");
}

TEST_CASE("a mode may be stopped, and takes only amplitudes in order and a number from 1 on") {
  const scene::Scene s = oscillator(cubic, 5);
  long calls = 0;
  const auto stopped = observables::nonlinear_modes(
      s, {1, 1e-3, 1}, [&](const results::Progress& now) { return ++calls > 0 && now.points < 5; });
  CHECK(stopped.front().status == observables::Status::stopped);
  CHECK(stopped.front().stop.reason == observables::reasons::user);
  CHECK(stopped.front().points.size() == 5);
  const auto at_once =
      observables::nonlinear_modes(s, {1, 1e-3, 1}, [](const results::Progress&) { return false; });
  CHECK(at_once.front().stop.reason == observables::reasons::user);
  CHECK(at_once.front().points.empty());
  for (const auto& bad : {observables::ModeRange{0, 1e-3, 1}, {1, 0, 1}, {1, 1, 1}, {1, 2, 1}})
    CHECK_THROWS_AS(observables::nonlinear_modes(s, bad), std::invalid_argument);
}

TEST_CASE("figures of modes are over the amplitude: the frequency, the damping ratio, and stick") {
  const scene::Scene s = scenes::paper(1);
  const std::vector branches{mode(s, 1, 1e-5, 1e-2)};
  const results::FigureData data = studies::figures_of(s, studies::BranchKind::modes, branches);
  REQUIRE(data.columns.size() == 4);
  CHECK(data.columns[0].label == "amplitude (m)");
  CHECK(data.columns[0].scale == results::Scale::logarithmic);
  CHECK(data.columns[1].label == "frequency (Hz)");
  CHECK(data.columns[2].label == "damping ratio");
  CHECK(data.columns[2].scale == results::Scale::linear);
  REQUIRE(data.figures.size() == 4);
  const char* names[] = {"frequency", "damping_ratio", "stick", "contact"};
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(data.figures[i].name == names[i]);
    CHECK(data.figures[i].x == 0);
    if (i < 3) CHECK(data.figures[i].y == i + 1);
  }
  const ResponsePoint& point = branches[0].points[60];
  CHECK(data.lines[0].parts[0][60] == results::Record{point.amplitude, point.omega / scenes::hertz,
                                                      point.damping_ratio, point.elements[0].stick_percent});
  REQUIRE(data.lines[0].marks.size() == 1);  // no mark at the ends
  CHECK(data.lines[0].marks[0].kind == "maximum");
}

TEST_CASE("where the motion outgrows that of the response a branch ends, and says so") {
  // At high energy mode 3 leaves the mass c behind, which only the damper of b still moves: by c_bc b/(m_c
  // w).
  const ResponseBranch branch = mode(scenes::chain(3, false), 3, 1e-3, 30);
  CHECK(branch.status == observables::Status::failed);
  CHECK(branch.stop.reason == observables::reasons::state_too_large);
  check_contains(branch.stop.message, "grew more than 1e8 times over that of the response");
  check_contains(branch.stop.message, "choose another response");
}

TEST_CASE(
    "the peaks of examples/damped_mode lie on the mode, where the force does the work that the mode loses") {
  scene::Scene s = scenes::example("damped_mode");
  for (const double force : {2.0, 6.0, 12.0}) {
    scene::set(s, "force.cosine", force);
    const auto response = observables::frequency_response(s, {30, 36}).front();
    const auto peak = std::find_if(response.events.begin(), response.events.end(),
                                   [](const auto& event) { return event.kind == "peak"; });
    REQUIRE(peak != response.events.end());
    const double A = peak->point.amplitude;
    const ResponsePoint on = at_end(mode(s, 1, 1e-4, A), A);
    CAPTURE(force, on.damping_ratio);
    // The peak of a linear oscillator lies zeta^2 below its frequency.
    CHECK(std::abs(peak->point.omega / on.omega - 1) < 2 * on.damping_ratio * on.damping_ratio + 1e-6);
    // The higher harmonics of the motion are less than 2 % of it, and the phase at the peak is not quite 90
    // degrees.
    CHECK(on.energy_total() / (std::numbers::pi * A) == Approx(force).epsilon(2e-3));
  }
}

TEST_CASE(
    "the largest damping of examples/damped_mode is the same for every load, at amplitudes in proportion to "
    "it") {
  scene::Scene s = scenes::example("damped_mode");
  std::vector<ResponsePoint> largest;
  for (const double load : {5.0, 10.0, 20.0}) {
    scene::set(s, "damper.normal_load", load);
    const ResponseBranch branch = mode(s, 1, 1e-4, 1e-2);
    REQUIRE(branch.events.size() == 3);
    largest.push_back(branch.events[1].point);
    CHECK(largest.back().damping_ratio == Approx(largest.front().damping_ratio).epsilon(1e-12));
    CHECK(largest.back().omega == Approx(largest.front().omega).epsilon(1e-9));
    CHECK(largest.back().amplitude / load == Approx(largest.front().amplitude / 5).epsilon(1e-7));
  }
}

TEST_CASE("a branch that meets another mode at three times its frequency ends there, and says so") {
  // Through an internal resonance: the fundamental vanishes, and what remains is mode 2, stuck.
  const scene::Scene s = random_scenes::make(1, random_scenes::Excitation::first);
  const ResponseBranch branch = mode(s, 1, 1e-7, 1e-1);
  CHECK(branch.status == observables::Status::failed);
  CHECK(branch.stop.reason == observables::reasons::step_too_small);
  check_contains(branch.stop.message, "the motion came to be one of 3 times the frequency, of another mode");
  const ResponsePoint second = mode(s, 2, 1e-7, 1e-6).points.front(), last = branch.points.back();
  CHECK(3 * last.omega == Approx(second.omega).epsilon(1e-8));
  CHECK(last.damping_ratio == Approx(3 * second.damping_ratio).epsilon(1e-6));  // of 2 zeta omega M
}

TEST_CASE("random structures: most modes are whole, and what they lose is what the negative damping gives") {
  using random_scenes::Excitation;
  int branches = 0, complete = 0;
  for (std::uint64_t seed = 0; seed < 25; ++seed)
    for (const scene::Scene& s : {random_scenes::make(seed, Excitation::first),
                                  random_scenes::make(seed, Excitation::first_and_second),
                                  random_scenes::hard(seed), random_scenes::make_hardening(seed)})
      for (int number = 1; number <= std::min(3, static_cast<int>(s.dofs.size())); ++number) {
        const ResponseBranch branch = mode(s, number, 1e-7, 1e-1);
        CAPTURE(seed, number, s.dofs.size(), branch.stop.message, branch.points.size());
        ++branches;
        const bool whole = branch.status == observables::Status::complete;
        complete += whole ? 1 : 0;
        // Others end at another mode, or where the response has a sharp corner.
        CHECK((whole || branch.stop.reason == observables::reasons::step_too_small));
        double worst = 0;
        for (const ResponsePoint& point : branch.points)
          worst = std::max(worst, std::abs(point.energy_input - point.energy_total()) /
                                      (std::abs(point.energy_total()) + 1e-9 * point.energy));
        CHECK(worst < 1e-7);
      }
  CHECK(branches > 200);
  CHECK(complete >= 0.97 * branches);
}
