#pragma once
// Reasons why a branch or a motion ended (Stop::reason), each defined once and listed in docs/results.md.

#include <arcslip/results/reason.hpp>
#include <arcslip/results/time_reasons.hpp>

#include <array>

namespace arcslip::observables::reasons {

using results::Reason;
using results::reasons::user;

// The values of continuation::StopReason.
inline constexpr Reason boundary{
    "boundary",
    "the branch left the frequency window or the parameter range: usually at the far end; or, having turned "
    "back, at the end where it started, which is complete if another branch reaches the far end. A peak or a "
    "fold may also leave the window"};
inline constexpr Reason closed{"closed", "the curve closed on itself"};
inline constexpr Reason event{"event",
                              "a curve could not be continued where it reaches or leaves a grazing point"};
inline constexpr Reason start_failed{"start_failed",
                                     "no periodic response, peak, fold or mode was found to start from"};
inline constexpr Reason step_too_small{
    "step_too_small",
    "the step size fell below its minimum, as at an end of the branch or if rounding errors dominate"};
inline constexpr Reason state_too_large{
    "state_too_large",
    "the response grew so large, relative to the start, that rounding errors destroy its accuracy"};
inline constexpr Reason point_limit{"point_limit", "the maximum number of points was reached"};
inline constexpr Reason time_limit{"time_limit", "the time limit was reached"};
inline constexpr Reason memory_limit{"memory_limit", "the points reached the memory limit"};
inline constexpr Reason not_evaluated{
    "not_evaluated", "the equations could not be evaluated at the next point, or returned non-finite values"};
inline constexpr Reason monitor_failed{"monitor_failed", "an event function could not be evaluated"};
inline constexpr Reason wrong_jacobian{"wrong_jacobian", "the Jacobian is inconsistent with the equations"};

// Further reasons of branches and curves.
inline constexpr Reason unbounded{
    "unbounded", "the response, or its peak, grows without bound, as at an insufficiently damped resonance"};
inline constexpr Reason fold{
    "fold",
    "of curves: the peak meets a minimum of the amplitude over the frequency, another extremum within the "
    "period becomes larger, or the fold meets another at a grazing point"};
inline constexpr Reason corner{
    "corner", "of curves: the peak or fold reaches a grazing point, from which another curve continues"};

inline constexpr Reason resonance{"resonance",
                                  "of curves of Neimark-Sacker points: their pair of multipliers becomes "
                                  "real, at 1 on a curve of folds (1:1), "
                                  "or at -1 on one of period doublings (1:2)"};
inline constexpr Reason jump{
    "jump",
    "of curves of bifurcations: the multipliers jump, where a phase of contact begins "
    "or ends"};

// Branches that leave others.
inline constexpr Reason branch_point{"branch_point",
                                     "a branch that left another one ended at a branch point, of a known "
                                     "branch or of one that was not traced"};

// Modes.
inline constexpr Reason no_mode{
    "no_mode",
    "the structure at rest has no such mode: it has fewer modes, or the mode does not oscillate, does not "
    "move the response, or is held by friction without a stiffness"};

// Responses at one frequency.
inline constexpr Reason solved{"solved", "the response was found"};

// Motions in time.
inline constexpr Reason periodic{"periodic", "shooting converged to a periodic motion"};
inline constexpr Reason steady{"steady", "the change of the state over a period is within the tolerance"};
inline constexpr Reason periods{"periods",
                                "with tolerance 0: the requested number of periods was integrated"};
inline constexpr Reason period_limit{
    "period_limit",
    "the change of the state still exceeded the tolerance after the maximum number of periods"};
inline constexpr Reason no_periodic_motion{"no_periodic_motion",
                                           "shooting did not converge to a periodic motion"};
inline constexpr Reason energy_defect{
    "energy_defect", "the energies of the motion do not balance within 1 %: its steps are too long"};
inline constexpr Reason not_piecewise_linear{"not_piecewise_linear",
                                             "event-driven integration requires piecewise linear laws"};
inline constexpr Reason massless{"massless",
                                 "event-driven integration requires a mass at every degree of freedom"};
using time::reasons::event_limit;
using time::reasons::loss_factor;
using time::reasons::no_convergence;
using time::reasons::not_finite;
using time::reasons::sector;
using time::reasons::set_valued;
using time::reasons::several_places;
using time::reasons::singular;

// Sweeps.
inline constexpr Reason swept{"swept", "the sweep reached its last frequency"};

// Comparisons of methods.
inline constexpr Reason compared{"compared", "all computations were compared"};

/// The reasons of a branch, or of a curve of peaks or folds.
inline constexpr std::array of_branches = {
    boundary,        unbounded,  closed,        branch_point,   fold,          corner,
    resonance,       jump,       point_limit,   user,           start_failed,  step_too_small,
    state_too_large, event,      not_evaluated, monitor_failed, no_mode,       not_piecewise_linear,
    massless,        set_valued, loss_factor,   sector,         several_places};

/// The reasons of a response at one frequency.
inline constexpr std::array of_responses = {solved, unbounded, user, start_failed, not_evaluated};

/// The reasons of a motion in time.
inline constexpr std::array of_motions = {periodic,
                                          steady,
                                          periods,
                                          period_limit,
                                          user,
                                          unbounded,
                                          no_periodic_motion,
                                          no_convergence,
                                          singular,
                                          not_finite,
                                          not_piecewise_linear,
                                          massless,
                                          set_valued,
                                          loss_factor,
                                          sector,
                                          several_places,
                                          event_limit,
                                          energy_defect,
                                          start_failed};

/// The reasons of a sweep.
inline constexpr std::array of_sweeps = {swept,          user,       no_convergence, singular,
                                         not_finite,     set_valued, loss_factor,    sector,
                                         several_places, event_limit};

/// The reasons of a comparison of methods.
inline constexpr std::array of_comparisons = {compared, user, start_failed};

}  // namespace arcslip::observables::reasons
