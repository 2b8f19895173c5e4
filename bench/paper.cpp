// Whole figures of Al Sayed et al. (2011), with 55 harmonics and every observable.
//
//   fig6a/responses   twelve normal loads from 0.01 N to 500 N, 18 to 22 Hz
//   fig6c/peaks       the resonance peaks over these loads, as one continuation
//   study/one_load    a study of one response, with 7 harmonics and all columns, from a scene that has been
//   read
//
// Counters: points; error of the least peak, relative to the exact one (tests/reference/exact_1dof.json).

#include "measure.hpp"
#include "scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/studies/presentation/columns.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <cmath>
#include <vector>

namespace {

using namespace arcslip;

void responses(benchmark::State& state) {
  const scene::Scene scene = bench::example("al_sayed_2011");
  const auto& window = scene.studies.at(0).settings.as<observables::FrequencyRange>();
  std::vector<scene::Scene> scenes;
  for (const double load : scene.studies.at(0).for_each.at(0).second)
    scene::set(scenes.emplace_back(scene), "damper.normal_load", load);
  std::size_t points = 0;
  bench::measure(state, [&] {
    points = 0;
    for (const scene::Scene& each : scenes)
      for (const auto& branch : observables::frequency_response(each, window)) points += branch.points.size();
  });
  state.counters["points"] = static_cast<double>(points);
}
BENCHMARK(responses)->Name("fig6a/responses");

void peaks(benchmark::State& state) {
  const scene::Scene scene = bench::example("al_sayed_2011");
  const auto& range = scene.studies.at(1).settings.as<observables::CurveRange>();
  std::vector<observables::ResponseBranch> curves;
  bench::measure(state, [&] { curves = observables::resonance_peaks(scene, range); });
  if (curves.size() != 1 || curves[0].status != observables::Status::complete || curves[0].events.empty())
    return state.SkipWithError("not one whole curve");
  state.counters["points"] = static_cast<double>(curves[0].points.size());
  state.counters["error"] = std::abs(curves[0].events[0].point.amplitude / 0.000884191062245254 - 1);
}
BENCHMARK(peaks)->Name("fig6c/peaks");

void study(benchmark::State& state) {
  scene::Scene scene = bench::example("al_sayed_2011");
  scene::set(scene, "damper.normal_load", 3);
  scene.harmonics.order = 7;
  scene::Study& frf = scene.studies.at(0);
  frf.for_each.clear();
  const auto& kind = studies::kind_of(*frf.type);
  const studies::RunOptions options{.threads = 1};
  bench::measure(state, [&] {
    results::Collector collector;
    const std::vector schemas = {kind.schema(scene, frf, options)};
    collector.begin(studies::header(scene), schemas);
    kind.run(scene, frf, options, 0, collector);
    collector.finish();
  });
}
BENCHMARK(study)->Name("study/one_load");

}  // namespace
