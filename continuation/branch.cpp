#include <arcslip/continuation/branch.hpp>

namespace arcslip::continuation {

const char* name(StopReason reason) {
  switch (reason) {
    case StopReason::boundary:
      return "boundary";
    case StopReason::start_failed:
      return "start_failed";
    case StopReason::step_too_small:
      return "step_too_small";
    case StopReason::state_too_large:
      return "state_too_large";
    case StopReason::point_limit:
      return "point_limit";
    case StopReason::user:
      return "user";
    case StopReason::not_evaluated:
      return "not_evaluated";
  }
  return "unknown";
}

}  // namespace arcslip::continuation
