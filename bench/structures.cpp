// Cost over the size of the linear structure: a chain of n masses between a wall and one friction damper,
// proportional damping, N = 7.
//
//   chain_stiffness/n   the condensed dynamic stiffness at one frequency: by fixed-interface modes, and by
//                       factorizations (counters
//                       factorized_us and factorized_over_modal, same run)
//   chain_frf/n         a frequency response about the first resonance; counters setup_ms, of the problem,
//   and
//                       us_per_point, of the rest
//
// Counters are processor time.

#include <arcslip/elements/jenkins.hpp>
#include <arcslip/hbm/dynamic_stiffness.hpp>
#include <arcslip/observables/frequency_branch.hpp>
#include <arcslip/scene/scene.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <memory>
#include <numbers>
#include <string>

namespace {

using namespace arcslip;

// The lowest natural frequency is about 1 rad/s.
scene::Scene chain(int n) {
  scene::Scene s;
  s.frequency_unit = scene::FrequencyUnit::radian_per_second;
  const double k = 4.0 * n * n / (std::numbers::pi * std::numbers::pi);
  for (int i = 0; i < n; ++i) {
    const std::string name = std::to_string(i);
    s.dofs.push_back("x" + name);
    const scene::Direction along =
        i > 0 ? scene::Direction{{i, 1.0}, {i - 1, -1.0}} : scene::Direction{{i, 1.0}};
    s.masses.push_back({"m" + name, &scene::mass_type(), {{{i, 1.0}}}, {1.0}});
    s.springs.push_back({"k" + name, &scene::spring_type(), {along}, {k}});
    s.dampers.push_back({"c" + name, &scene::damper_type(), {along}, {0.02 * k}});
  }
  s.elements.push_back({"d", &elements::jenkins(), {{{n - 1, 1.0}}}, {0.1 * n, 0.5, 2.0}});
  s.excitation.push_back({"f", &scene::force_type(), {{{n / 2, 1.0}}}, {1.0, 0.0}});
  s.harmonics.order = 7;
  s.response() = {{n - 1, 1.0}};
  return s;
}

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// Of one call, the least of several batches.
template <class Function>
double seconds(int calls, Function&& f) {
  double least = 1e300;
  for (int batch = 0; batch < 5; ++batch) {
    const double begin = processor_seconds();
    for (int k = 0; k < calls; ++k) f();
    least = std::min(least, (processor_seconds() - begin) / calls);
  }
  return least;
}

void chain_stiffness(benchmark::State& state) {
  const model::Model model = model::build(chain(static_cast<int>(state.range(0))));
  hbm::DynamicStiffness modal(model, hbm::coordinates(model, 1), model.harmonics),
      factorized(model, hbm::coordinates(model), model.harmonics);
  continuation::Vector p = model::defaults(model);
  p[model::frequency] = 0.9;
  for (auto _ : state) {
    p[model::frequency] *= 1 + 1e-9;
    benchmark::DoNotOptimize(modal.move_to(p));
  }
  const auto move = [&](hbm::DynamicStiffness& stiffness) {
    p[model::frequency] *= 1 + 1e-9;
    stiffness.move_to(p);
  };
  const double by_modes = seconds(2000, [&] { move(modal); }),
               by_factors = seconds(50, [&] { move(factorized); });
  state.counters["factorized_us"] = 1e6 * by_factors;
  state.counters["factorized_over_modal"] = by_factors / by_modes;
}
BENCHMARK(chain_stiffness)
    ->ArgName("n")
    ->Arg(10)
    ->Arg(20)
    ->Arg(50)
    ->Arg(100)
    ->Arg(200)
    ->Arg(400)
    ->Unit(benchmark::kMicrosecond);

void chain_frf(benchmark::State& state) {
  const auto model =
      std::make_shared<const model::Model>(model::build(chain(static_cast<int>(state.range(0)))));
  observables::FrequencyBranch last;
  const double begin = processor_seconds();
  for (auto _ : state) last = observables::frequency_branch(model, {0.7, 1.5}, 0.7);
  const double all = (processor_seconds() - begin) / static_cast<double>(state.iterations());
  const double setup = seconds(1, [&] { hbm::HbmProblem(model, model->harmonics, 1, 1); });
  const auto points = static_cast<double>(last.branch.points.size());
  state.counters["points"] = points;
  state.counters["residuals"] = static_cast<double>(last.branch.counts.residuals);
  state.counters["setup_ms"] = 1e3 * setup;
  state.counters["us_per_point"] = 1e6 * (all - setup) / points;
}
BENCHMARK(chain_frf)->ArgName("n")->Arg(2)->Arg(10)->Arg(20)->Arg(50)->Arg(100)->Arg(200)->Arg(400)->Unit(
    benchmark::kMillisecond);

}  // namespace
