// The equations of an optimum: their derivatives against differences, away from any solution.

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/optimize/curve/optimality.hpp>

#include <cmath>

using namespace arcslip;
using namespace arcslip::optimize;

namespace {

// Largest difference of the Jacobian, with the column of sigma, from central differences of the residual.
double jacobian_error(const OptimalityData& data, const Vector& z, double sigma) {
  const auto shared = std::make_shared<const OptimalityData>(data);
  const Eigen::Index n = z.size();
  OptimalityEvaluator at(shared);
  const auto residual = [&](const Vector& v) {
    const auto done = at.move_to(v.head(n), v.tail(1), continuation::Needs::residual);
    return done == continuation::Evaluated::ok ? at.residual() : Vector::Constant(n, HUGE_VAL).eval();
  };
  Vector v(n + 1);
  v << z, sigma;
  if (at.move_to(z, v.tail(1), continuation::Needs::jacobian) != continuation::Evaluated::ok) return HUGE_VAL;
  continuation::Matrix J(n, n + 1);
  Vector dE(n);
  at.parameter_derivative(0, dE);
  J << std::get<continuation::Matrix>(at.jacobian()), dE;
  const double h = 1e-5;
  for (Eigen::Index i = 0; i <= n; ++i) {
    Vector above = v, below = v;
    above[i] += h;
    below[i] -= h;
    J.col(i) -= (residual(above) - residual(below)) / (2 * h);
  }
  return J.cwiseAbs().maxCoeff();
}

struct TwoDampers {
  TwoDampers() {
    const scene::Scene s = scenes::example("two_dampers");
    const auto model = std::make_shared<const model::Model>(model::build(s));
    std::vector<int> over;
    for (const char* name : {"d1.normal_load", "d2.normal_load", "c1.value"})
      over.push_back(model::parameter_index(*model, name));
    const double unit = scene::to_rad_per_s(s.frequency_unit);
    peaks = std::make_unique<PeakAmplitude>(model, over, observables::FrequencyWindow{8 * unit, 45 * unit});
    peaks->trace(std::vector<double>{1.3, 1.5, 0.3});
  }
  std::unique_ptr<PeakAmplitude> peaks;
};

}  // namespace

TEST_CASE("the Jacobian of the optimum's equations is that of their differences") {
  TwoDampers two;
  REQUIRE(two.peaks->state().peaks.size() == 2);
  const ScaledParameter load(0.05, 50), linear(0, 4), damping(0.03, 30);
  const double t1 = load.scaled(1.3), t2 = load.scaled(1.5), s = damping.scaled(0.3);
  const double reference = two.peaks->state().amplitude();
  Vector both(4), one(3), held(3), unscaled(4);
  both << t1, t2, 0.3, 0.01;
  one << t1, t2, 0.02;
  held << t1, 0.6, -0.01;
  unscaled << linear.scaled(1.3), t2, 0.4, 0.0;
  CHECK(jacobian_error({*two.peaks, {load, load, damping}, {{0, 1}, {0, 0}}, reference}, both, s) < 1e-6);
  CHECK(jacobian_error({*two.peaks, {load, load, damping}, {{1}, {0, 0}}, reference}, one, s) < 1e-6);
  CHECK(jacobian_error({*two.peaks, {linear, load, damping}, {{0, 1}, {0, 0}}, reference}, unscaled, s) <
        1e-6);
  const ScaledParameter bounded(0.05, 1.5);
  CHECK(jacobian_error({*two.peaks, {load, bounded, damping}, {{1, 0}, {0, 1}}, reference}, held, s) < 1e-6);
}

TEST_CASE("parameters are scaled by their logarithm where their bounds allow it, and back") {
  for (const auto& [lower, upper, value] :
       {std::tuple{0.1, 10.0, 3.0}, {-10.0, -0.1, -3.0}, {0.0, 10.0, 3.0}, {-2.0, 10.0, -1.0}}) {
    const ScaledParameter scaled(lower, upper);
    CAPTURE(lower, upper);
    const double y = scaled.scaled(value), h = 1e-5;
    CHECK(scaled.value(y) == Approx(value).epsilon(1e-14));
    CHECK(scaled.scaled(upper) > scaled.scaled(lower));
    CHECK(scaled.slope(value) == Approx((scaled.value(y + h) - scaled.value(y - h)) / (2 * h)).epsilon(1e-8));
    const double second = (scaled.value(y + h) - 2 * value + scaled.value(y - h)) / (h * h);
    CHECK(scaled.second(value) == Approx(second).epsilon(1e-4).margin(1e-4));
  }
}
