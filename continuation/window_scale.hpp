#pragma once
// The scale of a free parameter that has none of its own: the width of its window.

#include <arcslip/continuation/problem.hpp>

#include <memory>

namespace arcslip::continuation {

/// The problem itself where the scale is given; otherwise the same problem with that of the window, cut to
/// the parameter's bounds.
std::shared_ptr<const Problem> scaled_to_window(std::shared_ptr<const Problem> problem, int free,
                                                double lower, double upper);

}  // namespace arcslip::continuation
