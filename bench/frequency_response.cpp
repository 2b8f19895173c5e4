// Time of a whole frequency response: from the model to the last point, peaks and folds located.
//
//   paper_frf/H:N     paper's oscillator, Fn = 3 N, 18 to 22 Hz, N harmonics
//   duffing_frf/H:7   Duffing oscillator, 0.5 to 1.6 rad/s
//   damped_chain_frf  six masses and six friction dampers, 7 harmonics, with and without stability
//
// Counters: points and events of the branch; factorizations and solves of it; linear_share, the share of the
// time that so many bare factorizations and solves of that size take; over_lu, the time over that of the
// factorizations alone. Bare costs are measured in the same run.

#include "examples.hpp"

#include <arcslip/observables/frequency_branch.hpp>
#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <benchmark/benchmark.h>

#include <Eigen/LU>

#include <chrono>
#include <sstream>
#include <stdexcept>
#include <string>

namespace {

using namespace arcslip;

scene::Scene example(const std::string& name, int order) {
  scene::Scene scene = bench::example(name);
  scene.harmonics.order = order;
  return scene;
}

// Seconds of one call of f, the least of several batches.
template <class Function>
double seconds(Function&& f) {
  using clock = std::chrono::steady_clock;
  double least = 1e9;
  for (int batch = 0; batch < 5; ++batch) {
    const int calls = 200;
    const auto begin = clock::now();
    for (int k = 0; k < calls; ++k) f();
    least = std::min(least, std::chrono::duration<double>(clock::now() - begin).count() / calls);
  }
  return least;
}

struct LinearCosts {
  double factorization, solve;
};

LinearCosts linear_costs(int n) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(n, n) + n * Eigen::MatrixXd::Identity(n, n);
  Eigen::PartialPivLU<Eigen::MatrixXd> lu(n);
  Eigen::VectorXd b = Eigen::VectorXd::Random(n), x(n);
  return {seconds([&] { lu.compute(A); }), seconds([&] {
            x.noalias() = lu.permutationP() * b;
            lu.matrixLU().triangularView<Eigen::UnitLower>().solveInPlace(x);
            lu.matrixLU().triangularView<Eigen::Upper>().solveInPlace(x);
            benchmark::DoNotOptimize(x.data());
          })};
}

void trace_whole(benchmark::State& state, const scene::Scene& scene,
                 const observables::FrequencyWindow& window, std::size_t events) {
  const auto model = std::make_shared<const model::Model>(model::build(scene));
  observables::FrequencyBranch last;
  double total = 0;
  for (auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    last = observables::frequency_branch(model, window, window.lower);
    total += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  const auto& branch = last.branch;
  if (branch.stop.reason != continuation::StopReason::boundary || branch.events.size() != events ||
      branch.points.size() < 150) {
    state.SkipWithError(("not the whole branch: " + std::to_string(branch.points.size()) + " points, " +
                         std::to_string(branch.events.size()) + " events, " + branch.stop.message)
                            .c_str());
    return;
  }
  const LinearCosts cost = linear_costs(last.problem->size() + 1);
  const double time = total / static_cast<double>(state.iterations());
  const double factorizations = static_cast<double>(branch.counts.factorizations);
  const double solves = static_cast<double>(branch.counts.solves);
  state.counters["points"] = static_cast<double>(branch.points.size());
  state.counters["factorizations"] = factorizations;
  state.counters["residuals"] = static_cast<double>(branch.counts.residuals);
  state.counters["solves"] = solves;
  state.counters["linear_share"] = (factorizations * cost.factorization + solves * cost.solve) / time;
  state.counters["over_lu"] = time / (factorizations * cost.factorization);
}

void paper_frf(benchmark::State& state) {
  scene::Scene scene = example("al_sayed_2011", static_cast<int>(state.range(0)));
  scene::set(scene, "damper.normal_load", 3);
  const double hertz = scene::to_rad_per_s(scene::FrequencyUnit::hertz);
  trace_whole(state, scene, {18 * hertz, 22 * hertz}, 1);
}
BENCHMARK(paper_frf)->ArgName("H")->Arg(1)->Arg(7)->Arg(27)->Arg(55)->Unit(benchmark::kMillisecond);

void duffing_frf(benchmark::State& state) {
  trace_whole(state, example("duffing", static_cast<int>(state.range(0))), {0.5, 1.6},
              3);  // a peak and two folds
}
BENCHMARK(duffing_frf)->ArgName("H")->Arg(7)->Unit(benchmark::kMillisecond);

// The study as the command runs it, with all observables and the estimate of truncation at each point; and
// with its stability.
void observed(benchmark::State& state, const scene::Scene& scene, observables::FrequencyRange window,
              bool stability) {
  window.stability = stability;
  for (auto _ : state) benchmark::DoNotOptimize(observables::frequency_response(scene, window));
}

void paper_frf_observed(benchmark::State& state, bool stability) {
  scene::Scene scene = example("al_sayed_2011", static_cast<int>(state.range(0)));
  scene::set(scene, "damper.normal_load", 3);
  observed(state, scene, scene.studies.front().settings.as<observables::FrequencyRange>(), stability);
}
BENCHMARK_CAPTURE(paper_frf_observed, without_stability, false)
    ->ArgName("H")
    ->Arg(1)
    ->Arg(7)
    ->Arg(27)
    ->Arg(55)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(paper_frf_observed, stability, true)
    ->ArgName("H")
    ->Arg(1)
    ->Arg(7)
    ->Arg(27)
    ->Arg(55)
    ->Unit(benchmark::kMillisecond);

// A chain of six masses with a friction damper between all neighbours, through its first two resonances.
scene::Scene chain() {
  std::istringstream text(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": [{"repeat": 6, "name": "x{i}"}],
      "masses": [{"repeat": 6, "name": "m{i}", "at": "x{i}", "value": 1}],
      "springs": [{"name": "k0", "at": "x1", "value": 1},
                  {"repeat": 5, "name": "k{i}", "between": ["x{i}", "x{i+1}"], "value": 1}],
      "dampers": [{"repeat": 6, "name": "c{i}", "at": "x{i}", "value": 0.01}]},
    "elements": [
      {"name": "d0", "type": "jenkins", "at": "x1", "stiffness": 0.5, "friction_coefficient": 0.5, "normal_load": 0.2},
      {"repeat": 5, "name": "d{i}", "type": "jenkins", "between": ["x{i}", "x{i+1}"],
       "stiffness": 0.5, "friction_coefficient": 0.5, "normal_load": 0.2}],
    "excitation": [{"name": "force", "at": "x6", "cosine": 0.1}], "response": {"at": "x6"},
    "harmonics": {"order": 7}})");
  return scene::read(text, studies::catalogue());
}

void damped_chain_frf(benchmark::State& state, bool stability) {
  observed(state, chain(), {0.15, 0.9}, stability);
}
BENCHMARK_CAPTURE(damped_chain_frf, without_stability, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(damped_chain_frf, stability, true)->Unit(benchmark::kMillisecond);

}  // namespace
