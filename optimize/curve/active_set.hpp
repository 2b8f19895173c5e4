#pragma once
// How the active set of an optimum changes (optimality.hpp). Not installed.

#include <arcslip/optimize/search/optimality.hpp>

#include <optional>
#include <vector>

namespace arcslip::optimize {

/// What may become active, or cease to be, along a curve with this active set: the bounds of all parameters
/// and, where there are several, the active peaks. Other peaks join.
std::vector<Inequality> inequalities(const ActiveSet& active);

/// Exchanges what is violated by more than rounding: a peak above the active ones joins, one of negative
/// weight leaves, a parameter beyond its bound is held, one that pulls inwards is let go. False: nothing is.
bool exchange(ActiveSet& active, const OptimalityEvaluator& at);

struct Exchanged {
  ActiveSet active;
  std::vector<double> weights;  // of its peaks
  Inequality watched;           // its slack is 0 here and has to grow along the curve
};

/// Where the slack of `what` has come to zero: the active set with it, if it was not active, or without. As
/// many inequalities as conditions, the design's parameters + 1, are active at most; where they are, another
/// one leaves, the first whose multiplier vanishes as that of `what` grows, and is the one to be watched.
/// nullopt: none does.
std::optional<Exchanged> exchanged(const ActiveSet& active, const Inequality& what,
                                   const OptimalityEvaluator& at);

}  // namespace arcslip::optimize
