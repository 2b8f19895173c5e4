#include <arcslip/time/periodic/shooting.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/time/periodic/periodicity_conditions.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace arcslip::time {
namespace {

constexpr double multiplier_rounding = 1e-10;  // |multiplier| above 1 by less is rounding
constexpr double at_rounding = 16 * std::numeric_limits<double>::epsilon();
constexpr double singular_step = 64 * std::numeric_limits<double>::epsilon();
constexpr double least_step = 1.0 / 32;

class Shooting {
 public:
  Shooting(const Flow& flow, const MotionState& start, double omega, const ShootingOptions& options)
      : flow_(flow),
        options_(options),
        n_(start.x.size()),
        y_(stacked(start)),
        scale_(Vector::Ones(y_.size())) {
    scale_.segment(n_, n_).setConstant(omega);
  }

  ShootingResult run() {
    if (!settle(options_.transients) || !evaluate(y_, result_.map, defect_))
      return end(ShootingEnd::flow_failed);
    int rest = 1;  // periods of the motion itself, where Newton's method fails
    for (; result_.iterations < options_.iterations; ++result_.iterations) {
      if (!defect_.allFinite() || !result_.map.monodromy.allFinite()) return end(ShootingEnd::not_finite);
      const Vector step = newton_step();
      const double size = std::max(norm(y_), result_.map.size);
      result_.correction = size > 0 ? norm(step) / size : 0;
      result_.defect = size > 0 ? norm(defect_) / size : 0;
      const bool explained = unexplained_ <= 1e-6 * norm(defect_);
      if ((explained && result_.correction <= options_.tolerance) || result_.defect <= at_rounding) {
        y_ += step;
        return end(ShootingEnd::converged);
      }
      if (explained && descend(step)) continue;
      if (!settle(rest) || !evaluate(y_, result_.map, defect_)) return end(ShootingEnd::flow_failed);
      rest = std::min(2 * rest, 64);
    }
    return end(ShootingEnd::iterations);
  }

 private:
  double norm(const Vector& y) const { return y.cwiseQuotient(scale_).norm(); }

  bool evaluate(const Vector& y, PeriodMap& map, Vector& defect) {
    ++result_.maps;
    map = flow_(unstacked(y, n_));
    if (!map.done) {
      result_.map = map;
      return false;
    }
    defect_of(map, y, defect);
    return true;
  }

  bool settle(int periods) {
    for (int k = 0; k < periods; ++k) {
      if (!evaluate(y_, result_.map, defect_)) return false;
      y_ = stacked(result_.map.end);
    }
    return true;
  }

  // The minimum-norm solution if I - M is singular to rounding of M: an unsupported structure has a motion at
  // every position, an undamped one in resonance has none, and part of the defect remains.
  Vector newton_step() {
    Matrix J;
    defect_by_start(result_.map, J);
    J = -(scale_.cwiseInverse().asDiagonal() * J * scale_.asDiagonal());
    const Vector defect = defect_.cwiseQuotient(scale_);
    const double smallest = singular_step * std::max(1.0, (Matrix::Identity(J.rows(), J.cols()) - J).norm());
    const double largest = J.colwise().norm().maxCoeff();
    const double threshold = largest > smallest ? smallest / largest : 1.0;
    const Vector step = continuation::shortest_least_squares(J, defect, threshold).X;
    unexplained_ = (J * step - defect).norm();
    return step.cwiseProduct(scale_);
  }

  bool descend(const Vector& step) {
    for (double part = 1; part >= least_step; part /= 2) {
      const Vector y = y_ + part * step;
      PeriodMap map;
      Vector defect;
      if (!evaluate(y, map, defect)) continue;
      if (!(norm(defect) < (1 - 0.25 * part) * norm(defect_))) continue;
      y_ = y;
      result_.map = std::move(map);
      defect_ = defect;
      return true;
    }
    return false;
  }

  ShootingResult end(ShootingEnd reason) {
    result_.reason = reason;
    result_.start = unstacked(y_, n_);
    if (reason == ShootingEnd::converged) multipliers();
    std::ostringstream text;
    switch (reason) {
      case ShootingEnd::converged:
        text << "relative correction " << result_.correction << ", defect " << result_.defect << " after "
             << result_.iterations << " Newton steps and " << result_.maps << " periods";
        break;
      case ShootingEnd::iterations:
        text << "no periodic motion after " << result_.iterations << " Newton steps and " << result_.maps
             << " periods: relative correction " << result_.correction << " (tolerance " << options_.tolerance
             << "), defect " << result_.defect
             << ". An undamped resonance has none; a start from harmonic balance, or after more periods of "
                "integration, may find one.";
        break;
      case ShootingEnd::flow_failed:
        text << "the integration over a period failed: " << result_.map.message;
        break;
      case ShootingEnd::not_finite:
        text << "the Newton correction is not finite";
        break;
    }
    result_.message = text.str();
    return std::move(result_);
  }

  void multipliers() {
    result_.multipliers = multipliers_of(result_.map);
    result_.stable =
        result_.multipliers.empty() || std::abs(result_.multipliers.front()) < 1 - multiplier_rounding;
  }

  const Flow& flow_;
  const ShootingOptions& options_;
  Eigen::Index n_;
  Vector y_, scale_, defect_;
  double unexplained_ = 0;
  ShootingResult result_;
};

}  // namespace

ShootingResult shoot(const Flow& flow, const MotionState& start, double omega,
                     const ShootingOptions& options) {
  return Shooting(flow, start, omega, options).run();
}

PeriodicMotion periodic_motion(EventDriven& integrator, const MotionState& start,
                               const ShootingOptions& options, std::span<const double> instants) {
  const double period = options.periods * integrator.equation().period();
  const Flow flow = [&](const MotionState& state) { return integrator.map(state, period); };
  PeriodicMotion motion{shoot(flow, start, integrator.equation().omega, options), {}};
  if (motion.converged()) motion.period = integrator.integrate(motion.shooting.start, 0, period, instants);
  return motion;
}

}  // namespace arcslip::time
