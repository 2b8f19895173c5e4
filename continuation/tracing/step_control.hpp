#pragma once
// Step size control and prediction: section 8.4 of the theory. Not installed.

#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/continuation/tracing/state.hpp>
#include <arcslip/continuation/tracing/trial_step.hpp>

#include <string>

namespace arcslip::continuation {

class StepControl {
 public:
  /// All outlive this.
  StepControl(const Options& options, const State& state, const Corrector& corrector)
      : options_(options), s_(state), in_(corrector) {}

  /// The step below which a trace ends.
  double smallest() const;
  /// A sentence, if an option allows none but shorter steps here.
  std::string option_below_smallest() const;
  /// |dp| of a step at most.
  double largest_parameter_step() const;
  /// A step cut to what the options allow.
  double limited(double ds) const;

  /// By the cubic through the last two points, or by the tangent after a kink, at the start or far out.
  void predict(Vector& v) const;

  /// The step after an accepted one.
  double after(const TrialStep& trial) const;
  /// Factor of the step after a rejection with a converged corrector.
  double share_after_unresolved(const TrialStep& trial) const;

 private:
  double error_growth(const TrialStep& trial) const;

  const Options& options_;
  const State& s_;
  const Corrector& in_;
};

}  // namespace arcslip::continuation
