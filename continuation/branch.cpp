#include <arcslip/continuation/branch.hpp>
#include <arcslip/continuation/monitor.hpp>

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

Monitor fold_monitor() {
  const auto parameter = std::make_shared<double>(0);
  return {"fold",
          [parameter](const Accepted& now) {
            *parameter = now.parameter;
            return now.tangent[now.tangent.size() - 1];
          },
          Crossing::any, [parameter] { return *parameter; }};
}

}  // namespace arcslip::continuation
