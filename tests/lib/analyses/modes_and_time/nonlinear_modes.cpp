// Nonlinear modes against closed forms and published numbers.
#include "lib/analyses/modes_and_time/modes.hpp"

#include <arcslip/model/model.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

using namespace modes;

namespace {

// omega of x'' + x + x^3 = 0 at the amplitude A: pi sqrt(1 + A^2) / (2 K(m)), m = A^2/(2 (1 + A^2)).
double duffing(double A) {
  const double m = A * A / (2 * (1 + A * A));
  return std::numbers::pi * std::sqrt(1 + A * A) / (2 * std::comp_ellint_1(std::sqrt(m)));
}

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

ClosedForm closed_form(const scene::Scene& s) {
  return {value_of(s, "m.value"), value_of(s, "k.value"), value_of(s, "c.value"),
          value_of(s, "damper.stiffness"),
          value_of(s, "damper.friction_coefficient") * value_of(s, "damper.normal_load")};
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
  // At x = 0 the contact slips at its limit.
  CHECK(last.energy == Approx(0.5 * 4 * last.omega * last.omega + 0.5 * 0.2 * 0.2 / 0.25).epsilon(1e-11));
}

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
      oscillator(cubic, 9, 0.1, R"("harmonic": 0, "cosine": 2}, {"name": "g", "at": "x", "cosine": 1)");
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

TEST_CASE(
    "damping at rest that changes the mode: the modes of a regularised friction begin at those of its "
    "damper") {
  // tanh friction of 5 N and 0.05 m/s is a damper of 100 N s/m for a small motion, 100 times critical for its
  // mass.
  const auto scene = [](const std::string& element) {
    return parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"dofs": ["a", "b"],
      "masses": [{"name": "ma", "at": "a", "value": 0.02}, {"name": "mb", "at": "b", "value": 1}],
      "springs": [{"name": "k2", "between": ["a", "b"], "value": 40}, {"name": "k3", "at": "b", "value": 600}]},
      "elements": [)" +
                 element + R"(], "excitation": [{"name": "f", "at": "b", "cosine": 1}],
      "harmonics": {"order": 21}, "response": {"at": "b"}})");
  };
  const scene::Scene friction = scene(R"({"name": "fr", "type": "tanh_friction", "at": "a",
    "friction_coefficient": 1, "normal_load": 5, "reference_velocity": 0.05})");
  const ResponseBranch branch = mode(friction, 1, 1e-6, 0.03);
  const ResponsePoint last = at_end(branch, 0.03), first = branch.points.front();
  // (K + i w C) v = w^2 (1 + 2 i zeta) M v: of two masses a quadratic equation in mu = w^2 (1 + 2 i zeta).
  double w = 25;
  std::complex<double> mu;
  for (int k = 0; k < 200; ++k) {
    const std::complex<double> a(40, 100 * w);
    // 0.02 mu^2 - (a + 0.02 640) mu + 640 a - 1600 = 0
    const std::complex<double> b = a + 12.8, c = 640.0 * a - 1600.0;
    mu = 2.0 * c / (b + std::sqrt(b * b - 0.08 * c));
    w = std::sqrt(mu.real());
  }
  CHECK(first.omega == Approx(w).epsilon(1e-9));
  CHECK(first.damping_ratio == Approx(0.5 * mu.imag() / mu.real()).epsilon(1e-6));
  CHECK(last.omega == Approx(25.298083).epsilon(1e-8));  // shooting
  CHECK(last.damping_ratio == Approx(5.0138e-4).epsilon(1e-4));
}
