#pragma once
// Dampers that stick. Not installed.
//
// An element that sticks at the highest peak is a spring there: its slip limit p = mu F_n moves nothing, and
// no gradient tells a search that it is too large. Yet the peak gets lower as the element begins to slip: at
// a motion of amplitude X it dissipates D = 4 p (X - p/k_d) per period once p < k_d X, which grows from
// nothing as dD/dp = -4 X, while its stiffness falls by the power 3/2 of k_d X - p only. D is largest at
// p = k_d X/2. So a search that ended there may go on, unless another peak rises instead.

#include <arcslip/optimize/cases.hpp>

#include <optional>
#include <span>
#include <vector>

namespace arcslip::optimize {

inline constexpr double most_dissipation = 0.5;  // of k_d X

/// The design where the cases stand, with each parameter that moves none of the highest peaks, and is the
/// friction coefficient or the normal load of an element that sticks at one, lowered to where
/// p = share k_d X, or to its lower bound. over: the design's parameters in the model. nullopt: there is
/// none.
std::optional<std::vector<double>> released(const Cases& cases, std::span<const int> over,
                                            std::span<const double> lower, double share = most_dissipation);

}  // namespace arcslip::optimize
