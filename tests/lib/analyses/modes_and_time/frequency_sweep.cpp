// Sweeps of the frequency next to closed forms and next to the folds of harmonic balance.
#include "catch.hpp"
#include "controls.hpp"

#include "lib/analyses/responses/reference.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/modes_and_time/frequency_sweep.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <cmath>

using namespace arcslip;
using observables::frequency_sweep;
using observables::FrequencySweep;
using observables::Status;
using observables::SweepDirection;
using observables::SweepPoint;
using observables::SweepSettings;

namespace {

scene::Scene oscillator(const std::string& elements, double c, double force,
                        const std::string& more_forces = "") {
  scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 1}]},
    "elements": [)" + elements + R"(],
    "excitation": [{"name": "f", "at": "x", "cosine": 1})" +
                                 more_forces + R"(], "response": {"at": "x"}})");
  scene::set(s, "c.value", c);
  scene::set(s, "f.cosine", force);
  return s;
}

const std::string cubic = R"({"name": "s", "type": "cubic_spring", "at": "x", "stiffness": 0.1})";

std::vector<observables::ResponseEvent> folds(const scene::Scene& s, double from, double to) {
  const auto branches = observables::frequency_response(s, {from, to});
  REQUIRE(branches.size() == 1);
  std::vector<observables::ResponseEvent> found;
  for (const auto& event : branches[0].events)
    if (event.kind == "fold") found.push_back(event);
  return found;
}

void check_settled(const FrequencySweep& sweep) {
  CHECK(sweep.status == Status::complete);
  CHECK(sweep.stop.reason == observables::reasons::swept);
  for (const SweepPoint& point : sweep.points) {
    CAPTURE(name(sweep.direction), point.omega, point.periods);
    CHECK(point.settled);
    CHECK(point.period == 1);
  }
}

// An upward sweep jumps at the upper fold, a downward one at the lower fold, each within some of the parts
// into which a step is divided.
void check_jumps_at(const std::vector<FrequencySweep>& sweeps, double upper, double lower, double tolerance) {
  REQUIRE(sweeps.size() == 2);
  for (const FrequencySweep& sweep : sweeps) {
    check_settled(sweep);
    const bool up = sweep.direction == SweepDirection::up;
    const double fold = up ? upper : lower;
    CAPTURE(name(sweep.direction), fold);
    REQUIRE(sweep.jumps.size() == 1);
    const auto& jump = sweep.jumps[0];
    CAPTURE(jump.omega, jump.omega_after);
    CHECK_FALSE(jump.by_step);
    CHECK(std::abs(jump.omega - fold) < tolerance);
    CHECK(std::abs(jump.omega_after - fold) < tolerance);
    CHECK((jump.amplitude_after < jump.amplitude) == up);
    const SweepPoint &before = sweep.points.at(jump.after), &after = sweep.points.at(jump.after + 1);
    CHECK((up ? before.omega <= jump.omega && jump.omega < jump.omega_after && jump.omega_after <= after.omega
              : before.omega >= jump.omega && jump.omega > jump.omega_after &&
                    jump.omega_after >= after.omega));
  }
}

}  // namespace

TEST_CASE("the sweep of a linear oscillator is its frequency response, also with hardly any damping") {
  for (const double c : {0.1, 1e-5}) {
    CAPTURE(c);
    const auto sweeps = frequency_sweep(oscillator("", c, 0.3), {.from = 0.5, .to = 1.5, .points = 52});
    REQUIRE(sweeps.size() == 2);
    CHECK(sweeps[0].direction == SweepDirection::up);
    CHECK(sweeps[1].direction == SweepDirection::down);
    CHECK(sweeps[0].parent == 0);
    CHECK(sweeps[1].parent == 1);
    for (const FrequencySweep& sweep : sweeps) {
      check_settled(sweep);
      CHECK(sweep.integrator == "event-driven");
      CHECK(sweep.jumps.empty());
      REQUIRE(sweep.points.size() == 52);
      for (std::size_t i = 0; i < sweep.points.size(); ++i) {
        const SweepPoint& point = sweep.points[i];
        const double share = static_cast<double>(i) / 51, w = point.omega;
        CHECK(w == Approx(sweep.direction == SweepDirection::up ? 0.5 + share : 1.5 - share).epsilon(1e-14));
        CHECK(reference::error(point.amplitude, 0.3 / std::hypot(1 - w * w, c * w)) < 1e-8);
        CHECK(point.largest_multiplier == Approx(std::exp(-c * std::acos(-1.0) / w)).epsilon(1e-9));
        CHECK(point.periods < 10);
      }
    }
  }
}

TEST_CASE("a spacing makes the fewest equal steps that are not larger") {
  const auto s = oscillator("", 0.1, 0.3);
  const auto count = [&](double spacing) {
    return frequency_sweep(s, {.from = 0.5, .to = 1.5, .spacing = spacing, .direction = SweepDirection::down})
        .at(0)
        .points.size();
  };
  CHECK(count(0.1) == 11);
  CHECK(count(0.0999) == 12);
  CHECK(count(5) == 2);
}

TEST_CASE("Duffing's oscillator jumps at its folds, up and down, to the parts of a step") {
  scene::Scene s = oscillator(cubic, 0.05, 0.18);
  s.harmonics.order = 21;
  const auto at = folds(s, 0.5, 1.6);
  REQUIRE(at.size() == 2);
  const auto sweeps = frequency_sweep(s, {.from = 1.0, .to = 1.4, .points = 17, .steps = 400});
  CHECK(sweeps[0].integrator == "newmark");
  // Newmark's steps move the folds by (w h)^2/12 = 2e-5, relatively.
  check_jumps_at(sweeps, at[0].point.omega, at[1].point.omega, 1e-4);
}

TEST_CASE("a bilinear oscillator jumps at its folds, up and down") {
  scene::Scene s = oscillator(
      R"({"name": "s", "type": "bilinear_spring", "at": "x", "stiffness": 0, "stiffness_beyond": 1, "corner": 1})",
      0.05, 0.15);
  s.harmonics.order = 41;
  const auto at = folds(s, 0.8, 1.8);
  REQUIRE(at.size() == 2);
  const auto sweeps = frequency_sweep(s, {.from = 0.9, .to = 1.6, .points = 71});
  CHECK(sweeps[0].integrator == "event-driven");
  check_jumps_at(sweeps, std::max(at[0].point.omega, at[1].point.omega),
                 std::min(at[0].point.omega, at[1].point.omega), 3e-4);
}

TEST_CASE("the paper's oscillator is the same up and down, and is that of harmonic balance") {
  scene::Scene s = scenes::paper(101);
  const auto sweeps = frequency_sweep(s, {.from = 18, .to = 22, .points = 21});
  REQUIRE(sweeps.size() == 2);
  for (const auto& sweep : sweeps) {
    check_settled(sweep);
    CHECK(sweep.jumps.empty());
  }
  const std::size_t last = sweeps[0].points.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const SweepPoint &up = sweeps[0].points[i], &down = sweeps[1].points[last - i];
    CAPTURE(up.omega);
    const auto balanced = scenes::response_at(s, up.omega / scenes::hertz);
    if (balanced.elements.at(0).stick_percent == 100) continue;  // offsets differ
    CHECK(reference::error(up.amplitude, down.amplitude) < 1e-9);
    CHECK(reference::error(up.amplitude, balanced.amplitude) < 1e-7);
  }
}

TEST_CASE("a slider that sticks keeps the place where the start from rest left it") {
  // Stuck, the oscillator is linear with k + k_d, about the mean k_d z/(k + k_d) of a slider at z. Starting
  // from rest it goes beyond its steady amplitude, which is within reach, and slips.
  const double kd = 0.5, limit = 0.1, c = 0.02, f = 0.2;
  const auto s = oscillator(
      R"({"name": "d", "type": "jenkins", "at": "x", "stiffness": 0.5, "friction_coefficient": 0.2, "normal_load": 0.5})",
      c, f);
  const auto sweeps = frequency_sweep(s, {.from = 1.7, .to = 2.4, .points = 15});
  REQUIRE(sweeps.size() == 2);
  const auto linear = [&](double w) { return f / std::hypot(1 + kd - w * w, c * w); };
  const double mean = sweeps[0].points[0].amplitude - linear(1.7);
  CHECK(mean > 0.01 * linear(1.7));
  CHECK(mean * (1 + kd) / kd <= limit / kd);
  for (const auto& sweep : sweeps) {
    check_settled(sweep);
    for (const SweepPoint& point : sweep.points) {
      CAPTURE(point.omega);
      CHECK(point.amplitude == Approx(linear(point.omega) + mean).epsilon(1e-8));
    }
  }
}

TEST_CASE("a sweep leaves motions that are unstable: two masses and a stop") {
  const auto s = scenes::example("unilateral_oscillator");
  const auto sweeps = frequency_sweep(s, {.from = 0.57, .to = 0.75, .spacing = 0.02, .periods = 300});
  REQUIRE(sweeps.size() == 2);
  for (const auto& sweep : sweeps) {
    CHECK(sweep.status == Status::complete);
    for (const SweepPoint& point : sweep.points) {
      CAPTURE(name(sweep.direction), point.omega, point.settled, point.period, point.amplitude);
      // NLvib: quasi-periodic from 0.5819 to 0.6186, period 2 from 0.7388 to 0.7556
      if (point.omega < 0.58) CHECK(point.period == 1);
      if (point.omega > 0.585 && point.omega < 0.615) CHECK(point.period != 1);
      if (point.omega > 0.655 && point.omega < 0.735) CHECK(point.period == 1);
      if (point.omega > 0.7395 && sweep.direction == SweepDirection::up) CHECK(point.period == 2);
      if (point.settled && !std::isnan(point.largest_multiplier)) CHECK(point.largest_multiplier < 1 + 1e-6);
    }
  }
}

TEST_CASE("where its symmetry breaks a motion is left for one of the two that are not symmetric") {
  scene::Scene s = oscillator(R"({"name": "s", "type": "cubic_spring", "at": "x", "stiffness": 1})", 0.1, 3);
  s.harmonics.order = 21;
  const auto branches = observables::frequency_response(s, {0.5, 1.5, true});
  std::vector<double> breaks;
  for (const auto& event : branches.at(0).events)
    if (event.kind == "symmetry_breaking") breaks.push_back(event.point.omega);
  REQUIRE(breaks.size() == 2);
  const double middle = 0.5 * (breaks[0] + breaks[1]);
  const auto at = [&](double w) {
    return frequency_sweep(s, {.from = w, .to = 1.0001 * w, .points = 2, .direction = SweepDirection::up})
        .at(0)
        .points;
  };
  for (const SweepPoint& point : at(middle)) {
    CAPTURE(point.omega, point.settled, point.period, point.largest_multiplier);
    const auto symmetric = scenes::response_at(s, point.omega);
    CHECK((!point.settled || std::abs(point.amplitude - symmetric.amplitude) > 1e-3 * symmetric.amplitude));
    if (point.settled) CHECK(point.largest_multiplier < 1);
  }
}

TEST_CASE("a step that is too large ends a motion before its fold, which is said") {
  const scene::Scene s = oscillator(cubic, 0.05, 0.18);  // its upper fold is at 1.2696
  const auto swept = [&](double from, int points) {
    return frequency_sweep(
               s,
               {.from = from, .to = 1.268, .points = points, .direction = SweepDirection::up, .steps = 400})
        .at(0);
  };
  const FrequencySweep fine = swept(1.1, 35);
  CHECK(fine.jumps.empty());
  CHECK(fine.points.back().amplitude > 2);
  const FrequencySweep coarse = swept(1.1, 3);
  CHECK(coarse.points.back().amplitude < 1);
  REQUIRE(coarse.jumps.size() == 1);
  CHECK(coarse.jumps[0].by_step);
  CHECK(coarse.jumps[0].omega == coarse.points[1].omega);
  CHECK(coarse.jumps[0].omega_after == coarse.points[2].omega);
}

TEST_CASE("a sweep that is stopped keeps its points, and one that cannot be integrated says why") {
  SweepSettings settings{.from = 18, .to = 22, .points = 21};
  const auto paper = scenes::paper(5);
  const auto stopped =
      frequency_sweep(paper, settings, controls::reporting([](const control::Progress& progress) {
                        CHECK(progress.share_done <= 1);
                        return progress.points < 7;
                      }));
  REQUIRE(stopped.size() == 1);
  CHECK(stopped[0].status == Status::stopped);
  CHECK(stopped[0].stop.reason == observables::reasons::user);
  CHECK(stopped[0].points.size() == 7);
  const auto none = frequency_sweep(paper, settings, controls::stopped());
  CHECK(none.at(0).points.empty());

  scene::Scene runaway = paper;
  scene::set(runaway, "k.value", -20000);
  const auto overflow = frequency_sweep(runaway, settings);
  REQUIRE(overflow.size() == 1);
  CHECK(overflow[0].status == Status::failed);
  CHECK(overflow[0].stop.reason == observables::reasons::not_finite);
}

TEST_CASE("a motion that does not settle within its periods says so") {
  const auto sweep =
      frequency_sweep(oscillator(cubic, 0.001, 0.18),
                      {.from = 0.9, .to = 0.91, .points = 2, .direction = SweepDirection::up, .periods = 3})
          .at(0);
  for (const auto& point : sweep.points) {
    CHECK_FALSE(point.settled);
    CHECK(point.period == 0);
    CHECK(point.periods == 3);
    CHECK(point.amplitude > 0);
  }
}
