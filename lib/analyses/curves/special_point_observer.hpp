#pragma once
// A point of a curve of special points as a point of the branch over the excitation frequency through it, for
// its observables and the slope of the amplitude along the curve.

#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>
#include <arcslip/observables/observe.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace arcslip::observables {

/// For curves of stationary points of `problem` along the frequency, in one more parameter. Owns its buffers.
class CurveSection {
 public:
  CurveSection(std::shared_ptr<const hbm::HbmProblem> problem, int over);

  /// As Observer.
  void watch_stability(const StabilityRequest& request = true) { observer_.watch_stability(request); }
  std::string unknown_stability() const { return observer_.unknown_stability(); }

  /// All observables at a point of the curve, including `over`. truncation_estimate is 0 and flagged if the
  /// branch has no tangent.
  ResponsePoint observe(const continuation::Accepted& now, PointCondition held = PointCondition::extremum);

  /// What is asked for at a solution x = (u, omega) with all parameters p.
  ResponsePoint observe(continuation::In x, continuation::In p,
                        PointCondition held = PointCondition::extremum, const Observed& asked = everything);

  /// The multipliers at a point of the curve; null: not watched, or not known there.
  const StabilityAnalysis* stability(const continuation::Accepted& now);

  /// dA/ds along the curve.
  double amplitude_slope(const continuation::Accepted& now);

  /// A at the last call of either.
  double last_amplitude() const { return observer_.last_amplitude(); }

 private:
  bool move_to(continuation::In x, continuation::In p, continuation::Needs needs);
  bool linearize();

  std::shared_ptr<const hbm::HbmProblem> problem_;
  int over_;
  Observer observer_;
  std::unique_ptr<hbm::HbmEvaluator> evaluator_;
  std::unique_ptr<continuation::LinearSolver> solver_;
  continuation::Borders border_;
  continuation::Vector u_, p_, scales_, tangent_;
};

/// The extrema of the amplitude along a curve: `minimum` and `maximum`.
std::vector<continuation::Monitor> amplitude_monitors(const std::shared_ptr<CurveSection>& section);

/// The amplitude as the quantity whose stationary points are continued. instant: if set, the extremum of the
/// motion nearest to this angle in place of the largest, of a response at one place.
continuation::StationaryQuantity amplitude_quantity(
    const std::shared_ptr<const hbm::HbmProblem>& problem,
    std::shared_ptr<const std::optional<double>> instant = {});

}  // namespace arcslip::observables
