#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/studies/presentation/figures.hpp>
#include <arcslip/studies/presentation/motions.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <array>
#include <limits>
#include <string>

namespace arcslip::studies {
namespace {

using observables::Motion;
using observables::TimeMethod;
using observables::TimeSettings;
using scene::file::Reading;

constexpr std::array methods = {TimeMethod::shooting, TimeMethod::newmark_shooting, TimeMethod::newmark,
                                TimeMethod::event_driven};

std::vector<scene::file::Word<TimeMethod>> time_method_words() {
  std::vector<scene::file::Word<TimeMethod>> words;
  for (const TimeMethod method : methods) words.push_back({name(method), method});
  return words;
}

void check_start(const Reading& reading, const TimeSettings& time) {
  if (time.perturbation == TimeSettings{}.perturbation) return;
  const auto fault = [&](const char* why) {
    reading.faults.add(reading.keys.find("perturbation").pointer, std::string("found next to ") + why);
  };
  if (time.start_amplitude == 0)
    fault("no \"start\", must be with one: a transient from rest is not disturbed");
  else if (time.method == TimeMethod::shooting || time.method == TimeMethod::newmark_shooting)
    fault("a method of shooting, must be with \"newmark\" or \"event-driven\"");
}

void check_history(const Reading& reading, TimeSettings& time) {
  const double instants = static_cast<double>(time.steps) * time.recorded;
  if (instants > most_steps)
    reading.faults.add(reading.keys.find(reading.keys.has("recorded") ? "recorded" : "steps").pointer,
                       "found " + std::to_string(time.recorded) + " periods of " +
                           std::to_string(time.steps) + " steps to record, must be at most " +
                           std::to_string(most_steps) + " steps together");
}

scene::file::KeysOf<TimeSettings> keys_of_time() {
  using namespace scene::file;
  KeysOf<TimeSettings> keys;
  keys.add(one_frequency(&TimeSettings::frequency, "the excitation frequency"));
  keys.add(word("method", &TimeSettings::method, time_method_words(),
                "shooting (the periodic motion, exact for piecewise linear scenes), newmark-shooting, or a "
                "transient from rest: newmark, event-driven"));
  keys.add(whole("steps", &TimeSettings::steps, 1, most_steps, "steps per period of the motion"));
  keys.add(
      whole("periods", &TimeSettings::periods, 1, most_periods, "maximum number of periods of a transient"));
  keys.add(
      whole("recorded", &TimeSettings::recorded, 1, most_periods, "number of periods recorded, at the end"));
  keys.add(number(&TimeSettings::tolerance, {.name = "tolerance", .unit = "-", .lower = 0, .upper = 1},
                  "relative tolerance of the state: its change over a period in steady state, or the last "
                  "correction of shooting; 0: a transient runs for all of its periods"));
  keys.add(number(
      &TimeSettings::start_amplitude,
      {.name = "start", .unit = "m", .lower = 0, .upper = std::numeric_limits<double>::infinity()},
      "amplitude: start at the response of harmonic balance whose amplitude is nearest to it; 0: from rest"));
  keys.add(number(&TimeSettings::perturbation, {.name = "perturbation", .unit = "-", .lower = 0, .upper = 1},
                  "with a \"start\", of a transient: size of the initial disturbance, relative to the state, "
                  "in the direction of the largest multiplier"));
  keys.check([](const Reading& reading, TimeSettings& time) {
    check_history(reading, time);
    check_start(reading, time);
  });
  return keys;
}

std::unique_ptr<Computation> computed_motion(const scene::Scene& scene, const TimeSettings& settings,
                                             const RunOptions& options) {
  return std::make_unique<ComputationOf<Motion>>(
      motions(scene, options),
      [&settings](const Case& at, const control::Control& control) {
        return std::vector{observables::motion_in_time(at.scene, settings, control)};
      },
      [&scene](std::span<const Motion> motions) { return std::vector{figures_of(scene, motions)}; });
}

}  // namespace

const StudyKind& time() {
  static const StudyKind kind(
      {.name = "time",
       .help =
           "time integration at one frequency: steady state or transient from rest, with hysteresis loops",
       .coefficients = false},
      keys_of_time(), computed_motion);
  return kind;
}

}  // namespace arcslip::studies
