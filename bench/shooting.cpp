// Time of the exact frequency responses of Al Sayed et al. (2011): twelve loads, 200 frequencies each from 18
// to 22 Hz, each a periodic motion by shooting from that of the frequency before.
//
//   exact_family      event-driven, all observables of each point
//
// Counters: points, and periods integrated for one point.

#include "examples.hpp"

#include <arcslip/scene/scene.hpp>
#include <arcslip/time/shooting.hpp>

#include <benchmark/benchmark.h>

#include <numbers>
#include <vector>

namespace {

using namespace arcslip;

constexpr int points = 200;

void exact_family(benchmark::State& state) {
  const auto scene = bench::example("al_sayed_2011");
  const auto model = model::build(scene);
  const std::vector<double> loads = scene.studies.front().for_each.front().second;
  const int load = model::parameter_index(model, "damper.normal_load");
  continuation::Vector p(static_cast<Eigen::Index>(model.parameters.size()));
  for (Eigen::Index k = 0; k < p.size(); ++k) p[k] = model.parameters[static_cast<std::size_t>(k)].value;
  long periods = 0, count = 0;
  for (auto _ : state)
    for (const double value : loads) {
      p[load] = value;
      time::MotionState start;
      for (int i = 0; i < points; ++i) {
        p[model::frequency] = 2 * std::numbers::pi * (18 + 4.0 * i / (points - 1));
        const auto equation = time::equation_of_motion(model, p);
        time::EventDriven integrator(equation);
        const auto motion = i == 0 ? time::periodic_motion(integrator, time::at_rest(equation))
                                   : time::periodic_motion(integrator, start, {.transients = 0});
        if (!motion.converged()) return state.SkipWithError(motion.shooting.message.c_str());
        start = motion.shooting.start;
        periods += motion.shooting.maps + 1;
        ++count;
        benchmark::DoNotOptimize(motion.period.amplitude);
      }
    }
  state.counters["points"] = static_cast<double>(loads.size() * points);
  state.counters["periods_per_point"] = static_cast<double>(periods) / static_cast<double>(count);
}

BENCHMARK(exact_family)->Unit(benchmark::kMillisecond);

}  // namespace
