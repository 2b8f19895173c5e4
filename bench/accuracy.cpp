// Speed for accuracy: one frequency response of the paper's oscillator, 18 to 22 Hz, in the ways there are.
//
//   accuracy/exact/H:N               harmonic balance with exact integrals
//   accuracy/sampled/H:N/samples:S   with friction sampled in time
//   accuracy/chosen/digits:K         with the order that a study chooses by an accuracy of 10^-K
//   accuracy/newmark/steps:S         periodic motions by shooting in so many steps a period, at every tenth
//                                    of 150 frequencies, each from the one before
//   accuracy/event_driven            the same, exact in time
//
// Harmonic balance has all observables at each point; in time there is nothing but the motion. Counters:
// points; error, of the amplitude at the resonance peak, relative to the closed-form solution
// (tests/reference/exact_1dof.json); estimate, the program's own of that error; order.

#include "measure.hpp"
#include "scenes.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/time/periodic/period_integrator.hpp>
#include <arcslip/time/periodic/shooting.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>
#include <vector>

namespace {

using namespace arcslip;

constexpr double exact_amplitude = 0.000884970009333055, exact_hertz = 19.9952846841786;
const observables::FrequencyRange range{18, 22};

double error_of(double amplitude) {
  return std::abs(amplitude / exact_amplitude - 1);
}

// Of the peaks of a sampled curve, which is slightly ragged, the nearest one counts.
void peak_error(benchmark::State& state, const scene::Scene& scene) {
  std::vector<observables::ResponseBranch> branches;
  bench::measure(state, [&] { branches = observables::frequency_response(scene, range); });
  double error = 1, estimate = 1;
  for (const auto& event : branches.front().events)
    if (error_of(event.point.amplitude) < error) {
      error = error_of(event.point.amplitude);
      estimate = event.point.truncation_estimate / event.point.amplitude;
    }
  state.counters["points"] = static_cast<double>(branches.front().points.size());
  state.counters["error"] = error;
  state.counters["estimate"] = estimate;
}

void exact(benchmark::State& state) {
  peak_error(state, bench::paper(static_cast<int>(state.range(0))));
}

void sampled(benchmark::State& state) {
  scene::Scene scene = bench::paper(static_cast<int>(state.range(0)));
  scene.harmonics.friction = scene::Friction::sampled;
  scene.harmonics.samples = static_cast<int>(state.range(1));
  peak_error(state, scene);
}

void chosen(benchmark::State& state) {
  scene::Scene scene = bench::paper(scene::largest_chosen_order);
  scene.harmonics.accuracy = std::pow(10, -static_cast<double>(state.range(0)));
  scene.studies = {{"response", &studies::frf(), scene::Settings::of(range), {}}};
  results::Results results;
  bench::measure(state, [&] { results = studies::run(scene); });
  std::stringstream text;
  results::write_json(text, results);
  const nlohmann::json branch = nlohmann::json::parse(text)["branches"][0];
  double error = 1;
  for (const auto& event : branch["events"]) error = std::min(error, error_of(event["amplitude"]));
  state.counters["points"] = static_cast<double>(branch["points"].size());
  state.counters["error"] = error;
  state.counters["estimate"] = branch["accuracy"]["error"].get<double>();
  state.counters["order"] = branch["accuracy"]["order"].get<double>();
}

using Begin = std::function<observables::Integrator(const time::EquationOfMotion&)>;

// Of every tenth frequency, from the motion at the one before it, which is not timed: Newmark's method takes
// minutes for all of them.
void motions(benchmark::State& state, const Begin& begin, const observables::TimeSettings& at_peak) {
  constexpr int points = 150, every = 10;
  const scene::Scene scene = bench::paper(1);
  const model::Model model = model::build(scene);
  continuation::Vector p = model::defaults(model);
  const auto motion_at = [&](int i, const time::MotionState* start) {
    p[model::frequency] = 2 * std::numbers::pi * (range.from + (range.to - range.from) * i / (points - 1));
    const auto integrator = begin(time::equation_of_motion(model, p));
    return time::shoot(integrator.flow, start ? *start : integrator.start, p[model::frequency],
                       {.transients = start ? 0 : 3});
  };
  bool converged = true;
  std::vector<time::ShootingResult> before;
  for (int i = every / 2; i < points; i += every) {
    before.push_back(motion_at(i - 1, nullptr));
    converged = converged && before.back().converged();
  }
  bench::measure(state, [&] {
    for (std::size_t k = 0; k < before.size(); ++k)
      converged =
          motion_at(static_cast<int>(k) * every + every / 2, &before[k].start).converged() && converged;
  });
  if (!converged) return state.SkipWithError("a motion was not found");
  state.counters["points"] = static_cast<double>(before.size());
  state.counters["error"] = error_of(observables::motion_in_time(scene, at_peak).amplitude);
}

void newmark(benchmark::State& state) {
  const int steps = static_cast<int>(state.range(0));
  motions(state,
          [=](const time::EquationOfMotion& equation) {
            return observables::in_steps(equation, time::at_rest(equation), steps, {});
          },
          {.frequency = exact_hertz, .method = observables::TimeMethod::newmark_shooting, .steps = steps});
}

void event_driven(benchmark::State& state) {
  motions(state,
          [](const time::EquationOfMotion& equation) {
            return observables::between_events(equation, time::at_rest(equation), 1, {});
          },
          {.frequency = exact_hertz, .method = observables::TimeMethod::shooting});
}

BENCHMARK(exact)->Name("accuracy/exact")->ArgName("H")->ArgsProduct({{1, 3, 7, 15, 27, 55, 101, 201}});
BENCHMARK(chosen)->Name("accuracy/chosen")->ArgName("digits")->DenseRange(2, 9);
BENCHMARK(sampled)
    ->Name("accuracy/sampled")
    ->ArgNames({"H", "samples"})
    ->ArgsProduct({{3, 7, 15, 27, 55}, {64, 256, 1024, 4096}});
BENCHMARK(newmark)->Name("accuracy/newmark")->ArgName("steps")->ArgsProduct({{50, 200, 800, 3200}});
BENCHMARK(event_driven)->Name("accuracy/event_driven");
// Of seconds and more, once.
BENCHMARK(sampled)
    ->Name("accuracy/sampled")
    ->ArgNames({"H", "samples"})
    ->ArgsProduct({{55, 101}, {16384, 65536}})
    ->Iterations(1)
    ->Repetitions(1);
BENCHMARK(newmark)
    ->Name("accuracy/newmark")
    ->ArgName("steps")
    ->Arg(12800)
    ->Arg(51200)
    ->Iterations(1)
    ->Repetitions(1);

}  // namespace
