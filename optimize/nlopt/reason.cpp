#include <arcslip/optimize/nlopt/reason.hpp>

#include <nlopt.h>

namespace arcslip::optimize {

std::string_view name(MinimizeReason reason) {
  return reason_of(reason).code;
}

results::Reason reason_of(MinimizeReason reason) {
  switch (reason) {
    case MinimizeReason::converged:
      return reasons::converged;
    case MinimizeReason::converged_value:
      return reasons::converged_value;
    case MinimizeReason::converged_step:
      return reasons::converged_step;
    case MinimizeReason::target:
      return reasons::target;
    case MinimizeReason::evaluation_limit:
      return reasons::evaluation_limit;
    case MinimizeReason::time_limit:
      return reasons::time_limit;
    case MinimizeReason::user:
      return reasons::user;
    case MinimizeReason::rounding:
      return reasons::rounding;
    case MinimizeReason::objective_failed:
      return reasons::objective_failed;
    case MinimizeReason::not_finite:
      return reasons::not_finite;
    case MinimizeReason::invalid_arguments:
      return reasons::invalid_arguments;
    case MinimizeReason::out_of_memory:
      return reasons::out_of_memory;
    case MinimizeReason::failed:
      break;
  }
  return reasons::failed;
}

bool is_converged(MinimizeReason reason) {
  return reason <= MinimizeReason::target;
}

MinimizeReason reason_of(int nlopt_result) {
  switch (nlopt_result) {
    case NLOPT_SUCCESS:
      return MinimizeReason::converged;
    case NLOPT_STOPVAL_REACHED:
      return MinimizeReason::target;
    case NLOPT_FTOL_REACHED:
      return MinimizeReason::converged_value;
    case NLOPT_XTOL_REACHED:
      return MinimizeReason::converged_step;
    case NLOPT_MAXEVAL_REACHED:
      return MinimizeReason::evaluation_limit;
    case NLOPT_MAXTIME_REACHED:
      return MinimizeReason::time_limit;
    case NLOPT_FORCED_STOP:
      return MinimizeReason::user;
    case NLOPT_ROUNDOFF_LIMITED:
      return MinimizeReason::rounding;
    case NLOPT_INVALID_ARGS:
      return MinimizeReason::invalid_arguments;
    case NLOPT_OUT_OF_MEMORY:
      return MinimizeReason::out_of_memory;
    default:
      return MinimizeReason::failed;
  }
}

}  // namespace arcslip::optimize
