#pragma once
// Why a branch or a motion ended: the reasons of Stop, each once. docs/results.md has their lists.

#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/results/reason.hpp>
#include <arcslip/time/reasons.hpp>

#include <array>

namespace arcslip::observables {

/// With the code name(reason).
results::Reason reason_of(continuation::StopReason reason);

namespace reasons {

using results::Reason;
using results::reasons::user;

// Those of continuation::StopReason.
inline constexpr Reason boundary{
    "boundary",
    "the branch left the window of the frequency, or the range of the parameter: at its far end, which is "
    "the usual end, or, where it turned back, where it began; a peak or a fold may also leave the window"};
inline constexpr Reason closed{"closed", "a curve came back to its beginning"};
inline constexpr Reason event{
    "event",
    "a curve could not be followed on from where it comes to a corner of the response, or leaves it"};
inline constexpr Reason start_failed{"start_failed",
                                     "no periodic response, peak or fold was found from which to begin"};
inline constexpr Reason step_too_small{
    "step_too_small",
    "steps failed, however short, as at an end of the branch or where it lies in its rounding"};
inline constexpr Reason state_too_large{
    "state_too_large", "the response grew so far beyond that at the start that rounding takes its digits"};
inline constexpr Reason point_limit{"point_limit", "it has as many points as allowed"};
inline constexpr Reason time_limit{"time_limit", "the time is over"};
inline constexpr Reason memory_limit{"memory_limit", "its points take as much memory as allowed"};
inline constexpr Reason not_evaluated{
    "not_evaluated", "the equations could not be evaluated ahead, or gave numbers that are not finite"};
inline constexpr Reason monitor_failed{"monitor_failed",
                                       "a quantity whose zeros are the events could not be computed"};
inline constexpr Reason wrong_jacobian{"wrong_jacobian", "derivatives are not those of the equations"};

// Of branches and curves besides.
inline constexpr Reason unbounded{
    "unbounded",
    "the response, or its peak, grows without bound, as at a resonance that nothing damps enough"};
inline constexpr Reason fold{
    "fold",
    "of curves: there is nothing beyond, since the peak meets a minimum of the amplitude over the frequency, "
    "or another instant of the period surpasses it, or the fold meets another at a corner of the response"};
inline constexpr Reason corner{
    "corner",
    "of curves: the peak or fold comes to a corner of the response, from which another curve goes on"};

// Of the response at one frequency.
inline constexpr Reason solved{"solved", "the response was found"};

// Of motions in time.
inline constexpr Reason periodic{"periodic", "shooting came to a periodic motion"};
inline constexpr Reason steady{"steady", "the state changes over a period by no more than the tolerance"};
inline constexpr Reason periods{"periods",
                                "with tolerance 0: it has gone on for as many periods as were asked for"};
inline constexpr Reason period_limit{
    "period_limit", "the state still changed by more than the tolerance after as many periods as allowed"};
inline constexpr Reason no_periodic_motion{"no_periodic_motion", "shooting came to no periodic motion"};
inline constexpr Reason not_piecewise_linear{
    "not_piecewise_linear", "the integration between events takes piecewise linear laws alone"};
inline constexpr Reason massless{"massless",
                                 "the integration between events takes no degree of freedom without mass"};
using time::reasons::event_limit;
using time::reasons::no_convergence;
using time::reasons::not_finite;
using time::reasons::singular;

/// What a branch, or a curve of peaks or folds, may end with.
inline constexpr std::array of_branches = {
    boundary,     unbounded,      closed,          fold,  corner,        point_limit,   user,
    start_failed, step_too_small, state_too_large, event, not_evaluated, monitor_failed};

/// What the response at one frequency may end with.
inline constexpr std::array of_responses = {solved, unbounded, user, start_failed, not_evaluated};

/// What a motion in time may end with.
inline constexpr std::array of_motions = {
    periodic,       steady,   periods,    period_limit,         user,     unbounded,  no_periodic_motion,
    no_convergence, singular, not_finite, not_piecewise_linear, massless, event_limit};

}  // namespace reasons

}  // namespace arcslip::observables
