#pragma once
// The period map for shooting, independent of the integrator.

#include <arcslip/time/equation_of_motion.hpp>

#include <functional>
#include <string>
#include <vector>

namespace arcslip::time {

/// A slider that stuck throughout, or slipped in one direction only: in a periodic motion it sticks. Its
/// offset is arbitrary, so that a periodic motion has to fix it: at the centre of the interval that its
/// bounds leave free, (max lower + min upper)/2, the limit from the slipping side.
struct RestingSlider {
  int slider = 0;
  double centre = 0;              // m
  Eigen::RowVectorXd derivative;  // of the centre with respect to the start, 2 dofs + sliders
};

struct PeriodMap {
  bool done = false;
  std::string message;  // why it failed
  MotionState end;
  double size = 0;   // largest |(x, x'/omega)| on the way, m: what rounding and tolerances are relative to
  Matrix monodromy;  // d end/d start in (x, x', z)
  std::vector<RestingSlider> resting;
};

/// From a state at t = 0 over the period.
using Flow = std::function<PeriodMap(const MotionState& start)>;

}  // namespace arcslip::time
