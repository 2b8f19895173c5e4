#pragma once
// What a trace begins with: whether it fits its problem, and the scale of a parameter that has none.

#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>

#include <memory>
#include <span>

namespace arcslip::continuation {

// Whether what a trace begins with fits its problem. All throw std::invalid_argument with what was found and
// what is needed.

void check_start(const Problem& problem, const Start& start, const Options& options);
void check_state(const Problem& problem, const State& state, std::size_t monitors);
void check_monitors(const std::vector<Monitor>& monitors);

// The scale of a free parameter that has none of its own: the width of its window.

/// The problem itself where the scale is given; otherwise the same problem with that of the window, cut to
/// the parameter's bounds.
std::shared_ptr<const Problem> scaled_to_window(std::shared_ptr<const Problem> problem, int free,
                                                double lower, double upper);

}  // namespace arcslip::continuation
