// One evaluation of an element, all harmonics and the mean, of motions that slip.
//
//   element/LAW/H:N        exact, with the Jacobian
//   force/LAW/H:N          exact, the force alone
//   sampled/LAW/H:N        with the Jacobian, of as many steps in two periods as bring the coefficients of
//   the
//                          force to 1e-6 of the largest, and their projection by products of matrices
//   sampled_force/LAW/H:N  the force alone likewise
//
// The counter `samples` is that number of steps in a period.

#include "measure.hpp"
#include "sampled.hpp"

#include <arcslip/laws/contact/contact_2d.hpp>
#include <arcslip/laws/contact/contact_3d.hpp>
#include <arcslip/laws/hysteresis/iwan.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/laws/hysteresis/masing_element.hpp>
#include <arcslip/laws/memoryless/gap_spring.hpp>
#include <arcslip/scene/part_type.hpp>

#include <cmath>
#include <memory>
#include <random>

namespace {

using namespace arcslip;

struct Example {
  std::shared_ptr<const elements::Law> law;
  std::vector<double> fields;
};

Example jenkins() {
  return {elements::jenkins().law({}), {2, 0.5, 1}};
}
Example gap_spring() {
  return {elements::gap_spring().law({}), {2, 0.2}};
}
Example contact_2d() {
  return {elements::contact_2d().law({}), {2, 1.5, 0.5, 1}};
}
Example separating_contact_2d() {
  return {elements::contact_2d().law({}), {2, 1.5, 0.5, 0.3}};
}
Example contact_3d() {
  return {elements::contact_3d().law({}), {2, 1.5, 0.5, 1}};
}
Example separating_contact_3d() {
  return {elements::contact_3d().law({}), {2, 1.5, 0.5, 0.3}};
}
Example iwan() {
  return {elements::iwan().law({}), {2, 0.5}};
}

// Amplitudes that fall as n^-2, with a fundamental of 1.
Eigen::VectorXd motion(const elements::Harmonics& h, int directions) {
  std::mt19937 bits(1);
  std::uniform_real_distribution<double> number(-1, 1);
  Eigen::VectorXd u(directions * h.size());
  for (int i = 0; i < directions; ++i) {
    auto w = u.segment(i * h.size(), h.size());
    w[0] = 0.1 * number(bits);
    for (int n = 1; n <= h.order; ++n) {
      w[h.cosine_index(n)] = number(bits) / (n * n);
      w[h.sine_index(n)] = number(bits) / (n * n);
    }
    w[h.cosine_index(1)] = 1;
  }
  return u;
}

template <class Work>
void measure(benchmark::State& state, const Work& work) {
  bench::measure(state, work, bench::calls_to_time(work));
}

void element(benchmark::State& state, Example (*make)(), bool jacobian) {
  const auto [law, fields] = make();
  const elements::Harmonics h{static_cast<int>(state.range(0)), false};
  const auto element = law->element(h, {});
  const Eigen::VectorXd u = motion(h, law->directions());
  measure(state, [&] {
    element->move_to(u, fields, jacobian);
    benchmark::DoNotOptimize(element->force().data());
  });
}

// Of 100 sliders in a table.
void iwan_table(benchmark::State& state) {
  std::vector<elements::IwanSlider> sliders;
  for (int k = 1; k <= 100; ++k) sliders.emplace_back(0.02, 0.0003 * k);
  const elements::Harmonics h{static_cast<int>(state.range(0)), false};
  const auto element = elements::make_iwan_table(h, sliders);
  const Eigen::VectorXd u = motion(h, 1);
  const std::vector<double> factors = {1, 1};
  measure(state, [&] {
    element->move_to(u, factors, true);
    benchmark::DoNotOptimize(element->jacobian().data());
  });
}

void sampled_element(benchmark::State& state, Example (*make)(), bool jacobian) {
  const Example example = make();
  const elements::Harmonics h{static_cast<int>(state.range(0)), false};
  const Eigen::VectorXd u = motion(h, example.law->directions());
  const auto exact = example.law->element(h, {});
  exact->move_to(u, example.fields, false);
  const double most = exact->force().cwiseAbs().maxCoeff();
  int samples = 64;
  std::unique_ptr<bench::Sampled> sampled;
  for (;; samples = samples * 5 / 4) {
    sampled = std::make_unique<bench::Sampled>(*example.law, example.fields, h, samples);
    const Eigen::MatrixXd& F = sampled->coefficients(u);
    if ((F.reshaped() - exact->force()).cwiseAbs().maxCoeff() < 1e-6 * most) break;
  }
  measure(state, [&] { benchmark::DoNotOptimize(sampled->coefficients(u, jacobian).data()); });
  state.counters["samples"] = samples;
}

void element_orders(benchmark::internal::Benchmark* b) {
  b->ArgName("H")->ArgsProduct({{3, 7, 15, 27, 55}});
}

constexpr bool with_jacobian = true, force_alone = false;

BENCHMARK_CAPTURE(element, jenkins, jenkins, with_jacobian)->Apply(element_orders);
BENCHMARK_CAPTURE(element, gap_spring, gap_spring, with_jacobian)->Apply(element_orders);
BENCHMARK_CAPTURE(element, contact_2d, contact_2d, with_jacobian)->Apply(element_orders);
BENCHMARK_CAPTURE(element, separating_contact_2d, separating_contact_2d, with_jacobian)
    ->Apply(element_orders);
BENCHMARK_CAPTURE(element, contact_3d, contact_3d, with_jacobian)->Apply(element_orders);
BENCHMARK_CAPTURE(element, separating_contact_3d, separating_contact_3d, with_jacobian)
    ->Apply(element_orders);
BENCHMARK_CAPTURE(element, iwan, iwan, with_jacobian)->Apply(element_orders);
BENCHMARK(iwan_table)->Name("element/iwan_table_100")->Apply(element_orders);

#define ARCSLIP_AND_SAMPLED(law)                                                                             \
  BENCHMARK_CAPTURE(element, law, law, force_alone)->Name("force/" #law)->Apply(element_orders);             \
  BENCHMARK_CAPTURE(sampled_element, law, law, with_jacobian)->Name("sampled/" #law)->Apply(element_orders); \
  BENCHMARK_CAPTURE(sampled_element, law, law, force_alone)                                                  \
      ->Name("sampled_force/" #law)                                                                          \
      ->Apply(element_orders)
ARCSLIP_AND_SAMPLED(jenkins);
ARCSLIP_AND_SAMPLED(gap_spring);
ARCSLIP_AND_SAMPLED(contact_2d);
ARCSLIP_AND_SAMPLED(separating_contact_2d);
ARCSLIP_AND_SAMPLED(separating_contact_3d);

}  // namespace
