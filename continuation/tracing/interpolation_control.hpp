#pragma once
// Whether a step resolves the curve along it, its kinks, and the extrema of monitored quantities.
// Sections 8.4 and 8.5 of the theory. Not installed.

#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/continuation/correction/kink_location.hpp>
#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/continuation/tracing/state.hpp>
#include <arcslip/continuation/tracing/trial_step.hpp>

#include <vector>

namespace arcslip::continuation {

class InterpolationControl {
 public:
  /// All outlive this.
  InterpolationControl(const Options& options, const std::vector<Monitor>& monitors, bool looks_for_kinks,
                       State& state, Corrector& corrector)
      : options_(options),
        monitors_(monitors),
        looks_for_kinks_(looks_for_kinks),
        s_(state),
        main_(corrector) {}

  /// Whether a step between two pieces may go over its kinks as if it were smooth, as they turn the branch
  /// too little to change the sign of any monitored slope, or to be seen. Decided by the distance of the
  /// branch from the cubic. With StepOptions::pass_kinks the curve alone decides where no slope has an event.
  /// Fills passes_kinks, and then curve_error, above 1 where a shorter step may pass.
  bool passes_kinks(TrialStep& trial);

  /// To which the kinks of a step are located that it may not pass.
  double kink_accuracy() const { return by_curve_alone() ? kink_of_curve : finest_kink; }

  /// Fills curve_error, the largest error of the cubics along the smooth pieces relative to the tolerance,
  /// and other_piece_between.
  void measure_curve(TrialStep& trial);

  /// Whether the step contains kinks that were not found, two between ends on one piece or one that is hard
  /// to locate: then it is shortened, down to a limit, as the cubic may touch another piece where the branch
  /// does not.
  bool misses_kinks(const TrialStep& trial);

  /// Whether each monitored quantity has no more extrema in the step than implied by its slopes at the ends
  /// of the sections. Next to a kink a slope may bend however short the step: within one stretch of the
  /// branch the step is shortened to a fixed fraction of the first one at most. Fills chord_error and
  /// unresolved.
  bool resolves_quantities(TrialStep& trial);

  /// Whether steps have been shortened enough in an unresolved stretch of the branch.
  bool stretch_is_short(double share) const;
  void begin_stretch(double length);

 private:
  /// passes_kinks: whether there are any, and the curve alone decides.
  double curve_error(const CurvePoint& from, TrialStep& trial, const CurvePoint& to, bool& passes_kinks);
  double allowed_error(const CurvePoint& from, const CurvePoint& to) const;
  bool passes_by_curve(TrialStep& trial);
  bool by_curve_alone() const;
  double departure_across_kinks(const CurvePoint& from, const CurvePoint& to, double most);
  bool has_no_event(const CurvePoint& from, const CurvePoint& to) const;
  bool keeps_signs(const CurvePoint& from, const CurvePoint& to, double turn) const;
  bool resolves(const CurvePoint& from, const CurvePoint& to, TrialStep& trial) const;
  double chord_departure(const CurvePoint& from, const CurvePoint& to, std::size_t m, double length) const;

  const Options& options_;
  const std::vector<Monitor>& monitors_;
  bool looks_for_kinks_;
  State& s_;
  Corrector& main_;
  Vector middle_;
};

}  // namespace arcslip::continuation
