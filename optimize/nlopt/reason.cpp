#include <arcslip/optimize/nlopt/reason.hpp>

#include <nlopt.h>

namespace arcslip::optimize {

std::string_view name(Reason reason) {
  return reason_of(reason).code;
}

results::Reason reason_of(Reason reason) {
  switch (reason) {
    case Reason::converged:
      return reasons::converged;
    case Reason::converged_value:
      return reasons::converged_value;
    case Reason::converged_step:
      return reasons::converged_step;
    case Reason::target:
      return reasons::target;
    case Reason::evaluation_limit:
      return reasons::evaluation_limit;
    case Reason::time_limit:
      return reasons::time_limit;
    case Reason::user:
      return reasons::user;
    case Reason::rounding:
      return reasons::rounding;
    case Reason::objective_failed:
      return reasons::objective_failed;
    case Reason::not_finite:
      return reasons::not_finite;
    case Reason::invalid_arguments:
      return reasons::invalid_arguments;
    case Reason::out_of_memory:
      return reasons::out_of_memory;
    case Reason::failed:
      break;
  }
  return reasons::failed;
}

bool is_converged(Reason reason) {
  return reason <= Reason::target;
}

Reason reason_of(int nlopt_result) {
  switch (nlopt_result) {
    case NLOPT_SUCCESS:
      return Reason::converged;
    case NLOPT_STOPVAL_REACHED:
      return Reason::target;
    case NLOPT_FTOL_REACHED:
      return Reason::converged_value;
    case NLOPT_XTOL_REACHED:
      return Reason::converged_step;
    case NLOPT_MAXEVAL_REACHED:
      return Reason::evaluation_limit;
    case NLOPT_MAXTIME_REACHED:
      return Reason::time_limit;
    case NLOPT_FORCED_STOP:
      return Reason::user;
    case NLOPT_ROUNDOFF_LIMITED:
      return Reason::rounding;
    case NLOPT_INVALID_ARGS:
      return Reason::invalid_arguments;
    case NLOPT_OUT_OF_MEMORY:
      return Reason::out_of_memory;
    default:
      return Reason::failed;
  }
}

}  // namespace arcslip::optimize
