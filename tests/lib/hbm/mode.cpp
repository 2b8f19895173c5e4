// The equations of nonlinear modes: their derivatives, and motions that satisfy them, put into the equations
// of the forced structure.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/hbm/mode.hpp>
#include <arcslip/hbm/mode_start.hpp>

using namespace arcslip;
using continuation::Needs;
using continuation::Vector;

namespace {

std::shared_ptr<const model::Model> free_model(const scene::Scene& s) {
  return std::make_shared<const model::Model>(hbm::without_excitation(model::build(s)));
}

struct Worst {
  double unknowns = 0, omega = 0, zeta = 0, amplitude = 0;
};

// Largest differences of the derivatives from central differences, relative to the largest entries of the
// column, or of J.
Worst worst_derivative(const hbm::ModeProblem& problem, const Vector& u, double log_amplitude) {
  const auto at = problem.evaluator();
  const Eigen::Index n = u.size() - 2;
  const auto residual = [&](const Vector& v, double a) {
    REQUIRE(at->move_to(v, Vector::Constant(1, a), Needs::residual) == continuation::Evaluated::ok);
    return at->residual();
  };
  REQUIRE(at->move_to(u, Vector::Constant(1, log_amplitude), Needs::jacobian) == continuation::Evaluated::ok);
  const auto J = std::get<Eigen::MatrixXd>(at->jacobian());
  Vector by_amplitude(u.size());
  at->parameter_derivative(0, by_amplitude);
  const auto piece = at->piece();
  constexpr double step = 1e-6;
  Worst worst;
  const auto compare = [&](const Vector& plus, const Vector& minus, const Vector& derivative, double size) {
    return ((plus - minus) / (2 * step) - derivative).cwiseAbs().maxCoeff() / size;
  };
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const Vector plus = residual(u + step * Vector::Unit(u.size(), i), log_amplitude);
    REQUIRE(at->piece() == piece);
    const Vector minus = residual(u - step * Vector::Unit(u.size(), i), log_amplitude);
    double& result = i < n ? worst.unknowns : i == n ? worst.omega : worst.zeta;
    const double size = i < n ? J.leftCols(n).cwiseAbs().maxCoeff() : J.col(i).cwiseAbs().maxCoeff();
    result = std::max(result, compare(plus, minus, J.col(i), size));
  }
  worst.amplitude = compare(residual(u, log_amplitude + step), residual(u, log_amplitude - step),
                            by_amplitude, J.leftCols(n).cwiseAbs().maxCoeff());
  return worst;
}

}  // namespace

TEST_CASE(
    "derivatives of the equations of a mode are those of central differences, with and without a mean") {
  for (const bool even : {false, true}) {
    scene::Scene s = scenes::chain(5, even);
    const auto model = free_model(s);
    for (const double amplitude : {0.02, 0.7, 30.0}) {
      const auto motions = std::make_shared<const hbm::HbmProblem>(model, model->harmonics, amplitude, 1.0);
      Vector rest = Vector::Zero(motions->size());
      if (even) rest[0] = 0.3 * amplitude;
      const hbm::ModeProblem problem(motions, rest, 1.1);
      std::srand(5);
      Vector u = Vector::Random(problem.size());
      const auto& h = motions->harmonics();
      for (int i = 0; i < motions->size(); ++i) {
        const int k = i % h.size();
        const int n = k < h.cosines() ? h.cosine_order(k) : h.sine_order(k - h.cosines());
        u[i] /= std::max(1, n * n);
      }
      u[motions->size()] = 0.2;
      u[motions->size() + 1] = 0.13;
      const Worst worst = worst_derivative(problem, u, std::log(amplitude));
      CAPTURE(even, amplitude);
      CHECK(worst.unknowns < 1e-8);
      CHECK(worst.omega < 1e-8);
      CHECK(worst.zeta < 1e-8);
      CHECK(worst.amplitude < 1e-8);
    }
  }
}

TEST_CASE(
    "half the way of a motion between its extremes is that of samples, and its slope that of differences") {
  for (const bool odd : {false, true}) {
    const elements::Harmonics h{7, odd, 1};
    hbm::HalfRange range(h);
    std::srand(2);
    for (int k = 0; k < 20; ++k) {
      Vector x = Vector::Random(h.size());
      double highest = -1e300, lowest = 1e300;
      for (int i = 0; i < 20000; ++i) {
        const double value = elements::series_values(h, x, 2 * std::numbers::pi * i / 20000).x;
        highest = std::max(highest, value);
        lowest = std::min(lowest, value);
      }
      CHECK(range.of(x) == Approx(0.5 * (highest - lowest)).epsilon(1e-5));
      const Vector gradient = range.gradient(), dx = Vector::Random(h.size());
      const double slope = (range.of(x + 1e-6 * dx) - range.of(x - 1e-6 * dx)) / 2e-6;
      CHECK(gradient.dot(dx) == Approx(slope).epsilon(1e-7).margin(1e-8));
    }
    CHECK(range.of(Vector::Zero(h.size())) == 0);
  }
}
