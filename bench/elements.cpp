// One evaluation of an element with its Jacobian, all harmonics and the mean, of motions that slip.
//
//   element/LAW/H:N               exact
//   sampled_element/LAW/H:N       the force alone of as many steps in two periods as bring its coefficients
//   to
//                                 1e-6 of the largest, and their projection; no Jacobian
//
// The counter `samples` is that number of steps in a period.

#include <arcslip/elements/contact_2d.hpp>
#include <arcslip/elements/gap_spring.hpp>
#include <arcslip/elements/iwan.hpp>
#include <arcslip/elements/jenkins.hpp>
#include <arcslip/elements/masing_element.hpp>
#include <arcslip/scene/part_type.hpp>

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <numbers>
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

void element(benchmark::State& state, Example (*make)()) {
  const auto [law, fields] = make();
  const elements::Harmonics h{static_cast<int>(state.range(0)), false};
  const auto element = law->element(h, {});
  const Eigen::VectorXd u = motion(h, law->directions());
  for (auto _ : state) {
    element->move_to(u, fields, true);
    benchmark::DoNotOptimize(element->jacobian().data());
  }
}

// Of 100 sliders in a table.
void iwan_table(benchmark::State& state) {
  std::vector<elements::Slider> sliders;
  for (int k = 1; k <= 100; ++k) sliders.emplace_back(0.02, 0.0003 * k);
  const elements::Harmonics h{static_cast<int>(state.range(0)), false};
  const auto element = elements::make_iwan_table(h, sliders);
  const Eigen::VectorXd u = motion(h, 1);
  const std::vector<double> factors = {1, 1};
  for (auto _ : state) {
    element->move_to(u, factors, true);
    benchmark::DoNotOptimize(element->jacobian().data());
  }
}

// Samples of the motion and their projection; two periods, of which the second counts.
class Sampled {
 public:
  Sampled(const Example& example, const elements::Harmonics& h, int samples)
      : law_(*example.law),
        fields_(example.fields),
        basis_(samples, h.size()),
        q_(samples, law_.directions()),
        f_(samples, law_.directions()),
        end_(law_.directions(), law_.memory()),
        z_(Eigen::VectorXd::Zero(law_.memory())) {
    Eigen::VectorXd phi(h.size());
    for (int s = 0; s < samples; ++s) {
      elements::series_basis(h, 2 * std::numbers::pi * s / samples, phi);
      basis_.row(s) = phi.transpose();
    }
  }

  const Eigen::MatrixXd& coefficients(const Eigen::VectorXd& u) {
    q_.noalias() = basis_ * u.reshaped(basis_.cols(), q_.cols());
    z_.setZero();
    at_ = q_.row(0).transpose();
    law_.begin(fields_, at_, z_, end_);
    force_ = end_.f;
    for (Eigen::Index k = 1; k <= 2 * q_.rows(); ++k) {
      const Eigen::Index s = k % q_.rows();
      dq_ = q_.row(s).transpose() - at_;
      law_.step(fields_, {at_, z_, force_}, dq_, end_);
      z_ += end_.dz;
      at_ = q_.row(s).transpose();
      force_ = end_.f;
      f_.row(s) = force_.transpose();
    }
    F_.noalias() = basis_.transpose() * f_;
    F_ *= 2.0 / static_cast<double>(q_.rows());
    F_.row(0) *= 0.5;
    return F_;
  }

 private:
  const elements::Law& law_;
  std::vector<double> fields_;
  Eigen::MatrixXd basis_, q_, f_, F_;
  elements::StepEnd end_;
  Eigen::VectorXd z_, at_, dq_, force_;
};

void sampled_element(benchmark::State& state, Example (*make)()) {
  const Example example = make();
  const elements::Harmonics h{static_cast<int>(state.range(0)), false};
  const Eigen::VectorXd u = motion(h, example.law->directions());
  const auto exact = example.law->element(h, {});
  exact->move_to(u, example.fields, false);
  const double most = exact->force().cwiseAbs().maxCoeff();
  int samples = 64;
  std::unique_ptr<Sampled> sampled;
  for (;; samples = samples * 5 / 4) {
    sampled = std::make_unique<Sampled>(example, h, samples);
    const Eigen::MatrixXd& F = sampled->coefficients(u);
    if ((F.reshaped() - exact->force()).cwiseAbs().maxCoeff() < 1e-6 * most) break;
  }
  for (auto _ : state) benchmark::DoNotOptimize(sampled->coefficients(u).data());
  state.counters["samples"] = samples;
}

void orders(benchmark::internal::Benchmark* b) {
  b->ArgName("H")->Arg(3)->Arg(7)->Arg(27)->Arg(55)->Unit(benchmark::kMicrosecond);
}

BENCHMARK_CAPTURE(element, jenkins, jenkins)->Apply(orders);
BENCHMARK_CAPTURE(element, gap_spring, gap_spring)->Apply(orders);
BENCHMARK_CAPTURE(element, contact_2d, contact_2d)->Apply(orders);
BENCHMARK_CAPTURE(element, separating_contact_2d, separating_contact_2d)->Apply(orders);
BENCHMARK_CAPTURE(element, iwan, iwan)->Apply(orders);
BENCHMARK(iwan_table)->Name("element/iwan_table_100")->Apply(orders);
BENCHMARK_CAPTURE(sampled_element, jenkins, jenkins)->Apply(orders);
BENCHMARK_CAPTURE(sampled_element, gap_spring, gap_spring)->Apply(orders);
BENCHMARK_CAPTURE(sampled_element, contact_2d, contact_2d)->Apply(orders);
BENCHMARK_CAPTURE(sampled_element, separating_contact_2d, separating_contact_2d)->Apply(orders);

}  // namespace
