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

#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/observables/time_study.hpp>

#include <benchmark/benchmark.h>

#include <ctime>

namespace {

using namespace arcslip;

constexpr int frequencies = 200;

scene::Scene paper() {
  return scene::read_file(ARCSLIP_SOURCE_DIR "/examples/al_sayed_2011/scene.json");
}

scene::Study in_time(const scene::Scene& scene, scene::TimeMethod method, int steps) {
  scene::Study study;
  study.kind = scene::StudyKind::time;
  study.for_each = scene.studies.at(0).for_each;
  study.time.method = method;
  study.time.steps = steps;
  study.time.periods = scene::largest_periods;
  return study;
}

void harmonic_balance(benchmark::State& state) {
  const scene::Scene scene = paper();
  std::size_t points = 0;
  for (auto _ : state) {
    points = 0;
    for (const auto& branch : observables::frequency_response(scene, scene.studies.at(0)))
      points += branch.points.size();
  }
  state.counters["points"] = static_cast<double>(points);
}

void shooting(benchmark::State& state) {
  const scene::Scene scene = paper();
  scene::Study study = in_time(scene, scene::TimeMethod::shooting, 1);
  std::size_t points = 0, failed = 0;
  for (auto _ : state) {
    points = failed = 0;
    for (int k = 0; k < frequencies; ++k) {
      study.frequency_from = study.frequency_to = 18 + 4.0 * k / (frequencies - 1);
      for (const auto& motion : observables::motions_in_time(scene, study)) {
        ++points;
        failed += motion.status == observables::Status::complete ? 0 : 1;
      }
    }
  }
  state.counters["points"] = static_cast<double>(points);
  state.counters["failed"] = static_cast<double>(failed);
}

void newmark_transient(benchmark::State& state) {
  const scene::Scene scene = paper();
  constexpr int steps = 200, steps_needed = 20'000;
  scene::Study study = in_time(scene, scene::TimeMethod::newmark, steps);
  study.frequency_from = study.frequency_to = 20;
  double periods = 0;
  const std::clock_t begin = std::clock();
  for (auto _ : state) {
    periods = 0;
    for (const auto& motion : observables::motions_in_time(scene, study))
      periods += static_cast<double>(motion.periods);
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
