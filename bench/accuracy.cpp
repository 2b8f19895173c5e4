// How the error falls with the harmonics, and what it costs: friction integrated exactly and sampled in time.
//
//   peak_error/exact/H:N/load:L             resonance peak of the paper's oscillator at Fn = L N
//   peak_error/sampled/H:N/load:L/samples:S
//   by_accuracy/digits:K/load:L             the response of a study whose order an accuracy of 10^-K chooses
//
// Counters: amplitude_error and frequency_error, relative to the closed-form solution (tests/reference), and
// estimated_error, the truncation estimate at the peak. The time is that of the whole branch, 18 to 22 Hz.

#include "examples.hpp"

#include <arcslip/observables/frequency_branch.hpp>
#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/order_selection.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace {

using namespace arcslip;

struct Peak {
  double amplitude, hertz;
};

// tests/reference/exact_1dof.json
Peak exact_peak(std::int64_t load) {
  return load == 1 ? Peak{0.022821958614055, 19.1183216190022} : Peak{0.000884970009333055, 19.9952846841786};
}

void peak_error(benchmark::State& state, bool sampled) {
  scene::Scene scene = bench::example("al_sayed_2011");
  scene.harmonics.order = static_cast<int>(state.range(0));
  scene::set(scene, "damper.normal_load", static_cast<double>(state.range(1)));
  if (sampled) {
    scene.harmonics.friction = scene::Friction::sampled;
    scene.harmonics.samples = static_cast<int>(state.range(2));
  }
  const auto model = std::make_shared<const model::Model>(model::build(scene));
  const double hertz = 2 * std::numbers::pi;
  const Peak exact = exact_peak(state.range(1));
  double amplitude_error = 1, frequency_error = 1, estimate = 0;
  for (auto _ : state) {
    amplitude_error = frequency_error = 1;
    observables::frequency_branch(model, {18 * hertz, 22 * hertz}, 18 * hertz,
                                  [&](observables::Observer& observer, const continuation::Accepted& now,
                                      const continuation::Event* event) {
                                    if (!event || event->monitor != "peak") return true;
                                    const auto point = observer.observe(now);
                                    const double error = std::abs(point.amplitude / exact.amplitude - 1);
                                    if (error < amplitude_error) {
                                      amplitude_error = error;
                                      frequency_error = std::abs(point.omega / hertz / exact.hertz - 1);
                                      estimate = point.truncation_estimate / point.amplitude;
                                    }
                                    return true;
                                  });
  }
  state.counters["amplitude_error"] = amplitude_error;
  state.counters["frequency_error"] = frequency_error;
  state.counters["estimated_error"] = estimate;
}

void by_accuracy(benchmark::State& state) {
  scene::Scene scene = bench::example("al_sayed_2011");
  scene::set(scene, "damper.normal_load", static_cast<double>(state.range(1)));
  scene.harmonics.order = scene::largest_chosen_order;
  const Peak exact = exact_peak(state.range(1));
  std::vector<observables::ResponseBranch> branches;
  double order = 0, highest = 0;
  for (auto _ : state) {
    scene.harmonics.accuracy = std::pow(10, -static_cast<double>(state.range(0)));
    studies::OrderSelection selection(scene);
    scene::Scene with = scene;
    do {
      selection.set_order(with);
      branches = observables::frequency_response(with, {18, 22});
    } while (selection.rises(studies::truncation_of(branches)));
    order = selection.order();
  }
  for (const auto& event : branches.front().events) highest = std::max(highest, event.point.amplitude);
  state.counters["amplitude_error"] = std::abs(highest / exact.amplitude - 1);
  state.counters["order"] = order;
  state.counters["points"] = static_cast<double>(branches.front().points.size());
}

void orders(benchmark::internal::Benchmark* b) {
  for (std::int64_t load : {1, 3})
    for (std::int64_t order : {1, 3, 7, 15, 27, 55, 101, 201}) b->Args({order, load});
}

void orders_and_samples(benchmark::internal::Benchmark* b) {
  for (std::int64_t load : {1, 3})
    for (std::int64_t samples : {512, 4096})
      for (std::int64_t order : {1, 3, 7, 15, 27, 55, 101}) b->Args({order, load, samples});
}

BENCHMARK(by_accuracy)
    ->ArgNames({"digits", "load"})
    ->ArgsProduct({{2, 3, 4, 5, 6, 7, 8, 9}, {1, 3}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(peak_error, exact, false)
    ->ArgNames({"H", "load"})
    ->Apply(orders)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(peak_error, sampled, true)
    ->ArgNames({"H", "load", "samples"})
    ->Apply(orders_and_samples)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
