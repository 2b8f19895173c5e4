#pragma once
// From an accepted solution of harmonic balance to what an engineer reads off it.

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/amplitude.hpp>
#include <arcslip/observables/force_components.hpp>
#include <arcslip/observables/response.hpp>
#include <arcslip/observables/truncation.hpp>

#include <initializer_list>
#include <memory>
#include <utility>

namespace arcslip::observables {

/// Observes the points of branches of one problem in one of its parameters. Owns its buffers; one for each
/// thread.
class Observer {
 public:
  explicit Observer(std::shared_ptr<const hbm::HbmProblem> problem, int free = model::frequency);

  const hbm::HbmProblem& problem() const { return *problem_; }

  /// Everything at one point. held: whose change the truncation estimate is asked for. The maxima, which take
  /// longer than all else, are there at events and other special points, or where they are asked for.
  ResponsePoint observe(const continuation::Accepted& now, HeldBy held = HeldBy::parameter) {
    return observe(now, held, held != HeldBy::parameter);
  }
  ResponsePoint observe(const continuation::Accepted& now, HeldBy held, bool maxima);

  /// Largest |x| of the observed coordinate, for unknowns u at the parameters of an evaluator.
  Extreme extreme(const hbm::HbmEvaluator& at, continuation::In u);

  /// dA for changes du of the unknowns and dp_k of parameters k.
  double amplitude_change(const hbm::HbmEvaluator& at, continuation::In u, continuation::In du,
                          std::initializer_list<std::pair<int, double>> dp);

  /// A at the last call of any of these.
  double last_amplitude() const { return last_amplitude_; }

  /// Which reversal it was.
  std::size_t last_reversal() const { return last_reversal_; }

  /// dA/ds along the branch.
  double amplitude_slope(const continuation::Accepted& now);

 private:
  double phase(const continuation::Accepted& now, continuation::In x) const;
  void add_named_responses(const continuation::Accepted& now, ResponsePoint& point);

  std::shared_ptr<const hbm::HbmProblem> problem_;
  int free_;
  Amplitude amplitude_;
  Eigen::MatrixXd named_;                   // d^T P, a row for each response that the scene names
  std::unique_ptr<Truncation> truncation_;  // made at the first observe()
  std::unique_ptr<Maxima> maxima_;          // when first asked for
  continuation::Vector x_, dx_, by_parameter_;
  double last_amplitude_ = 0;
  std::size_t last_reversal_ = 0;
};

/// Peaks: dA/ds falls through zero. There is no pole at folds, as dA/domega has.
continuation::Monitor peak_monitor(std::shared_ptr<Observer> observer);

}  // namespace arcslip::observables
