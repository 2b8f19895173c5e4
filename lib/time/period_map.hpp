#pragma once
// What shooting needs of a motion over one period, whichever way it is integrated.

#include <arcslip/time/equation_of_motion.hpp>

#include <functional>
#include <string>
#include <vector>

namespace arcslip::time {

/// A slider that rested throughout, or slipped in one direction only: over a periodic motion it rests. Any
/// offset would do for it, so that a periodic motion has to choose one: the centre of the element's motion,
/// (max q + min q)/2, the limit from the slipping side.
struct RestingSlider {
  int slider = 0;
  double centre = 0;              // m
  Eigen::RowVectorXd derivative;  // of the centre with respect to the start, 2 dofs + sliders
};

struct PeriodMap {
  bool done = false;
  std::string message;  // where it is not done: why
  State end;
  double size = 0;   // largest |(x, x'/omega)| on the way, m: what rounding and tolerances are relative to
  Matrix monodromy;  // d end/d start in (x, x', z)
  std::vector<RestingSlider> resting;
};

/// From a state at t = 0 over the period.
using Flow = std::function<PeriodMap(const State& start)>;

}  // namespace arcslip::time
