// Disturbed motions in time next to the multipliers of harmonic balance. ARCSLIP_SCENES is the number of
// random structures; by default 12.
//
// The motion disturbed is the exact one next to the response: by shooting from the motion of 61 harmonics,
// since next to a fold shooting from that of 15 may lead to the motion on its other side.
#include "catch.hpp"
#include "controls.hpp"

#include "lib/hbm/random_scenes.hpp"
#include "lib/hbm/scenes.hpp"
#include "lib/observables/refined.hpp"
#include "lib/time/periodic/random_contacts.hpp"

#include <arcslip/analyses/modes_and_time/perturbed_transient.hpp>
#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/stability/state_from_harmonics.hpp>
#include <arcslip/time/event_driven/event_driven.hpp>
#include <arcslip/time/periodic/period_integrator.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

using namespace arcslip;
using observables::Motion;
using observables::motion_in_time;
using observables::Status;
using observables::TimeMethod;
using observables::TimeSettings;

namespace {

std::uint64_t scene_count() {
  if (const char* count = std::getenv("ARCSLIP_SCENES")) return std::strtoull(count, nullptr, 10);
  return 12;
}

// A chain with friction alone, with stops, with contacts, or with cubic springs.
scene::Scene random_scene(std::uint64_t seed) {
  using random_scenes::Excitation;
  scene::Scene s = seed % 4 == 3 ? random_scenes::make_hardening(seed)
                                 : random_scenes::make(
                                       seed, seed % 8 < 4 ? Excitation::first : Excitation::first_and_second);
  s.harmonics.order = 15;
  const double middle = 0.5 * (scenes::window(s).from + scenes::window(s).to);
  if (seed % 4 == 1) s = random_contacts::with_stops(s, seed, middle);
  if (seed % 4 == 2) s = random_contacts::with_contacts(s, seed, middle);
  return s;
}

}  // namespace

TEST_CASE("disturbances of random motions grow and decay at the rate of their largest multiplier",
          "[numbers]") {
  int compared = 0, unstable = 0, verdicts = 0, returned = 0, unknown = 0, wrong = 0;
  double worst = 0;
  for (std::uint64_t seed = 0; seed < scene_count(); ++seed) {
    const scene::Scene s = random_scene(seed);
    auto window = scenes::window(s);
    window.stability = true;
    const auto branches = observables::frequency_response(s, window);
    const auto& points = branches.front().points;
    REQUIRE_FALSE(points.empty());
    // Every other one unstable, where there are any.
    test_random::Random random(seed);
    std::vector<const observables::ResponsePoint*> all, of_interest;
    for (const auto& point : points) {
      if (!point.stability) continue;
      all.push_back(&point);
      if (point.stability->unstable > 0) of_interest.push_back(&point);
    }
    const auto& among = of_interest.empty() || seed % 8 >= 4 ? all : of_interest;
    REQUIRE_FALSE(among.empty());
    const auto& point = *among[static_cast<std::size_t>(random.count(0, static_cast<int>(among.size()) - 1))];
    const double largest = std::abs(point.stability->multipliers.front()), error = point.stability->error;
    CAPTURE(seed, point.omega, point.amplitude, point.stability->multipliers, error);
    const auto model = std::make_shared<const model::Model>(model::build(s));
    const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
    const auto p = hbm::parameters_at(problem, point.omega);
    const auto exact = refined::motion(problem, refined::solution_of(point), p, refined::orders);
    if (!exact) {
      ++unknown;
      continue;
    }
    const auto start = time::state_of(*exact->problem, exact->u, p);
    const auto equation = time::equation_of_motion(*model, p);
    const bool in_steps = seed % 4 == 3;
    const auto integrator = in_steps ? observables::in_steps(equation, start, 8000, {})
                                     : observables::between_events(equation, start, 100, {});
    const auto found = observables::departure(integrator, integrator.start, point.omega, 1e-5,
                                              {.periods = 400, .longest = 8, .tolerance = 1e-9});
    CAPTURE(found.failure, found.growth, found.returned, found.distance, found.end.message);
    if (!found.failure.empty()) {
      ++unknown;
      continue;
    }
    ++compared;
    unstable += largest > 1;
    const double witness = in_steps ? 3e-4 : 1e-5;  // error of the growth
    CHECK(std::abs(found.growth - largest) < 5 * error + witness);
    worst = std::max(worst, std::abs(found.growth - largest) / (5 * error + witness));
    if (std::abs(largest - 1) > error + witness) {
      ++verdicts;
      const bool right = (found.growth > 1) == (point.stability->unstable > 0) &&
                         !(point.stability->unstable > 0 && found.returned) &&
                         !(largest < 0.95 && !found.returned);
      CHECK(right);
      wrong += !right;
      returned += found.returned;
    }
  }
  INFO(compared << " compared, " << unstable << " unstable, " << verdicts << " verdicts, " << wrong
                << " wrong, " << returned << " returned, " << unknown << " without an exact motion, worst "
                << worst);
  CHECK(unknown <= static_cast<int>(scene_count()) / 20);
  CHECK(unstable > compared / 10);
}

namespace {

scene::Scene duffing() {
  scene::Scene s = scenes::example("duffing");
  s.harmonics.order = 21;
  return s;
}

}  // namespace

TEST_CASE(
    "a motion next to the unstable response of a Duffing oscillator leaves it at its rate for a stable one") {
  // Three responses at 1.2 rad/s, the middle one unstable.
  const auto s = duffing();
  const auto branches = observables::frequency_response(s, {1.0, 1.4, true});
  std::vector<double> amplitudes;
  double multiplier = 0;
  const auto& points = branches.at(0).points;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if ((points[i - 1].omega < 1.2) == (points[i].omega < 1.2)) continue;
    amplitudes.push_back(points[i].amplitude);
    if (points[i].stability->unstable > 0) multiplier = std::abs(points[i].stability->multipliers.front());
  }
  REQUIRE(amplitudes.size() == 3);
  std::sort(amplitudes.begin(), amplitudes.end());
  REQUIRE(multiplier > 1);
  for (std::size_t i = 0; i < 3; ++i) {
    const Motion motion = motion_in_time(s, {.frequency = 1.2,
                                             .method = TimeMethod::newmark,
                                             .start_amplitude = 1.01 * amplitudes[i],
                                             .perturbation = 1e-5});
    CAPTURE(i, motion.stop.message);
    REQUIRE(motion.status == Status::complete);
    CHECK(motion.stop.reason == observables::reasons::steady);
    REQUIRE(motion.departure);
    const auto& found = *motion.departure;
    CHECK(std::abs(found.response_amplitude - amplitudes[i]) < 0.02 * amplitudes[i]);
    CHECK(std::abs(found.growth - found.largest_multiplier) < 1e-4);
    CHECK(found.motion_period == 1);
    CHECK(found.returned == (i != 1));
    CHECK(found.unstable == (i == 1 ? 1 : 0));
    CHECK((found.distance < 1e-6) == found.returned);
    CHECK(motion.stable == true);
    if (i != 1)
      CHECK(std::abs(motion.amplitude - found.response_amplitude) < 1e-4 * motion.amplitude);
    else
      CHECK(std::min(std::abs(motion.amplitude - amplitudes[0]), std::abs(motion.amplitude - amplitudes[2])) <
            0.02 * amplitudes[2]);
  }
}

TEST_CASE("shooting from a response finds the unstable motion, too") {
  const Motion motion = motion_in_time(duffing(), {.frequency = 1.2, .start_amplitude = 1.6});
  REQUIRE(motion.status == Status::complete);
  CHECK(motion.stable == false);
  CHECK_FALSE(motion.departure);
}

TEST_CASE("two masses and a stop leave their unstable motion for one of twice the period") {
  auto s = scenes::example("unilateral_oscillator");
  s.harmonics.order = 60;
  const Motion motion = motion_in_time(
      s,
      {.frequency = 0.745, .method = TimeMethod::event_driven, .start_amplitude = 1.8, .perturbation = 1e-4});
  CAPTURE(motion.stop.message);
  REQUIRE(motion.departure);
  CHECK_FALSE(motion.departure->returned);
  CHECK(motion.departure->unstable == 1);
  CHECK(motion.departure->motion_period == 2);
  CHECK(motion.departure->growth > 1);
  CHECK(motion.history.time.size() == 2001);
}

TEST_CASE("the growth of a disturbance is that of a known linear map") {
  const auto course = [](double r, double angle, int count) {
    time::Matrix M(2, 2), d(2, count);
    M << r * std::cos(angle), -r * std::sin(angle) * 3, r * std::sin(angle) / 3, r * std::cos(angle);
    d.col(0) << 1, 0.2;
    for (int k = 1; k < count; ++k) d.col(k) = M * d.col(k - 1);
    return d;
  };
  for (const double r : {0.5, 0.99, 1.1})
    for (const double angle : {0.0, 0.7, 3.0, std::acos(-1.0)}) {
      CAPTURE(r, angle);
      CHECK(observables::growth_of(course(r, angle, 12)) == Approx(r).epsilon(1e-12));
    }
  CHECK(observables::growth_of(course(0.5, 0, 2)) == Approx(0.5));
  CHECK(observables::growth_of(course(0.5, 0, 1)) == 0);
}

TEST_CASE("a start where there is no response is refused, and a stop is reported") {
  scene::Scene s = scenes::paper(5, 1);
  scene::set(s, "c.value", 0);
  const double resonance = std::sqrt(17890 / 1.24) / scenes::hertz;
  TimeSettings settings{.frequency = resonance, .method = TimeMethod::event_driven, .start_amplitude = 1};
  const Motion none = motion_in_time(s, settings);
  CHECK(none.status == Status::failed);
  CHECK(none.stop.reason == observables::reasons::start_failed);
  settings.frequency = 20;
  const Motion stopped = motion_in_time(s, settings, controls::stopped());
  CHECK(stopped.status == Status::stopped);
  CHECK(stopped.stop.reason == observables::reasons::user);
}
