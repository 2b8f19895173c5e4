#pragma once
// Why a minimization ended.

#include <arcslip/results/reason.hpp>
#include <arcslip/results/reasons.hpp>

#include <string_view>

namespace arcslip::optimize {

/// Converged (the result is a minimum within the tolerances):
///   converged         the algorithm reports convergence.
///   converged_value   |df| <= f_relative |f| or |df| <= f_absolute over a step.
///   converged_step    |dx| <= x_relative |x| or |dx_i| <= x_absolute over a step.
///   target            f(x) <= target at an x that satisfies the constraints.
/// Stopped (the result is the best so far):
///   evaluation_limit  the limit of evaluations was reached.
///   time_limit        the time limit was reached; checked after each call, so a slow call may exceed it.
///   user              the progress callback returned false.
///   rounding          rounding errors prevent further progress; the result is often accurate to rounding.
///                     Causes: tolerances below rounding, a wrong gradient.
/// Failed (the result is the best so far, if there is one):
///   objective_failed  the objective, a constraint or the progress callback threw; the message has what().
///   not_finite        the objective is NaN or -infinity, or +infinity at the start, or a constraint or an
///                     entry of a gradient is not finite. An entry that was not written counts as NaN.
///   invalid_arguments NLopt rejected the problem; the message says why.
///   out_of_memory     NLopt ran out of memory.
///   failed            the algorithm failed without giving a reason. Causes: degenerate constraints,
///                     wrong gradients.
enum class MinimizeReason {
  converged,
  converged_value,
  converged_step,
  target,
  evaluation_limit,
  time_limit,
  user,
  rounding,
  objective_failed,
  not_finite,
  invalid_arguments,
  out_of_memory,
  failed
};

/// "converged_value" and so on.
std::string_view name(MinimizeReason reason);

/// True for the first group.
bool is_converged(MinimizeReason reason);

/// The reason for a return code of NLopt (its enum nlopt_result); `failed` for unknown codes.
MinimizeReason reason_of(int nlopt_result);

/// The reason with the code name(reason).
results::Reason reason_of(MinimizeReason reason);

namespace reasons {

using results::Reason;
using results::reasons::user;

inline constexpr Reason converged{"converged", "the algorithm reports convergence"};
inline constexpr Reason converged_value{"converged_value",
                                        "the change of the amplitude fell below its tolerance"};
inline constexpr Reason converged_step{"converged_step",
                                       "the change of the parameters fell below its tolerance"};
inline constexpr Reason target{"target", "the target amplitude was reached"};
inline constexpr Reason rounding{"rounding", "rounding errors prevent further progress"};
inline constexpr Reason evaluation_limit{"evaluation_limit", "the limit of evaluations was reached"};
inline constexpr Reason time_limit{"time_limit", "the time limit was reached; the message names the phase"};
inline constexpr Reason objective_failed{"objective_failed",
                                         "an exception was thrown; the message quotes it"};
inline constexpr Reason not_finite{"not_finite", "the amplitude, a limit or a derivative is not finite"};
inline constexpr Reason invalid_arguments{"invalid_arguments",
                                          "NLopt rejected the problem; the message says why"};
inline constexpr Reason out_of_memory{"out_of_memory", "NLopt ran out of memory"};
inline constexpr Reason failed{"failed", "the algorithm failed without giving a reason"};

}  // namespace reasons

}  // namespace arcslip::optimize
