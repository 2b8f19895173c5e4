#include <arcslip/continuation/diagrams/branch_parts.hpp>
#include <arcslip/continuation/diagrams/diagram.hpp>

#include <utility>

namespace arcslip::continuation {

WholeBranch trace_both(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
                       std::vector<Monitor> monitors, Observer observer) {
  WholeBranch whole;
  Branch forward = trace(problem, start, options, monitors, observer);
  whole.begin = forward.stop;
  const bool ends = forward.points.empty() || forward.stop.reason == StopReason::closed ||
                    forward.stop.reason == StopReason::user;
  if (ends) {
    whole.branch = std::move(forward);
    return whole;
  }
  Start opposite = start;
  opposite.direction = -start.direction;
  opposite.tangent = -start.tangent;
  whole.branch = trace(std::move(problem), opposite, options, std::move(monitors), std::move(observer));
  whole.begin = whole.branch.stop;
  reverse(whole.branch);
  if (!whole.branch.points.empty())
    whole.branch.points.pop_back();  // the start, which begins the way forward
  whole.branch.linear_solver = forward.linear_solver;
  append(whole.branch, std::move(forward));
  number(whole.branch);
  return whole;
}

}  // namespace arcslip::continuation
