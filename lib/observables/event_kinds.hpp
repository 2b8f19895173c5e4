#pragma once
// The kinds of events of branches and curves: the names of their monitors.

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>

namespace arcslip::observables::event_kinds {

inline constexpr const char* peak = "peak";  // of the amplitude over the frequency
inline constexpr const char* fold = continuation::fold_event;
inline constexpr const char* minimum = "minimum";  // of the amplitude over a parameter
inline constexpr const char* maximum = "maximum";
inline constexpr const char* cusp = continuation::cusp_event;
inline constexpr const char* turn = "turn";    // of a curve of folds in the frequency
inline constexpr const char* start = "start";  // of the branch of a mode
inline constexpr const char* end = "end";
inline constexpr const char* corner = "corner";  // a curve reaches or leaves a corner of the response

}  // namespace arcslip::observables::event_kinds
