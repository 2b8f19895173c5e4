// The equations of nonlinear modes: their derivatives, and motions that satisfy them, put into the equations
// of the forced structure.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/continuation/tracing/tracer.hpp>
#include <arcslip/hbm/mode.hpp>
#include <arcslip/hbm/mode_start.hpp>

#include <cmath>

using namespace arcslip;
using continuation::Needs;
using continuation::Vector;

namespace {

std::shared_ptr<const model::Model> free_model(const scene::Scene& s) {
  return std::make_shared<const model::Model>(hbm::without_excitation(model::build(s)));
}

struct Worst {
  double unknowns = 0, omega = 0, zeta = 0, ratio = 0, amplitude = 0;
};

// Largest differences of the derivatives from central differences, relative to the largest entries of the
// column, or of J.
Worst worst_derivative(const hbm::ModeProblem& problem, const Vector& u, double log_amplitude) {
  const auto at = problem.evaluator();
  const Eigen::Index n = u.size() - 3;
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
    double& result = i < n ? worst.unknowns : i == n ? worst.omega : i == n + 1 ? worst.zeta : worst.ratio;
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
      u[problem.log_ratio()] *= 0.5;
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
      CHECK(worst.ratio < 1e-8);
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

namespace {

// The largest residual, over all harmonics and degrees of freedom, of
//
//   M x'' + C x' + K x + f(x) = 2 zeta omega M x' + static loads,
//
// put together from the matrices and the forces of the elements without any condensation, over the largest
// K x.
double residual_of_motion(const hbm::ModeProblem& problem, const Vector& u, double log_amplitude) {
  hbm::ModeEvaluator at(problem);
  REQUIRE(at.move_to(u, Vector::Constant(1, log_amplitude), Needs::residual) == continuation::Evaluated::ok);
  const hbm::HbmProblem& motions = problem.motions();
  const model::Model& model = motions.model();
  const Vector p = model::defaults(model);
  const Eigen::MatrixXd M = model::mass_matrix(model, p), C = model::damping_matrix(model, p),
                        K = model::stiffness_matrix(model, p);
  const auto& h = motions.harmonics();
  const Eigen::MatrixXd x = at.motion().stiffness().motion(motions.coordinates().P, at.unknowns(), 1);
  Eigen::MatrixXd R(x.rows(), x.cols()), slope = R, bend = R;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    elements::series_slope(h, x.col(i), slope.col(i));
    elements::series_slope(h, slope.col(i), bend.col(i));
  }
  const double w = at.omega();
  R = w * w * bend * M + w * slope * (C - 2 * at.damping_ratio() * w * M) + x * K;
  for (std::size_t e = 0; e < model.elements.size(); ++e)
    for (std::size_t i = 0; i < model.elements[e].directions.size(); ++i)
      R += at.motion().element(e).force().segment(static_cast<Eigen::Index>(i) * h.size(), h.size()) *
           Eigen::RowVectorXd(Vector(model.elements[e].directions[i]).transpose());
  for (const auto& load : model.excitation)
    R.row(0) -= load.cosine.value(p) * Eigen::RowVectorXd(Vector(load.direction).transpose());
  return R.cwiseAbs().maxCoeff() / (x * K).cwiseAbs().maxCoeff();
}

// Traced from a start at `from` to each of these amplitudes.
void check_motions(const scene::Scene& s, int mode, double from, double to) {
  const auto start = hbm::mode_start(free_model(s), model::build(s), mode, from);
  INFO(start.no_mode << start.failure);
  REQUIRE((start.no_mode.empty() && start.failure.empty()));
  continuation::Options options;
  options.lower = std::log(start.amplitude);
  options.upper = std::log(to);
  const auto branch = continuation::trace(
      start.problem, {start.u, Vector::Constant(1, options.lower), 0, 1}, options,
      {continuation::bound_monitor("outgrown", start.problem->log_ratio(), std::log(1e3))});
  INFO(branch.stop.message);
  // Elements may come to hold a mass of the chain, whose amplitude then stays below `to`.
  REQUIRE((branch.stop.reason == continuation::StopReason::boundary ||
           branch.stop.reason == continuation::StopReason::event));
  CHECK(branch.warnings.empty());
  double worst = 0;
  for (const auto& point : branch.points)
    worst = std::max(worst, residual_of_motion(*start.problem, point.u, point.parameter));
  CAPTURE(mode, branch.points.size());
  CHECK(worst < 1e-12);
}

}  // namespace

TEST_CASE("motions of modes satisfy the equations of all degrees of freedom with the damping that balances") {
  check_motions(scenes::paper(55), 1, 1e-5, 0.1);
  for (const int mode : {1, 2, 3}) {
    check_motions(scenes::chain(9, false), mode, 1e-3, 30);
    scene::Scene s = scenes::chain(9, true);
    s.excitation.push_back(s.excitation.front());
    s.excitation.back().name = "weight";
    s.excitation.back().harmonic = 0;
    s.excitation.back().values = {0.4, 0};
    check_motions(s, mode, 1e-3, 30);
  }
}
