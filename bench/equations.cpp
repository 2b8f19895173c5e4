// One evaluation of residual and Jacobian of an oscillator with a friction damper, and what of it is the
// damper itself: what the general case costs a scene that does not need it.
//
//   equations/element/H:N   the damper alone, odd harmonics
//   equations/odd/H:N       the oscillator, odd harmonics
//   equations/all/H:N       the same with the mean and even harmonics
//   equations/masses/H:N    the same with 20 other masses, odd harmonics
//
// Each at another frequency than the one before, as along a branch.

#include "measure.hpp"
#include "scenes.hpp"

#include <arcslip/hbm/problem.hpp>

#include <memory>

namespace {

using namespace arcslip;
using continuation::Vector;

struct At {
  std::shared_ptr<const hbm::HbmProblem> problem;
  Vector p, u;
};

// The response at 20 Hz, where the damper slips.
At at(const scene::Scene& scene, bool odd) {
  const auto model = std::make_shared<const model::Model>(model::build(scene));
  const elements::Harmonics h{scene.harmonics.order, odd};
  const double omega = 20 * scene::to_rad_per_s(scene::FrequencyUnit::hertz);
  At found{std::make_shared<const hbm::HbmProblem>(model, h, 1e-3, 1.0, omega), {}, {}};
  found.p = hbm::parameters_at(*found.problem, omega);
  found.u = hbm::steady_state(found.problem, found.p).u.value();
  return found;
}

scene::Scene near_masses(int order) {
  scene::Scene scene = bench::paper(order);
  for (int i = 1; i <= 20; ++i) {
    const std::string n = std::to_string(i);
    scene.dofs.push_back("x" + n);
    scene.masses.push_back({"m" + n, &scene::mass_type(), {{{i, 1.0}}}, {0.1}});
    scene.springs.push_back({"k" + n, &scene::spring_type(), {{{i, 1.0}, {i - 1, -1.0}}}, {8e4}});
  }
  return scene;
}

void equations(benchmark::State& state, const scene::Scene& scene, bool odd) {
  const At here = at(scene, odd);
  const auto evaluator = here.problem->hbm_evaluator();
  Vector p = here.p;
  const double omega = p[model::frequency];
  int turn = 0;
  const auto work = [&] {
    p[model::frequency] = omega * (1 + 1e-9 * (++turn % 2));
    evaluator->move_to(here.u, p, continuation::Needs::jacobian);
    benchmark::DoNotOptimize(evaluator->residual().data());
    benchmark::DoNotOptimize(&evaluator->jacobian());
  };
  bench::measure(state, work, bench::calls_to_time(work));
}

void damper_alone(benchmark::State& state) {
  const At here = at(bench::paper(static_cast<int>(state.range(0))), true);
  const model::NonlinearPart& part = here.problem->model().elements.front();
  const auto element = part.law->element(here.problem->harmonics(), here.problem->sampling());
  const auto fields = part.fields(here.p);
  const auto work = [&] {
    element->move_to(here.u, fields, true);
    benchmark::DoNotOptimize(element->jacobian().data());
  };
  bench::measure(state, work, bench::calls_to_time(work));
}

void odd(benchmark::State& state) {
  equations(state, bench::paper(static_cast<int>(state.range(0))), true);
}
void all(benchmark::State& state) {
  equations(state, bench::paper(static_cast<int>(state.range(0))), false);
}
void masses(benchmark::State& state) {
  equations(state, near_masses(static_cast<int>(state.range(0))), true);
}

void equation_orders(benchmark::internal::Benchmark* b) {
  b->ArgName("H")->ArgsProduct({{1, 7, 15, 55}});
}

BENCHMARK(damper_alone)->Name("equations/element")->Apply(equation_orders);
BENCHMARK(odd)->Name("equations/odd")->Apply(equation_orders);
BENCHMARK(all)->Name("equations/all")->Apply(equation_orders);
BENCHMARK(masses)->Name("equations/masses")->Apply(equation_orders);

}  // namespace
