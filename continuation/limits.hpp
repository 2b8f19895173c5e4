#pragma once
// The limits of a trace: state, points, time, memory.

#include <arcslip/continuation/branch.hpp>
#include <arcslip/continuation/options.hpp>

#include <optional>

namespace arcslip::continuation {

/// The limit that is reached, if any. size: |u| in scales, at the parameter; seconds: since the trace began.
std::optional<Stop> limit_reached(const Options& options, const Branch& branch, int unknowns, double size,
                                  double parameter, double seconds);

}  // namespace arcslip::continuation
