#pragma once
// Why a search or a curve of optima ended: the reasons of its Stop, each once. docs/results.md has their
// lists.

#include <arcslip/observables/reasons.hpp>
#include <arcslip/optimize/nlopt/reason.hpp>
#include <arcslip/results/reason.hpp>

#include <array>

namespace arcslip::optimize {

namespace reasons {

using observables::reasons::point_limit;

// Of a search besides.
inline constexpr Reason flat{
    "flat",
    "the amplitude does not depend on the parameters within the bounds; of a curve: the highest peak ceases "
    "to depend on a parameter, of which a range of values is as good"};
inline constexpr Reason unbounded{"unbounded",
                                  "the highest peak is infinite wherever within the bounds it was looked at; "
                                  "of a curve: it grows without bound"};
inline constexpr Reason no_response{"no_response", "nowhere within the bounds was a response found"};
inline constexpr Reason infeasible{
    "infeasible",
    "no design was found that keeps within the limits, and `optimum` is the one that exceeds them least"};
inline constexpr Reason other_peak{
    "other_peak",
    "the response at the best design has, search after search, a higher peak than was followed, so that it "
    "may not be the optimum; of a curve: a response has a higher peak than those that are followed"};
inline constexpr Reason scatter_limit{
    "scatter_limit", "the worst of what scatters was still higher after as many searches as allowed"};
inline constexpr Reason lower_beside{"lower_beside", "each of several minima had a lower design beside it"};
inline constexpr Reason not_stationary{
    "not_stationary", "no algorithm came to a design at which the conditions of a minimum hold"};

// Of a curve of optima besides.
inline constexpr Reason boundary{"boundary", "the optimum was followed up to the upper end of the range"};
inline constexpr Reason lost_peak{
    "lost_peak", "an active peak vanished, or sits at a kink of another kind, or the optimum jumps there"};
inline constexpr Reason turned_back{"turned_back",
                                    "the curve left the range at its lower end, beyond a turning point"};
inline constexpr Reason no_exchange{"no_exchange", "no set of active peaks goes on"};
inline constexpr Reason no_progress{"no_progress", "active sets follow one another at one place"};

/// What a search may end with.
inline constexpr std::array of_optima = {
    converged,         converged_value, converged_step, target,      rounding,         flat,
    evaluation_limit,  time_limit,      user,           infeasible,  other_peak,       scatter_limit,
    lower_beside,      not_stationary,  unbounded,      no_response, objective_failed, not_finite,
    invalid_arguments, out_of_memory,   failed};

/// What a curve of optima may end with, beside the reasons of a search for its first point. Where the
/// equations of an active set cannot be followed from the first point, the reason is that of a branch.
inline constexpr std::array of_optimum_curves = {
    boundary,    turned_back, point_limit, time_limit,      user, flat, other_peak, lost_peak, no_exchange,
    no_progress, unbounded,   no_response, objective_failed};

}  // namespace reasons

}  // namespace arcslip::optimize
