#pragma once
// The observables of an accepted solution of harmonic balance.

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/amplitude.hpp>
#include <arcslip/observables/force_components.hpp>
#include <arcslip/observables/sticking_at_reversal.hpp>
#include <arcslip/observables/truncation.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/stability/stability.hpp>
#include <arcslip/stability/stability_request.hpp>

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::observables {

/// Observes the points of branches of one problem in one of its parameters. Owns its buffers; one for each
/// thread.
class Observer {
 public:
  explicit Observer(std::shared_ptr<const hbm::HbmProblem> problem, int free = model::frequency);

  const hbm::HbmProblem& problem() const { return *problem_; }

  /// The solution at one point, with what is asked for. held: the kind of point for the truncation estimate.
  ResponsePoint observe(const continuation::Accepted& now, PointCondition held, const Observed& asked);
  /// The same of the next point of a branch, after the last ones, whose truncation estimates may become
  /// better known by it (SpacedEstimates).
  void observe_next(const continuation::Accepted& now, const Observed& asked,
                    std::vector<ResponsePoint>& points);

  /// From now on, points have their stability, where it is known.
  void watch_stability(const StabilityRequest& request = true) {
    stability_.emplace(request.by_hill);
    kept_multipliers_ = request.multipliers;
  }
  /// The multipliers at a point; null: not watched, or not known there.
  const StabilityAnalysis* stability(const continuation::Accepted& now);
  /// Why none of the points has any (StabilityAnalysis::unknown()).
  std::string unknown_stability() const { return stability_ ? stability_->unknown() : ""; }

  /// The solution and the observables of the motion alone: without phases, work of the excitation, parts of
  /// forces and what the harmonics left out would add. u, p: where `at` is.
  ResponsePoint motion(const hbm::HbmEvaluator& at, continuation::In u, const continuation::Vector& p);

  /// Largest |x| of the observed coordinate, for unknowns u at the parameters of an evaluator.
  Extreme extreme(const hbm::HbmEvaluator& at, continuation::In u);

  /// dA for changes du of the unknowns and dp_k of parameters k.
  double amplitude_change(const hbm::HbmEvaluator& at, continuation::In u, continuation::In du,
                          std::initializer_list<std::pair<int, double>> dp);

  /// A at the last call of any of these.
  double last_amplitude() const { return last_.amplitude; }

  /// Its Extreme::part().
  std::uint64_t last_part() const { return last_.part(); }

  /// dA/ds along the branch.
  double amplitude_slope(const continuation::Accepted& now);

 private:
  double phase(continuation::In p, continuation::In x) const;
  void add_named_responses(const hbm::HbmEvaluator& at, continuation::In u, continuation::In p,
                           ResponsePoint& point);
  ResponsePoint observe_as(const continuation::Accepted& now, PointCondition held, const Observed& asked);
  void add_solution(const hbm::HbmEvaluator& at, continuation::In u, const continuation::Vector& p,
                    Solution& solution);
  void add_motion(const hbm::HbmEvaluator& at, continuation::In u, const continuation::Vector& p,
                  ResponsePoint& point);
  ElementResponse element(const hbm::HbmEvaluator& at, std::size_t e);
  void add_maxima(const hbm::HbmEvaluator& at, ResponsePoint& point);
  void estimate_truncation(const continuation::Accepted& now, PointCondition held, ResponsePoint& point);
  void add_stability(const continuation::Accepted& now, ResponsePoint& point);
  void estimate_stick(const continuation::Accepted& now, ResponsePoint& point);

  std::shared_ptr<const hbm::HbmProblem> problem_;
  int free_;
  Amplitude amplitude_;
  Eigen::MatrixXd named_;          // d^T P, a row for each place of the named responses
  Eigen::MatrixXd named_motions_;  // coefficients of each, at the last place
  Stops stops_;
  std::unique_ptr<Truncation> truncation_;  // created at the first observe()
  SpacedEstimates spaced_;
  std::unique_ptr<Maxima> maxima_;  // created at the first request
  std::optional<StabilityAnalysis> stability_;
  continuation::Vector stable_u_, stable_p_;  // the place of its last call
  bool stability_known_ = false;
  int kept_multipliers_ = 0;
  continuation::Vector x_, dx_, by_parameter_;
  Extreme last_;
};

/// Peaks: dA/ds falls through zero. Unlike dA/domega it has no pole at folds.
continuation::Monitor peak_monitor(std::shared_ptr<Observer> observer);

/// Losses of stability of the branches that it watches (Observer::watch_stability()).
std::vector<continuation::Monitor> stability_monitors(const std::shared_ptr<Observer>& observer);

}  // namespace arcslip::observables
