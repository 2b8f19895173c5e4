#pragma once
// Special points of the responses over the excitation frequency, at one value of a parameter: the starts of
// their curves over it.

#include <arcslip/analyses/branches/all_branches.hpp>
#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/analyses/branches/parameter_trace.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/results/response.hpp>

#include <memory>
#include <string>
#include <vector>

namespace arcslip::observables {

struct SpecialPoint {
  std::shared_ptr<const hbm::HbmProblem> problem;  // in the scale of the branch it was found on
  double over = 0;                                 // the parameter
  continuation::Vector x;                          // unknowns and frequency
  bool nonsmooth = false;
  std::string kind{};  // of event_kinds
  double amplitude = 0;
};

/// Where another branch leaves the one that is looked at.
struct LeavingBranch {
  std::string kind;  // of event_kinds
  double omega = 0;  // rad/s
};

struct SpecialPoints {
  std::vector<SpecialPoint> points;
  std::string unbounded;                 // why a resonance is unbounded, and so has no peak
  std::string failure;                   // why a branch does not cover the window: points may be missing
  std::string unknown_stability{};       // why multipliers are not known
  int branches = 1;                      // that were looked at
  std::vector<std::string> untraced{};   // of all branches: those that were not followed, and why
  std::vector<LeavingBranch> leaving{};  // of one branch, where bifurcations are looked for: the others
  LookedAt looked_at{};                  // where bifurcations are looked for: the responses
};

/// Besides the branch from the response from rest at the lower end of a frequency window.
enum class OtherBranches {
  none,
  from_ends  // those of further responses at the ends: a window may begin or end within a hysteresis
};

/// The special points in a frequency window at the value `over` of the parameter, on the branch from its
/// lower end on, and on others. kinds: of events, event_kinds::peak, fold, or of_curves, for which
/// multipliers are computed and the branches that leave are reported. If `control` ends, the points
/// found so far.
SpecialPoints special_points(const OverParameter& way, double over, const FrequencyWindow& window,
                             const std::vector<std::string>& kinds, OtherBranches others,
                             const control::Control& control = {});

/// The same of all branches (analyses/branches/all_branches.hpp). If progress returns false, the points found
/// so far.
SpecialPoints special_points_of_all(const OverParameter& way, double over, const FrequencyWindow& window,
                                    const std::vector<std::string>& kinds, const BranchLimits& limits,
                                    scene::FrequencyUnit unit, const control::Control& control);

}  // namespace arcslip::observables
