#pragma once
// The start of a search. Not installed.

#include <arcslip/optimize/evaluation/design_evaluations.hpp>
#include <arcslip/optimize/evaluation/load_cases.hpp>
#include <arcslip/results/reason.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace arcslip::optimize {

/// Why a design is no valid start: unbounded, no_response or flat (no parameter affects the amplitude, since
/// no friction element slips); without a reason: it is valid.
struct StartFault {
  results::Reason reason;
  std::string message;
};

struct SearchStart {
  bool found = false;
  std::vector<double> design;  // then the current design of the cases
  StartFault fault;            // of the requested design
};

/// A design with finite V that depends on the parameters: the given one, or one on the diagonal of the
/// bounds, with a note. None after an interruption.
SearchStart find_start(DesignEvaluations& designs, const std::vector<double>& given,
                       std::vector<std::string>& notes);

// Dampers that stick. Not installed.
//
// An element that sticks at the highest peak is a spring there: its slip limit p = mu F_n has no influence,
// and no gradient shows that it is too large. Yet the peak decreases as the element starts to slip: in a
// motion of amplitude X it dissipates D = 4 p (X - p/k_d) per period once p < k_d X, which grows from zero
// with slope dD/dp = -4 X, while its stiffness decreases only with the power 3/2 of k_d X - p. D is largest
// at p = k_d X/2. So a search that ended there can continue, unless another peak rises.

inline constexpr double most_dissipation = 0.5;  // of k_d X

/// The current design of the cases, with each parameter without influence on the highest peaks that is the
/// friction coefficient or the normal load of an element sticking at one of them lowered to p = share k_d X,
/// or to its lower bound. over: the design parameters in the model. nullopt: no such parameter.
std::optional<std::vector<double>> released(const LoadCases& cases, std::span<const int> over,
                                            std::span<const double> lower, double share = most_dissipation);

}  // namespace arcslip::optimize
