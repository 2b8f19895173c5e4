#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/hbm/steady_state.hpp>
#include <arcslip/hbm/stick_limit.hpp>

using namespace arcslip;
using continuation::Vector;

TEST_CASE("the stick limit's gradient, and its change with every parameter, are those of differences") {
  for (const bool even : {false, true}) {
    const auto model = std::make_shared<const model::Model>(model::build(scenes::chain(4, even)));
    const hbm::HbmProblem problem(model, model->harmonics, 1, 1);
    const int n = problem.size();
    const Vector u = Vector::Random(n), p = hbm::parameters_at(problem, 0.8);
    for (const int element : {0, 1}) {
      CAPTURE(even, element);
      hbm::StickLimit limit(problem, element);
      Vector dh(n), unused(n);
      REQUIRE(limit.at(u, p, dh));
      const auto difference = [&](const Vector& du, const Vector& dp) {
        return (*limit.at(u + du, p + dp, unused) - *limit.at(u - du, p - dp, unused)) / 2e-6;
      };
      for (int i = 0; i < n; ++i)
        CHECK(std::abs(dh[i] - difference(1e-6 * Vector::Unit(n, i), Vector::Zero(p.size()))) < 1e-9);
      for (int k = 0; k < p.size(); ++k) {
        limit.at(u, p, unused);
        const double by_parameter = limit.parameter_derivative(k);
        CHECK(std::abs(by_parameter - difference(Vector::Zero(n), 1e-6 * Vector::Unit(p.size(), k))) < 1e-9);
      }
    }
  }
}

TEST_CASE("the paper's oscillator is at the stick limit where the stuck oscillator's amplitude is mu Fn/kd") {
  // h = kd A - mu Fn with A = f0/|k + kd - m w^2 + i c w|.
  const auto model = std::make_shared<const model::Model>(model::build(scenes::paper(7, 3)));
  const auto problem = std::make_shared<const hbm::HbmProblem>(model, model->harmonics, 1e-3, 1);
  for (const double w : {110.0, 125.0, 140.0}) {
    const Vector p = hbm::parameters_at(*problem, w);
    Vector stuck = Vector::Zero(problem->size()), dh(problem->size());
    const std::complex<double> Z(21390 - 1.24 * w * w, 0.134 * w), X = 1.0 / Z;
    const auto& h = model->harmonics;
    stuck[h.cosine_index(1)] = X.real();
    stuck[h.sine_index(1)] = -X.imag();
    hbm::StickLimit limit(*problem, 0);
    CHECK(std::abs(*limit.at(stuck, p, dh) - (3500 * std::abs(X) - 1.5)) < 1e-12);
    CHECK(limit.limit() == 1.5);
  }
}
