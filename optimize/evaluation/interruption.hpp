#pragma once
// Interruption and time limit of a search. Not installed.

#include <arcslip/control/run_control.hpp>
#include <arcslip/results/response.hpp>

namespace arcslip::optimize {

/// Seconds by which an evaluation outlives the control of its search, so that a quick one completes, and a
/// result has the first design even with a short limit.
inline constexpr double grace = 0.5;

/// Why a search ended with its control; without a reason: it has not. phase: at the end, "the search".
observables::Stop interruption(const control::Control& control, const char* phase);

}  // namespace arcslip::optimize
