#pragma once
// The observables of an accepted periodic motion of shooting. Exact: nothing is truncated, so that estimates
// of truncation are 0; what belongs to Fourier series alone is absent (no_value).

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/stability/stability_request.hpp>
#include <arcslip/time/periodic/shooting_problem.hpp>

#include <complex>
#include <memory>
#include <optional>
#include <vector>

namespace arcslip::observables {

/// Observes the points of a branch over the frequency, or over another parameter. One for each thread.
class ShootingObserver {
 public:
  explicit ShootingObserver(std::shared_ptr<const time::ShootingProblem> problem, int free = model::frequency)
      : problem_(std::move(problem)), free_(free) {}

  bool is_over_frequency() const { return free_ == model::frequency; }

  ResponsePoint observe(const continuation::Accepted& now);

  /// From now on, points have their stability.
  void watch_stability(const StabilityRequest& request) { stability_ = request; }

  /// dA/ds along the branch, A the largest |x| of the response. At its instant x' = 0, so that only x at that
  /// instant changes.
  double amplitude_slope(const continuation::Accepted& now);
  /// A at the last call of it.
  double last_amplitude() const { return amplitude_; }

  const std::vector<std::complex<double>>& multipliers(const continuation::Accepted& now);

 private:
  void add_elements(const time::EventDrivenMotion& motion, const time::EquationOfMotion& equation,
                    ResponsePoint& point) const;

  std::shared_ptr<const time::ShootingProblem> problem_;
  int free_;
  StabilityRequest stability_{};
  double amplitude_ = 0;
  continuation::Matrix monodromy_;  // of the multipliers
  std::vector<std::complex<double>> multipliers_;
};

/// Peaks, or over another parameter than the frequency maxima and minima; folds; and with `watched` losses of
/// stability and branch points.
std::vector<continuation::Monitor> shooting_monitors(const std::shared_ptr<ShootingObserver>& observer,
                                                     const StabilityRequest& watched);

}  // namespace arcslip::observables
