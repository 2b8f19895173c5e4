// The frequency responses of Fig. 6a of Al Sayed et al. (2011), 12 normal loads from 0.01 N to 500 N over 18
// to 22 Hz, three ways to an error of about 1e-7 of the amplitude:
//
//   fig6a/harmonic_balance   by continuation, 55 harmonics: some 200 points a load
//   fig6a/shooting           the exact periodic motion, event-driven, at 200 frequencies a load
//   fig6a/newmark_transient  Newmark's steps from rest until steady to 1e-9, at one frequency a load with 200
//                            steps a period. Counter family_seconds: processor time of 200 frequencies with
//                            the 20 000 steps that 1e-7 needs (the error is some 40/steps^2), by proportion
//
// Counters: points of the family; periods, of transients.

#include "examples.hpp"

#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/observables/time_study.hpp>

#include <benchmark/benchmark.h>

#include <ctime>

namespace {

using namespace arcslip;

constexpr int frequencies = 200;

scene::Scene paper() {
  return bench::example("al_sayed_2011");
}

/// The scene at each of the loads of its frequency responses.
std::vector<scene::Scene> at_each_load(const scene::Scene& scene) {
  std::vector<scene::Scene> all;
  for (const double load : scene.studies.at(0).for_each.at(0).second)
    scene::set(all.emplace_back(scene), "damper.normal_load", load);
  return all;
}

constexpr int no_limit = 100'000'000;  // of periods

void harmonic_balance(benchmark::State& state) {
  const scene::Scene scene = paper();
  const auto& window = scene.studies.at(0).settings.as<observables::FrequencyRange>();
  const auto scenes = at_each_load(scene);
  std::size_t points = 0;
  for (auto _ : state) {
    points = 0;
    for (const scene::Scene& each : scenes)
      for (const auto& branch : observables::frequency_response(each, window)) points += branch.points.size();
  }
  state.counters["points"] = static_cast<double>(points);
}

void shooting(benchmark::State& state) {
  const auto scenes = at_each_load(paper());
  std::size_t points = 0, failed = 0;
  for (auto _ : state) {
    points = failed = 0;
    for (int k = 0; k < frequencies; ++k) {
      const double frequency = 18 + 4.0 * k / (frequencies - 1);
      for (const scene::Scene& each : scenes) {
        const auto motion =
            observables::motion_in_time(each, {frequency, observables::TimeMethod::shooting, 1, no_limit});
        ++points;
        failed += motion.status == observables::Status::complete ? 0 : 1;
      }
    }
  }
  state.counters["points"] = static_cast<double>(points);
  state.counters["failed"] = static_cast<double>(failed);
}

void newmark_transient(benchmark::State& state) {
  constexpr int steps = 200, steps_needed = 20'000;
  const observables::TimeSettings settings{20, observables::TimeMethod::newmark, steps, no_limit};
  const auto scenes = at_each_load(paper());
  double periods = 0;
  const std::clock_t begin = std::clock();
  for (auto _ : state) {
    periods = 0;
    for (const scene::Scene& each : scenes)
      periods += static_cast<double>(observables::motion_in_time(each, settings).periods);
  }
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  state.counters["periods"] = periods;
  state.counters["family_seconds"] =
      frequencies * seconds * steps_needed / steps / static_cast<double>(state.iterations());
}

BENCHMARK(harmonic_balance)->Name("fig6a/harmonic_balance")->Unit(benchmark::kMillisecond);
BENCHMARK(shooting)->Name("fig6a/shooting")->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(newmark_transient)->Name("fig6a/newmark_transient")->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
