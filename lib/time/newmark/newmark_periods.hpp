#pragma once
// Newmark's method over whole periods: what it observes, and its map from the beginning to the end with
// derivative.

#include <arcslip/control/run_control.hpp>
#include <arcslip/time/equation/period_map.hpp>
#include <arcslip/time/equation/period_motion.hpp>
#include <arcslip/time/newmark/newmark.hpp>

namespace arcslip::time {

/// From a state at the beginning of a period, as at_rest(). Within a step the displacement is that of
/// constant acceleration, x = x0 + v0 s + (v1 - v0) s^2/(2 h), from which the amplitude is taken; a slider
/// that goes the part dz of dq in a step sticks for the share 1 - dz/dq of it. first: at the beginning of a
/// motion, where massless motions are put in their place. control: asked now and then; its end is with the
/// failure user.
PeriodMotion newmark_periods(Newmark& newmark, const MotionState& start, long count, bool with_history,
                             bool first, const control::Control& control = {});

/// The map of one period. The derivative is the product of those of the steps: that of the discrete map,
/// exact but where a slider begins to slip just at the end of a step.
PeriodMap newmark_map(Newmark& newmark, const MotionState& start);

/// Why a step was not solved, and in one sentence; Solved::yes: none.
std::pair<results::Reason, std::string> failure_of(Solved solved, double time);

}  // namespace arcslip::time
