#include <arcslip/analyses/branches/stop_reason.hpp>

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/reasons.hpp>

namespace arcslip::observables {

static_assert(event_kinds::fold == continuation::fold_event);
static_assert(event_kinds::cusp == continuation::cusp_event);

results::Reason reason_of(continuation::StopReason reason) {
  using continuation::StopReason;
  switch (reason) {
    case StopReason::boundary:
      return reasons::boundary;
    case StopReason::closed:
      return reasons::closed;
    case StopReason::event:
      return reasons::event;
    case StopReason::start_failed:
      return reasons::start_failed;
    case StopReason::step_too_small:
      return reasons::step_too_small;
    case StopReason::state_too_large:
      return reasons::state_too_large;
    case StopReason::point_limit:
      return reasons::point_limit;
    case StopReason::time_limit:
      return reasons::time_limit;
    case StopReason::memory_limit:
      return reasons::memory_limit;
    case StopReason::user:
      return reasons::user;
    case StopReason::not_evaluated:
      return reasons::not_evaluated;
    case StopReason::monitor_failed:
      return reasons::monitor_failed;
    case StopReason::known_branch:  // of a diagram, which responses are not
    case StopReason::wrong_jacobian:
      break;
  }
  return reasons::wrong_jacobian;
}

}  // namespace arcslip::observables
