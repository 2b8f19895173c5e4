#pragma once
// Whether what a trace begins with fits its problem. All throw std::invalid_argument with what was found and
// what is needed.

#include <arcslip/continuation/tracer.hpp>

#include <span>

namespace arcslip::continuation {

/// At least one, each with a name of its own.
void check_parameters(std::span<const Parameter> parameters);
void check_start(const Problem& problem, const Start& start, const Options& options);
void check_state(const Problem& problem, const State& state, std::size_t monitors);
void check_monitors(const std::vector<Monitor>& monitors);

}  // namespace arcslip::continuation
