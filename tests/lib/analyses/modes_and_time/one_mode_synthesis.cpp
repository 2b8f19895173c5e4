// Forced responses next to a nonlinear mode.
#include "lib/analyses/modes_and_time/modes.hpp"

#include <arcslip/results/event_kinds.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace modes;

namespace {

std::vector<observables::ResponseEvent> peaks_of(const ResponseBranch& branch) {
  std::vector<observables::ResponseEvent> found;
  std::copy_if(branch.events.begin(), branch.events.end(), std::back_inserter(found),
               [](const auto& event) { return event.kind == observables::event_kinds::peak; });
  return found;
}

// A contact that sticks at all amplitudes below 1e6.
constexpr const char* stuck =
    R"({"name": "d", "type": "jenkins", "at": "x", "stiffness": 0.25, "friction_coefficient": 1,
        "normal_load": 1e6})";

}  // namespace

TEST_CASE(
    "next to a linear mode the response, its peak and the level of each peak are those of the structure") {
  const double c = 0.3, k = 1.25, omega = std::sqrt(k), zeta = c / (2 * omega);
  const ResponseBranch branch =
      observables::nonlinear_modes(oscillator(stuck, 3, c), {1, 1e-3, 1e2, 7}).front();
  at_end(branch, 1e2);
  const auto response = [&](double w) { return 1 / std::hypot(k - w * w, c * w); };
  const double highest = 1 / (2 * zeta * std::sqrt(1 - zeta * zeta) * k);
  int within = 0;
  for (const ResponsePoint& point : branch.points) {
    const auto& found = point.synthesis;
    CAPTURE(point.amplitude);
    CHECK(found.omega == Approx(omega * std::sqrt(1 - 2 * zeta * zeta)).epsilon(1e-12));
    CHECK(found.level == Approx(point.amplitude / highest).epsilon(1e-12));
    CHECK(std::isnan(found.above) == (point.amplitude > highest));
    CHECK(std::isnan(found.below) == (point.amplitude > highest || point.amplitude < 1 / k));
    for (const double w : {found.below, found.above})
      if (!std::isnan(w)) {
        CHECK(response(w) == Approx(point.amplitude).epsilon(1e-10));
        ++within;
      }
    CHECK(std::isnan(found.true_omega));
  }
  CHECK(within > 50);
  const auto peaks = peaks_of(branch);
  REQUIRE(peaks.size() == 7);
  for (std::size_t i = 0; i < 7; ++i) {
    const ResponsePoint& at = peaks[i].point;
    CHECK(at.amplitude == Approx(1e-3 * std::pow(1e5, static_cast<double>(i) / 6)).epsilon(1e-7));
    CHECK(at.synthesis.true_omega == Approx(at.synthesis.omega).epsilon(1e-9));
    CHECK(at.synthesis.true_amplitude == Approx(at.amplitude).epsilon(1e-12));
  }
}

TEST_CASE("with one harmonic the peaks of one mass with friction are those that its mode predicts") {
  // m = k = 1, kd = 0.25. The friction force is a cosine and a sine that depend on the amplitude A alone.
  // Without viscous damping the response peaks where the force balances the loss, f = 4 F (1 - a/A)/pi, F the
  // limit, a = F/kd.
  for (const double c : {0.0, 0.05, 0.4})
    for (const double load : {0.4, 0.2, 0.1}) {
      const std::string damper =
          R"({"name": "d", "type": "jenkins", "at": "x", "stiffness": 0.25, "friction_coefficient": 0.5,
            "normal_load": )" +
          std::to_string(load) + "}";
      const ResponseBranch branch =
          observables::nonlinear_modes(oscillator(damper, 1, c), {1, 0.1, 2.1, 9}).front();
      const double limit = 0.5 * load, onset = 4 * limit, share = 4 * limit / std::numbers::pi;
      std::size_t slipping = 0;
      for (const auto& event : peaks_of(branch)) {
        const ResponsePoint& at = event.point;
        CAPTURE(c, load, at.amplitude, at.damping_ratio);
        CHECK(at.synthesis.true_amplitude == Approx(at.amplitude).epsilon(1e-9));
        CHECK(at.synthesis.true_omega == Approx(at.synthesis.omega).epsilon(1e-8));
        if (at.elements[0].stick_percent == 100) continue;
        ++slipping;
        if (c > 0) continue;
        CHECK(at.synthesis.level == Approx(share * (1 - onset / at.amplitude)).epsilon(1e-11));
        CHECK(at.synthesis.omega == Approx(at.omega).epsilon(1e-14));
      }
      CHECK(slipping >= 3);
    }
}

TEST_CASE("a loss factor and viscous damping move a peak as in the response in closed form") {
  // |1.25 - W^2 + i (0.1 + c W)| is least where W^3 - (1.25 - c^2/2) W + 0.1 c/2 = 0.
  for (const double c : {0.0, 0.2}) {
    scene::Scene s = oscillator(stuck, 1, c);
    scene::Part steel;
    steel.name = "steel";
    steel.type = &scene::loss_factor_type();
    steel.values = {0.1};
    s.damping = {steel};
    const ResponseBranch branch = observables::nonlinear_modes(s, {1, 1e-3, 100, 2}).front();
    CHECK(branch.points.size() > 20);
    for (const ResponsePoint& point : branch.points) {
      const double w = point.synthesis.omega;
      CHECK(std::abs(w * w * w - (1.25 - c * c / 2) * w + 0.05 * c) < 1e-12);
      const double highest = 1 / std::hypot(1.25 - w * w, 0.1 + c * w);
      CHECK(point.synthesis.level == Approx(point.amplitude / highest).epsilon(1e-11));
      for (const double at : {point.synthesis.below, point.synthesis.above})
        if (!std::isnan(at))
          CHECK(std::hypot(1.25 - at * at, 0.1 + c * at) * point.amplitude == Approx(1).epsilon(1e-11));
    }
    for (const auto& event : peaks_of(branch))
      CHECK(event.point.synthesis.true_omega == Approx(event.point.synthesis.omega).epsilon(1e-9));
  }
}

TEST_CASE("a mode has no forced response next to it where the excitation does not drive its fundamental") {
  const std::string contact =
      R"({"name": "d", "type": "jenkins", "between": ["x1", "x2"], "stiffness": 0.25, "friction_coefficient": 1,
          "normal_load": 1}, {"name": "s", "type": "cubic_spring", "at": "x1", "stiffness": 1e-9},
         {"name": "t", "type": "cubic_spring", "at": "x2", "stiffness": 1e-9})";
  std::string even = two_masses(contact, 3, "x1");
  const std::string one = R"("at": "x1", "cosine")";
  even.replace(even.find(one), one.size(), R"("direction": {"x1": 1, "x2": 1}, "cosine")");
  const auto out_of_phase = observables::nonlinear_modes(parse(even), {2, 1e-3, 10, 3}).front();
  CHECK(out_of_phase.points.size() > 10);
  CHECK(peaks_of(out_of_phase).empty());
  for (const auto& point : out_of_phase.points) {
    CHECK(std::isnan(point.synthesis.level));
    CHECK(std::isnan(point.synthesis.above));
  }
  const auto higher = observables::nonlinear_modes(oscillator(stuck, 3, 0.1, R"("harmonic": 3, "cosine": 1)"),
                                                   {1, 1e-3, 1, 3})
                          .front();
  CHECK(higher.points.size() > 10);
  CHECK(peaks_of(higher).empty());
  CHECK(std::isnan(higher.points.front().synthesis.level));
}

TEST_CASE("next to an undamped mode the level is 0, and the response opens around it") {
  const ResponseBranch branch = mode(oscillator(cubic, 1), 1, 0.5, 5);
  for (const ResponsePoint& point : branch.points) {
    const double A = point.amplitude, square = 1 + 0.75 * A * A;
    CHECK(std::abs(point.synthesis.level) < 1e-13);
    // (1 + 3/4 A^2 - W^2) A = +-1, the Duffing equation in one harmonic
    CHECK(point.synthesis.above == Approx(std::sqrt(square + 1 / A)).epsilon(1e-12));
    if (square > 1 / A)
      CHECK(point.synthesis.below == Approx(std::sqrt(square - 1 / A)).epsilon(1e-12));
    else
      CHECK(std::isnan(point.synthesis.below));
  }
}

TEST_CASE("the peaks of the paper's oscillator lie next to those of its mode") {
  const scene::Scene s = scenes::paper(15);
  const double onset = onset_of_slip(s);
  const ResponseBranch branch = observables::nonlinear_modes(s, {1, 0.5 * onset, 50 * onset, 20}).front();
  const auto peaks = peaks_of(branch);
  REQUIRE(peaks.size() == 20);
  for (const auto& event : peaks) {
    const auto& found = event.point.synthesis;
    CAPTURE(event.point.amplitude / onset, event.point.damping_ratio);
    CHECK(found.true_omega == Approx(found.omega).epsilon(2e-3));
    CHECK(found.true_amplitude == Approx(event.point.amplitude).epsilon(2e-2));
  }
}
