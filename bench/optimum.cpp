// The optimal normal load, three ways to the same digits.
//
//   optimum/certified/H:N         by gradients of followed peaks (LD_SLSQP), with its certificate
//   optimum/gradients/H:N         the same without the certificate
//   optimum/derivative_free/H:N   LN_BOBYQA on followed peaks, without certificate
//   optimum/responses/H:N         frequency responses, each traced from nothing: golden section over the
//                                 load until its bracket is as narrow as the error that the first leaves
//                                 in the load, 1e-7 relative
//   optimum/any_of_blades/mistuned:M  one load for the highest of twelve blades of a ring, equal or with
//                                 stiffnesses within 2 %, with its certificate, in one thread
//
// Counters: evaluations, responses traced, load (N).

#include "measure.hpp"
#include "scenes.hpp"

#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/optimize/search/optimum.hpp>
#include <arcslip/optimize/study/optimum_study.hpp>

#include <cmath>
#include <string>

namespace {

using namespace arcslip;

const optimize::OptimumProblem over_load{{{"damper.normal_load", 0.1, 100}}, 18, 22};

void search_in(const scene::Scene& scene, const optimize::OptimumProblem& problem, benchmark::State& state,
               const optimize::OptimumOptions& options) {
  optimize::Optimum found;
  bench::measure(state, [&] { found = optimize::optimum(scene, problem, options); });
  if (found.status != observables::Status::complete) {
    state.SkipWithError(found.stop.message.c_str());
    return;
  }
  state.counters["evaluations"] = static_cast<double>(found.evaluations.size());
  state.counters["responses"] = found.work.responses;
  state.counters["load"] = found.design[0];
}

void search_with(benchmark::State& state, const optimize::OptimumOptions& options) {
  search_in(bench::paper(static_cast<int>(state.range(0))), over_load, state, options);
}

void optimum(benchmark::State& state) {
  search_with(state, {});
}
BENCHMARK(optimum)->Name("optimum/certified")->ArgName("H")->ArgsProduct({{1, 7, 55}});

void search(benchmark::State& state) {
  search_with(state, {.certificate = false});
}
BENCHMARK(search)->Name("optimum/gradients")->ArgName("H")->ArgsProduct({{1, 7, 55}});

void derivative_free(benchmark::State& state) {
  search_with(state, {.algorithm = "LN_BOBYQA", .certificate = false});
}
BENCHMARK(derivative_free)->Name("optimum/derivative_free")->ArgName("H")->ArgsProduct({{1, 7, 55}});

void any_of_blades(benchmark::State& state) {
  scene::Scene scene = bench::ring(12);
  constexpr double shares[] = {1.014, 0.986, 0.993, 1.0,   1.018, 1.007,
                               0.991, 0.998, 1.011, 0.982, 1.002, 0.995};
  for (int i = 0; i < 12; ++i) {
    const std::string spring = "k" + std::to_string(i + 1) + ".value";
    if (state.range(0) != 0) scene::set(scene, spring, shares[i] * scene::value(scene, spring));
  }
  scene::Response& response = scene.responses.front();
  response.direction = {{0, 1.0}};
  response.others.clear();
  for (int i = 1; i < 12; ++i) response.others.push_back({{i, 1.0}});
  const optimize::OptimumSettings settings{.problem = {{{"load", 1, 200}}, 145, 175}};
  search_in(scene, optimize::with_places(scene, settings).problem, state, {});
}
BENCHMARK(any_of_blades)->Name("optimum/any_of_blades")->ArgName("mistuned")->ArgsProduct({{0, 1}});

double peak_at(const scene::Scene& scene, double load) {
  scene::Scene at = scene;
  scene::set(at, "damper.normal_load", load);
  const auto model = std::make_shared<const model::Model>(model::build(at));
  const double hertz = scene::to_rad_per_s(scene::FrequencyUnit::hertz);
  double most = 0;
  observables::frequency_branch(model, {18 * hertz, 22 * hertz}, 18 * hertz,
                                [&](observables::Observer& observer, const continuation::Accepted& now,
                                    const continuation::Event* event) {
                                  const auto& evaluator = static_cast<const hbm::HbmEvaluator&>(now.at);
                                  if (event && event->monitor == "peak")
                                    most = std::max(most, observer.extreme(evaluator, now.u).amplitude);
                                  return true;
                                });
  return most;
}

void response_grid(benchmark::State& state) {
  const scene::Scene scene = bench::paper(static_cast<int>(state.range(0)));
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double a = 0, b = 0;
  long responses = 0;
  bench::measure(state, [&] {
    responses = 0;
    const auto f = [&](double y) {
      ++responses;
      return peak_at(scene, std::exp(y));
    };
    a = std::log(0.1), b = std::log(100.0);
    double c = b - golden * (b - a), d = a + golden * (b - a), fc = f(c), fd = f(d);
    while (b - a > 1e-7)
      if (fc < fd)
        b = d, d = c, fd = fc, c = b - golden * (b - a), fc = f(c);
      else
        a = c, c = d, fc = fd, d = a + golden * (b - a), fd = f(d);
  });
  state.counters["responses"] = static_cast<double>(responses);
  state.counters["load"] = std::exp((a + b) / 2);
}
BENCHMARK(response_grid)->Name("optimum/responses")->ArgName("H")->ArgsProduct({{1, 7, 55}});

}  // namespace
