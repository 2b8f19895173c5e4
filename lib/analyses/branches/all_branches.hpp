#pragma once
// The branches that leave a frequency response, those that leave these, and so on: at breaks of symmetry,
// period doublings and branch points, each traced once.
//
// A branch begins at a branch point of the branch it leaves, its parent, and ends at the window, where it is
// back at its start, or at the next branch point that it shares with a branch already known. Mirror images of
// motions and motions later by a period of the excitation are on the same branch. Docs: 14.4.

#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace arcslip::observables {

struct BranchLimits {
  int doublings = 2;       // of the period, in a row
  int most_branches = 20;  // with those given
  int searches = 0;        // frequencies at which branches that no other reaches are looked for
  friend bool operator==(const BranchLimits&, const BranchLimits&) = default;
};

/// A branch with its equations. events: all of its trace, of a branch that others may leave.
struct TracedBranch {
  ResponseBranch response;
  std::shared_ptr<const hbm::HbmProblem> problem;
  std::vector<continuation::Event> events;
};

/// What is common to all branches.
struct BranchOptions {
  FrequencyWindow window;  // rad/s
  scene::FrequencyUnit unit;
  BranchLimits limits;
  Steps steps = Steps::curve;
  Observed points{}, events = everything;
  control::Control control;
  std::function<void(double omega)> at;  // at each point, for the progress
};

/// The given branches, which need stability and branch points among their events, and all others. Branches
/// that were not followed are determined by ResponseBranch::untraced of the one they leave.
std::vector<TracedBranch> all_branches(std::vector<TracedBranch> given, const BranchOptions& following);

}  // namespace arcslip::observables
