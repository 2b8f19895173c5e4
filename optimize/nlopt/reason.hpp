#pragma once
// Why a minimisation ended.

#include <arcslip/observables/reasons.hpp>
#include <arcslip/results/reason.hpp>

#include <string_view>

namespace arcslip::optimize {

/// Converged (the result is a minimum to the tolerances that were asked for):
///   converged         the algorithm's own test of a minimum holds.
///   converged_value   |df| <= f_relative |f| or |df| <= f_absolute over a step.
///   converged_step    |dx| <= x_relative |x| or |dx_i| <= x_absolute over a step.
///   target            f(x) <= target at an x that satisfies the constraints.
/// Stopped (the result is the best so far):
///   evaluation_limit  the objective was called as often as allowed.
///   time_limit        the time is over; looked at after each call, so that one slow call can pass it.
///   user              the progress callback returned false.
///   rounding          rounding errors leave no progress. The result is often as good as rounding allows.
///                     Causes: tolerances below rounding, a gradient that does not belong to the objective.
/// Failed (the result is the best so far, if there is one):
///   objective_failed  the objective, a constraint or the progress callback threw; the message has what().
///   not_finite        the objective is NaN or -infinity anywhere or +infinity at the start, or a constraint
///   or an
///                     entry of a gradient is not finite. An entry that was never written counts as NaN.
///   invalid_arguments NLopt refused the problem; the message says why.
///   out_of_memory     NLopt could not allocate.
///   failed            the algorithm gave up without saying why. Causes: degenerate constraints, wrong
///   gradients.
enum class Reason {
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
std::string_view name(Reason reason);

/// True for the first group.
bool is_converged(Reason reason);

/// The reason that stands for a return code of NLopt (its enum nlopt_result); `failed` where it is none of
/// them.
Reason reason_of(int nlopt_result);

/// With the code name(reason).
results::Reason reason_of(Reason reason);

namespace reasons {

using results::Reason;
using results::reasons::user;

inline constexpr Reason converged{"converged", "the algorithm's own test of a minimum holds"};
inline constexpr Reason converged_value{"converged_value",
                                        "the amplitude no longer changes by more than its tolerance"};
inline constexpr Reason converged_step{"converged_step",
                                       "the parameters no longer change by more than their tolerance"};
inline constexpr Reason target{"target", "the amplitude is as low as was asked for"};
inline constexpr Reason rounding{"rounding", "rounding leaves no more progress"};
inline constexpr Reason evaluation_limit{"evaluation_limit", "it looked at as many designs as allowed"};
inline constexpr Reason time_limit{
    "time_limit", "the time was over before all of it was done, and the message says in which phase"};
inline constexpr Reason objective_failed{"objective_failed",
                                         "something threw, and the message has its words"};
inline constexpr Reason not_finite{"not_finite",
                                   "the amplitude, a limit or a derivative is no finite number"};
inline constexpr Reason invalid_arguments{
    "invalid_arguments", "the algorithm does not take the problem, and the message says why"};
inline constexpr Reason out_of_memory{"out_of_memory", "the algorithm has not enough memory"};
inline constexpr Reason failed{"failed", "the algorithm gave up without saying why"};

}  // namespace reasons

}  // namespace arcslip::optimize
