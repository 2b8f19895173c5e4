// Frequency responses from the model to the last point, with start, peaks and folds.
//
//   frf/paper/H:N            the paper's oscillator, N harmonics
//   frf/paper_points/finer:R the same with N = 7 and steps an R-th as long
//   frf/paper_threads        the same with N = 7 in several threads, each with a response of its own
//   frf/shared_elements      three contact_3d whose forces several threads share: seconds of wall time
//   frf/duffing, frf/damped_chain, frf/nlvib_chain
//   frf/chain/masses:n, frf/beam/elements:n, frf/contacts/of_20_masses:n, frf/ring/blades:n
//   observed/SCENE           as the command does it: all quantities and the estimate of truncation
//   stability/SCENE          likewise with Floquet multipliers
//
// Counters: points, events, unknowns, factorizations, residuals and solves of a branch; lu_seconds and
// lu_profile, of one bare factorization of that size (Eigen's PartialPivLU), and solve_seconds, of one bare
// solve; start_seconds, of the problem and the first response.

#include "measure.hpp"
#include "scenes.hpp"

#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <string>

namespace {

using namespace arcslip;
using observables::FrequencyRange;
using observables::Steps;

constexpr int points_asked_for = 150;

// Of the first study.
FrequencyRange range_of(const scene::Scene& scene) {
  return scene.studies.front().settings.as<FrequencyRange>();
}

observables::FrequencyWindow in_rad_per_s(const FrequencyRange& range, const scene::Scene& scene) {
  const double unit = scene::to_rad_per_s(scene.frequency_unit);
  return {range.from * unit, range.to * unit};
}

void count(benchmark::State& state, const continuation::Branch& branch, int unknowns) {
  if (branch.stop.reason != continuation::StopReason::boundary || branch.points.size() < points_asked_for)
    return state.SkipWithError(
        (std::to_string(branch.points.size()) + " points: " + branch.stop.message).c_str());
  const auto counter = [&](const char* name, auto value) {
    state.counters[name] = {static_cast<double>(value), benchmark::Counter::kAvgThreads};
  };
  counter("unknowns", unknowns);
  counter("points", branch.points.size());
  counter("events", branch.events.size());
  counter("factorizations", branch.counts.factorizations);
  counter("residuals", branch.counts.residuals);
  counter("solves", branch.counts.solves);
}

// Bordered by the tangent.
void count_lu(benchmark::State& state, int unknowns) {
  const int n = unknowns + 1;
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(n, n) + n * Eigen::MatrixXd::Identity(n, n);
  Eigen::PartialPivLU<Eigen::MatrixXd> lu(n);
  Eigen::VectorXd b = Eigen::VectorXd::Random(n), x(n);
  const auto factorize = [&] { lu.compute(A); };
  state.counters["lu_seconds"] = bench::least_seconds(factorize);
  if (const int number = bench::profile(factorize)) state.counters["lu_profile"] = number;
  state.counters["solve_seconds"] = bench::least_seconds([&] {
    x.noalias() = lu.permutationP() * b;
    lu.matrixLU().triangularView<Eigen::UnitLower>().solveInPlace(x);
    lu.matrixLU().triangularView<Eigen::Upper>().solveInPlace(x);
    benchmark::DoNotOptimize(x.data());
  });
}

void response(benchmark::State& state, const scene::Scene& scene, const FrequencyRange& range) {
  const auto model = std::make_shared<const model::Model>(model::build(scene));
  const auto window = in_rad_per_s(range, scene);
  observables::FrequencyBranch last;
  bench::measure(state, [&] { last = observables::frequency_branch(model, window, window.lower); });
  count(state, last.branch, last.problem->size());
  if (state.threads() > 1) return;
  count_lu(state, last.problem->size());
  state.counters["start_seconds"] = bench::least_seconds(
      [&] { observables::first_response(model, window.lower, window.upper - window.lower); });
}

void response(benchmark::State& state, const scene::Scene& scene) {
  response(state, scene, range_of(scene));
}

int argument(const benchmark::State& state) {
  return static_cast<int>(state.range(0));
}

void paper(benchmark::State& state) {
  response(state, bench::paper(argument(state)));
}

void paper_points(benchmark::State& state) {
  const double finer = argument(state);
  const scene::Scene scene = bench::paper(7);
  const auto model = std::make_shared<const model::Model>(model::build(scene));
  const auto window = in_rad_per_s(range_of(scene), scene);
  auto options = observables::frequency_options(window, Steps::curve, {});
  options.points = 1'000'000;
  options.step.largest_parameter /= finer;
  options.step.angle /= finer;
  options.step.relative_state /= finer;
  options.step.curve_tolerance /= finer * finer;
  continuation::Branch branch;
  int unknowns = 0;
  bench::measure(state, [&] {
    const auto first = observables::first_response(model, window.lower, window.upper - window.lower);
    const auto observer = std::make_shared<observables::Observer>(first.problem);
    branch = continuation::trace(
        first.problem,
        {first.u.value(), hbm::parameters_at(*first.problem, window.lower), model::frequency, 1}, options,
        observables::frequency_monitors(observer, Steps::curve, {}));
    unknowns = first.problem->size();
  });
  count(state, branch, unknowns);
}

void paper_threads(benchmark::State& state) {
  response(state, bench::paper(7));
}

void shared_elements(benchmark::State& state) {
  using Clock = std::chrono::steady_clock;
  scene::Scene scene = bench::rubbing_masses(3);
  scene.threads.count = argument(state);
  double least = std::numeric_limits<double>::infinity();
  for (auto _ : state) {
    const auto begin = Clock::now();
    benchmark::DoNotOptimize(observables::frequency_response(scene, range_of(scene)).data());
    least = std::min(least, std::chrono::duration<double>(Clock::now() - begin).count());
  }
  state.counters["seconds"] = least;
}

void duffing(benchmark::State& state) {
  scene::Scene scene = bench::example("duffing");
  scene.harmonics.order = 7;
  response(state, scene, {0.5, 1.6});
}

void damped_chain(benchmark::State& state) {
  response(state, bench::damped_chain(), {0.15, 0.9});
}

// Example 07 of NLvib.
void nlvib_chain(benchmark::State& state) {
  response(state, bench::example("gap_limited_chain"));
}

void chain(benchmark::State& state) {
  response(state, bench::chain(argument(state), 1), {0.7, 1.5});
}

void contacts(benchmark::State& state) {
  response(state, bench::chain(20, argument(state)), {0.7, 1.5});
}

void beam(benchmark::State& state) {
  response(state, bench::beam(argument(state)));
}

void ring(benchmark::State& state) {
  response(state, bench::ring(argument(state)));
}

BENCHMARK(paper)->Name("frf/paper")->ArgName("H")->ArgsProduct({{1, 3, 7, 15, 27, 55, 101}});
BENCHMARK(paper_points)->Name("frf/paper_points")->ArgName("finer")->ArgsProduct({{1, 2, 4, 8, 16}});
BENCHMARK(paper_threads)->Name("frf/paper_threads")->ThreadRange(1, 4);
BENCHMARK(shared_elements)->Name("frf/shared_elements")->ArgName("threads")->ArgsProduct({{1, 2, 4}});
BENCHMARK(duffing)->Name("frf/duffing");
BENCHMARK(damped_chain)->Name("frf/damped_chain");
BENCHMARK(nlvib_chain)->Name("frf/nlvib_chain");
BENCHMARK(chain)->Name("frf/chain")->ArgName("masses")->ArgsProduct({{2, 10, 20, 50, 100, 200, 400}});
BENCHMARK(contacts)->Name("frf/contacts")->ArgName("of_20_masses")->ArgsProduct({{1, 2, 5, 10, 20}});
BENCHMARK(beam)->Name("frf/beam")->ArgName("elements")->ArgsProduct({{10, 20, 40, 80, 160}});
BENCHMARK(ring)->Name("frf/ring")->ArgName("blades")->ArgsProduct({{6, 12, 24, 48}});

void observed(benchmark::State& state, const scene::Scene& scene, FrequencyRange range, bool stability) {
  range.stability = stability;
  bench::measure(state,
                 [&] { benchmark::DoNotOptimize(observables::frequency_response(scene, range).data()); });
}

void observed_paper(benchmark::State& state, bool stability) {
  const scene::Scene scene = bench::paper(argument(state));
  observed(state, scene, range_of(scene), stability);
}

void observed_damped_chain(benchmark::State& state, bool stability) {
  observed(state, bench::damped_chain(), {0.15, 0.9}, stability);
}

void observed_nlvib_chain(benchmark::State& state, bool stability) {
  const scene::Scene scene = bench::example("gap_limited_chain");
  observed(state, scene, range_of(scene), stability);
}

BENCHMARK_CAPTURE(observed_paper, , false)
    ->Name("observed/paper")
    ->ArgName("H")
    ->ArgsProduct({{1, 7, 27, 55}});
BENCHMARK_CAPTURE(observed_paper, , true)
    ->Name("stability/paper")
    ->ArgName("H")
    ->ArgsProduct({{1, 7, 27, 55}});
BENCHMARK_CAPTURE(observed_damped_chain, , false)->Name("observed/damped_chain");
BENCHMARK_CAPTURE(observed_damped_chain, , true)->Name("stability/damped_chain");
BENCHMARK_CAPTURE(observed_nlvib_chain, , false)->Name("observed/nlvib_chain");
BENCHMARK_CAPTURE(observed_nlvib_chain, , true)->Name("stability/nlvib_chain");

}  // namespace
