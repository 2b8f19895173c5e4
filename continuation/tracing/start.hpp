#pragma once
// Validation of the start of a trace, and the default scale of a parameter.

#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>

#include <memory>
#include <span>

namespace arcslip::continuation {

// Validation of the start of a trace. All throw std::invalid_argument with the value found and the
// value required.

void check_start(const Problem& problem, const Start& start, const Options& options);
void check_state(const Problem& problem, const State& state, std::size_t monitors);
void check_monitors(const std::vector<Monitor>& monitors);

// The default scale of a free parameter: the width of its window.

/// The problem itself if it gives the scale; otherwise the same problem with the width of the window, clipped
/// to the parameter's bounds, as scale.
std::shared_ptr<const Problem> scaled_to_window(std::shared_ptr<const Problem> problem, int free,
                                                double lower, double upper);

}  // namespace arcslip::continuation
