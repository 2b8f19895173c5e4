// The resonance peaks of Fig. 6c of Al Sayed et al. (2011), from 0.01 N to 500 N with 55 harmonics, as one
// continuation over the load with every observable. Counters: points; error of the least peak, relative to
// the exact one (tests/reference/exact_1dof.json).

#include "examples.hpp"

#include <arcslip/observables/curves.hpp>

#include <benchmark/benchmark.h>

#include <cmath>

namespace {

using namespace arcslip;

void peaks(benchmark::State& state) {
  const scene::Scene scene = bench::example("al_sayed_2011");
  const auto& range = scene.studies.at(1).settings.as<observables::CurveRange>();
  std::size_t points = 0;
  double least = 0;
  for (auto _ : state) {
    const auto curves = observables::resonance_peaks(scene, range);
    if (curves.size() != 1 || curves[0].status != observables::Status::complete || curves[0].events.empty())
      return state.SkipWithError("not one whole curve");
    points = curves[0].points.size();
    least = curves[0].events[0].point.amplitude;
  }
  state.counters["points"] = static_cast<double>(points);
  state.counters["error"] = std::abs(least / 0.000884191062245254 - 1);
}
BENCHMARK(peaks)->Name("fig6c/peaks")->Unit(benchmark::kMillisecond);

}  // namespace
