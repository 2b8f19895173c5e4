#pragma once
// A branch through its start, in both directions.
//
//   const WholeBranch whole = trace_both(problem, {.u = u0, .p = p0}, {.lower = -1, .upper = 1},
//   {fold_monitor()});
//
// One trace leaves the start in its direction, another one in the opposite direction, and both are joined. No
// branch points are looked for but those that are monitored (trace_diagram() follows all branches that
// cross).

#include <arcslip/continuation/tracing/tracer.hpp>

#include <memory>
#include <vector>

namespace arcslip::continuation {

struct WholeBranch {
  Branch branch;     // in the start's direction; arclength is 0 at the start and negative before it
  BranchStop begin;  // how it ended backward; equal to branch.stop if it is closed, or the start failed
};

/// Options and observer serve each trace; the observer sees the way forward first, and if it returns false,
/// the way backward is not traced. Tangents before the start are reversed, so that they go with the branch;
/// `falling` and `rising` of a monitor refer to the direction away from the start. Throws as Tracer does.
WholeBranch trace_both(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
                       std::vector<Monitor> monitors = {}, Observer observer = {});

}  // namespace arcslip::continuation
