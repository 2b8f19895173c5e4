#pragma once
// Reasons why a search or a curve of optima stopped (Stop::reason), each defined once and listed in
// docs/results.md.

#include <arcslip/optimize/nlopt/reason.hpp>
#include <arcslip/results/reason.hpp>
#include <arcslip/results/reasons.hpp>

#include <array>

namespace arcslip::optimize {

namespace reasons {

using observables::reasons::point_limit;

// Further reasons of a search.
inline constexpr Reason flat{
    "flat",
    "the amplitude does not depend on the parameters within the bounds; of a curve: the highest peak no "
    "longer depends on one of the parameters, so that the optimum is not unique"};
inline constexpr Reason unbounded{"unbounded",
                                  "the highest peak is infinite at every design evaluated within the bounds; "
                                  "of a curve: it grows without bound"};
inline constexpr Reason no_response{"no_response", "no response was found at any design within the bounds"};
inline constexpr Reason infeasible{
    "infeasible",
    "no feasible design was found; `optimum` is the one with the smallest violation of the limits"};
inline constexpr Reason other_peak{
    "other_peak",
    "after each of several searches the response at the best design had a peak higher than the tracked ones, "
    "so that it may not be the optimum; of a curve: a response has a peak higher than the tracked ones"};
inline constexpr Reason end_of_window{
    "end_of_window",
    "the highest value lies at an end of the frequency window and is no resonance peak: the message says "
    "where resonances lie, and gives a window that contains the peak of the design found"};
inline constexpr Reason scatter_limit{
    "scatter_limit",
    "the worst case of the uncertain parameters still increased after the maximum number of searches"};
inline constexpr Reason lower_beside{"lower_beside",
                                     "close to each of several minima there was a lower design"};
inline constexpr Reason not_stationary{
    "not_stationary", "no algorithm reached a design that satisfies the first-order conditions of a minimum"};

// Further reasons of a curve of optima.
inline constexpr Reason boundary{"boundary", "the optimum was continued to the upper end of the range"};
inline constexpr Reason lost_peak{
    "lost_peak", "an active peak vanished or moved to a kink of another kind, or the optimum jumps"};
inline constexpr Reason turned_back{"turned_back",
                                    "the curve turned back and left the range at its lower end"};
inline constexpr Reason no_exchange{"no_exchange", "no active set continues the curve"};
inline constexpr Reason no_progress{"no_progress",
                                    "the active set keeps changing without progress along the curve"};

/// The reasons of a search.
inline constexpr std::array of_optima = {
    converged,        converged_value,   converged_step, target,     rounding,    flat,
    evaluation_limit, time_limit,        user,           infeasible, other_peak,  end_of_window,
    scatter_limit,    lower_beside,      not_stationary, unbounded,  no_response, objective_failed,
    not_finite,       invalid_arguments, out_of_memory,  failed};

/// The reasons of a curve of optima, in addition to those of the search for its first point. If the equations
/// of an active set cannot be continued from the first point, the reason is that of a branch.
inline constexpr std::array of_optimum_curves = {
    boundary,      turned_back, point_limit, time_limit,  user,      flat,        other_peak,
    end_of_window, lost_peak,   no_exchange, no_progress, unbounded, no_response, objective_failed};

}  // namespace reasons

}  // namespace arcslip::optimize
