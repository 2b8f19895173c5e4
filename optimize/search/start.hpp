#pragma once
// Where a search begins. Not installed.

#include <arcslip/optimize/search/cases.hpp>
#include <arcslip/optimize/search/trials.hpp>
#include <arcslip/results/reason.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace arcslip::optimize {

/// What is wrong with a design as a start. Reason unbounded, no_response or flat (no parameter moves the
/// amplitude, since no friction element slips); none: nothing.
struct Fault {
  results::Reason reason;
  std::string message;
};

struct Start {
  bool found = false;
  std::vector<double> design;  // where the cases stand then
  Fault fault;                 // of the design that was asked for
};

/// A design at which V is finite and the parameters change it: the one given, or one on the diagonal of the
/// bounds, which is noted. None is found within an interruption.
Start find_start(Trials& trials, const std::vector<double>& given, std::vector<std::string>& notes);

// Dampers that stick. Not installed.
//
// An element that sticks at the highest peak is a spring there: its slip limit p = mu F_n moves nothing, and
// no gradient tells a search that it is too large. Yet the peak gets lower as the element begins to slip: at
// a motion of amplitude X it dissipates D = 4 p (X - p/k_d) per period once p < k_d X, which grows from
// nothing as dD/dp = -4 X, while its stiffness falls by the power 3/2 of k_d X - p only. D is largest at
// p = k_d X/2. So a search that ended there may go on, unless another peak rises instead.

inline constexpr double most_dissipation = 0.5;  // of k_d X

/// The design where the cases stand, with each parameter that moves none of the highest peaks, and is the
/// friction coefficient or the normal load of an element that sticks at one, lowered to where
/// p = share k_d X, or to its lower bound. over: the design's parameters in the model. nullopt: there is
/// none.
std::optional<std::vector<double>> released(const Cases& cases, std::span<const int> over,
                                            std::span<const double> lower, double share = most_dissipation);

}  // namespace arcslip::optimize
