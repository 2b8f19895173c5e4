#include "catalogue.hpp"
#include "catch.hpp"
#include "controls.hpp"
#include "environment.hpp"
#include "lib/analyses/responses/reference.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <cmath>
#include <sstream>

using namespace arcslip;
using observables::Motion;
using observables::motion_in_time;
using observables::Status;
using observables::TimeMethod;
using observables::TimeSettings;

namespace {

scene::Scene example(const std::string& name) {
  return scene::read_file(source_folder() + "/examples/" + name + "/scene.json", test_catalogue::whole());
}

TimeSettings at(double frequency, TimeMethod method = TimeMethod::shooting, int steps = 200) {
  return {.frequency = frequency, .method = method, .steps = steps};
}

scene::Scene paper_at(double normal_load, double damping = 0.134) {
  scene::Scene scene = example("al_sayed_2011");
  scene::set(scene, "damper.normal_load", normal_load);
  scene::set(scene, "c.value", damping);
  return scene;
}

/// A mass, and behind a spring a massless point with a friction damper and a cubic spring.
scene::Scene massless(double cubic) {
  std::istringstream text(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["mass", "tip"], "masses": [{"name": "m", "at": "mass", "value": 1}],
      "springs": [{"name": "k", "at": "mass", "value": 1}, {"name": "arm", "between": ["mass", "tip"], "value": 2}],
      "dampers": [{"name": "c", "at": "mass", "value": 0.1}]},
    "elements": [{"name": "damper", "type": "jenkins", "at": "tip", "stiffness": 1, "friction_coefficient": 0.5,
                  "normal_load": 1}, {"name": "cubic", "type": "cubic_spring", "at": "tip", "stiffness": 0}],
    "excitation": [{"name": "force", "at": "mass", "harmonic": 1, "cosine": 1}], "harmonics": {"order": 151}, "response": {"at": "mass"}})");
  scene::Scene scene = scene::read(text, test_catalogue::whole());
  scene::set(scene, "cubic.stiffness", cubic);
  return scene;
}

double by_harmonic_balance(const scene::Scene& scene, double frequency) {
  return observables::frequency_response(scene, {frequency, frequency * 1.001}).at(0).points.at(0).amplitude;
}

}  // namespace

TEST_CASE("a study in time gives the exact motions of the paper's oscillator by default") {
  for (const auto& entry : reference::exact("fixed_frequency")) {
    const double hertz = entry["frequency_hz"], load = entry["normal_load"];
    CAPTURE(hertz, load);
    const Motion motion = motion_in_time(paper_at(load), at(hertz));
    CHECK(motion.status == Status::complete);
    CHECK(motion.stop.reason == observables::reasons::periodic);
    CHECK(motion.integrator == "event-driven");
    CHECK(reference::error(motion.amplitude, entry["amplitude"]) < 1e-10);
    CHECK(std::abs(motion.elements.at(0).stick_percent - entry["stick_percent"].get<double>()) < 1e-6);
    CHECK(std::abs(motion.energy.friction - entry["energy_friction"].get<double>()) < 1e-12);
    CHECK(std::abs(motion.energy.defect()) < 1e-12 * motion.energy.input);
    CHECK(motion.stable == true);
    CHECK(motion.multipliers.size() == (entry["state"] == "stick" ? 2u : 3u));
    CHECK(motion.history.time.size() == 201);
    CHECK(std::abs(motion.history.displacement.front() - motion.history.displacement.back()) <
          1e-9 * motion.amplitude);
  }
}

TEST_CASE("shooting in Newmark's steps gives what Newmark's transient comes to") {
  for (const double load : {1.0, 3.0}) {
    const Motion shot = motion_in_time(paper_at(load), at(20, TimeMethod::newmark_shooting));
    TimeSettings settings = at(20, TimeMethod::newmark);
    settings.tolerance = 1e-12;
    const Motion marched = motion_in_time(paper_at(load), settings);
    CHECK(shot.stop.reason == observables::reasons::periodic);
    CHECK(marched.stop.reason == observables::reasons::steady);
    CHECK(reference::error(shot.amplitude, marched.amplitude) < 1e-10);
    CHECK(shot.periods < 40);
    CHECK(marched.periods > 100);
  }
  // full stick with hardly any damping: a transient takes 7000 periods
  const Motion stuck = motion_in_time(paper_at(500), at(20.9, TimeMethod::newmark_shooting, 1000));
  CHECK(stuck.status == Status::complete);
  CHECK(stuck.multipliers.size() == 2);
  CHECK(std::abs(stuck.multipliers[0]) ==
        Approx(std::exp(-0.134 / (2 * 1.24) / 20.9)).epsilon(1e-6));  // e^(-c T/2 m)
}

TEST_CASE("the Duffing oscillator in time is that of harmonic balance with many harmonics") {
  scene::Scene scene = example("duffing");
  scene.harmonics.order = 31;
  const double balance = by_harmonic_balance(scene, 0.9);
  double last = 0;
  for (const int steps : {250, 500, 1000}) {
    const Motion motion = motion_in_time(scene, at(0.9, TimeMethod::shooting, steps));
    CHECK(motion.integrator == "newmark");
    CHECK(motion.status == Status::complete);
    const double error = reference::error(motion.amplitude, balance);
    if (last > 0) CHECK(last / error == Approx(4).epsilon(0.05));
    last = error;
  }
  CHECK(last < 2e-5);
}

TEST_CASE("a massless degree of freedom with friction in time is that of harmonic balance") {
  for (const double cubic : {0.0, 0.7}) {
    CAPTURE(cubic);
    const scene::Scene scene = massless(cubic);
    const double balance = by_harmonic_balance(scene, 1.4);
    const Motion motion = motion_in_time(scene, at(1.4, TimeMethod::shooting, 4000));
    CHECK(motion.integrator == "newmark");
    CHECK(motion.status == Status::complete);
    CHECK(motion.elements.at(0).stick_percent < 100);
    CHECK(reference::error(motion.amplitude, balance) < 100.0 / (4000.0 * 4000.0));
  }
  const Motion refused = motion_in_time(massless(0), at(1.4, TimeMethod::event_driven));
  CHECK(refused.status == Status::failed);
  CHECK(refused.stop.reason == observables::reasons::massless);
  CHECK(refused.stop.message.find("use the method newmark") != std::string::npos);
  const Motion cubic = motion_in_time(massless(0.7), at(1.4, TimeMethod::event_driven));
  CHECK(cubic.stop.reason == observables::reasons::not_piecewise_linear);
}

TEST_CASE("a contact too stiff for exact events is left to Newmark's steps", "[numbers]") {
  scene::Scene scene = paper_at(0.3);
  scene::set(scene, "damper.stiffness", 1e16);
  const Motion motion = motion_in_time(scene, at(18));
  CHECK(motion.status == Status::complete);
  CHECK(motion.integrator == "newmark");
}

TEST_CASE("where no motion is bounded none is found, and that is said") {
  // below pi f0/4 slip does not bound the undamped resonance
  const double resonance = std::sqrt(17890 / 1.24) / (2 * std::acos(-1.0));
  scene::Scene scene = paper_at(1, 0);
  for (const auto method : {TimeMethod::shooting, TimeMethod::newmark_shooting}) {
    const Motion motion = motion_in_time(scene, at(resonance, method));
    CHECK(motion.status == Status::failed);
    CHECK(motion.stop.reason == observables::reasons::unbounded);
    CHECK_FALSE(motion.stop.message.empty());
    CHECK(motion.history.time.size() == 201);
  }
  scene::set(scene, "k.value", -20000);  // softer than its damper can hold
  const Motion runaway = motion_in_time(scene, at(20, TimeMethod::newmark));
  CHECK(runaway.status == Status::failed);
  CHECK(runaway.stop.reason == observables::reasons::not_finite);
  CHECK(runaway.history.time.size() > 1);
}

TEST_CASE("a study in time has a motion for each combination, and a stop keeps what there is") {
  TimeSettings settings = at(20, TimeMethod::newmark, 50);
  const scene::ValueLists lists = {{"damper.normal_load", {1, 2, 3}}, {"c.value", {1, 2}}};
  const scene::Scene scene = example("al_sayed_2011");
  const auto motions = [&](const control::Control& control) {
    const auto compute = [&](const studies::Case& each, const control::Control& of_case) {
      return std::vector{motion_in_time(each.scene, settings, of_case)};
    };
    return studies::for_each<Motion>(scene, lists, compute, control);
  };
  const auto all = motions({});
  REQUIRE(all.size() == 6);
  CHECK(all[3].set == std::vector<std::pair<std::string, double>>{{"damper.normal_load", 2}, {"c.value", 2}});
  CHECK(all[3].parameters.front().first == "m.value");
  long reported = 0;
  const auto some = motions(controls::reporting([&](const control::Progress& progress) {
    CHECK(std::string(progress.item) == "motion");
    CHECK(progress.branches == 6);
    CHECK(progress.share_done <= 1);
    ++reported;
    return progress.branch < 1 || progress.points < 5;
  }));
  REQUIRE(some.size() == 2);
  CHECK(some[0].status == Status::complete);
  CHECK(some[1].status == Status::stopped);
  CHECK(some[1].stop.reason == observables::reasons::user);
  CHECK(some[1].periods == 6);
  CHECK(reported > 6);
  for (const auto method : {TimeMethod::shooting, TimeMethod::newmark_shooting, TimeMethod::event_driven}) {
    settings.method = method;
    const auto none = motions(controls::stopped());
    REQUIRE(none.size() == 1);
    CHECK(none[0].stop.reason == observables::reasons::user);
  }
}
