#pragma once
// Changes of the active set of an optimum (optimality.hpp). Not installed.

#include <arcslip/optimize/curve/optimality.hpp>

#include <optional>
#include <vector>

namespace arcslip::optimize {

inline constexpr double higher_peak = 1e-7;  // of ln A: a peak above the active ones

/// The inequalities that may become active or inactive along a curve with this active set: the bounds of all
/// parameters and, if there are several, the active peaks. Other peaks may join.
std::vector<Inequality> inequalities(const ActiveSet& active);

/// Exchanges an inequality violated by more than rounding: a peak above the active ones joins, one with
/// negative weight leaves, a parameter beyond its bound is fixed, one with a negative multiplier is released.
/// False: no violation.
bool exchange(ActiveSet& active, const OptimalityEvaluator& at);

struct Exchanged {
  ActiveSet active;
  std::vector<double> weights;  // of its peaks
  Inequality watched;           // its slack is 0 here and must increase along the curve
};

/// The next active set after the slack of `what` has reached zero: with `what` added if it was inactive,
/// otherwise removed. At most as many inequalities are active as there are conditions, the design parameters
/// + 1; beyond that the one whose multiplier vanishes first as that of `what` increases leaves, and is
/// watched. nullopt: none vanishes.
std::optional<Exchanged> exchanged(const ActiveSet& active, const Inequality& what,
                                   const OptimalityEvaluator& at);

}  // namespace arcslip::optimize
