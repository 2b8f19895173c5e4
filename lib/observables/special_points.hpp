#pragma once
// Special points of one branch over the excitation frequency, peaks or folds: where curves of them begin.

#include <arcslip/observables/frequency_branch.hpp>
#include <arcslip/observables/over_parameter.hpp>

#include <memory>
#include <string>
#include <vector>

namespace arcslip::observables {

struct SpecialPoint {
  std::shared_ptr<const hbm::HbmProblem> problem;  // in the scale of the branch it was found on
  double over = 0;                                 // the parameter
  continuation::Vector x;                          // unknowns and frequency
  bool nonsmooth = false;
};

struct SpecialPoints {
  std::vector<SpecialPoint> points;
  std::string unbounded;  // why a resonance has no bound, which is no peak that could be followed
  std::string failure;    // why the branch does not cover the window: points may be missing
};

/// Those in a frequency window where the parameter has the value `over`. kind: the event, event_kinds::peak
/// or fold.
/// What is found until go_on says false is right, but not all.
SpecialPoints special_points(const OverParameter& way, double over, const FrequencyWindow& window,
                             const std::string& kind, const GoOn& go_on = {});

}  // namespace arcslip::observables
