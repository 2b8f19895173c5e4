#pragma once
// Validation of the start of a trace, and its problem: with the default scale of a parameter, and in a state.

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

/// The problem in the state `accepted`, which outlives it: each evaluator made of it begins in the state of
/// the moment, so that whatever looks at the problem of a trace, as the check of its Jacobian, sees that of
/// the last accepted point. A problem without a state is returned as it is.
std::shared_ptr<const Problem> in_state(std::shared_ptr<const Problem> problem, const Vector& accepted);

}  // namespace arcslip::continuation
