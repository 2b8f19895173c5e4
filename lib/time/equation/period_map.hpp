#pragma once
// The period map for shooting, independent of the integrator.

#include <arcslip/time/equation/equation_of_motion.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::time {

/// A slider that stuck throughout, or slipped in one direction only: in a periodic motion it sticks. Its
/// offset is arbitrary, so that a periodic motion has to fix it, by the choice of laws/slider_offset.hpp
/// between the largest lower bound and the smallest upper one.
struct RestingSlider {
  int slider = 0;
  double offset = 0;              // m
  Eigen::RowVectorXd derivative;  // of the offset with respect to the start, 2 dofs + sliders
};

/// high, low: the largest lower bound and the smallest upper one, but for their room and their centre at rest
/// (elements::Slider).
inline RestingSlider resting_slider(int slider, std::optional<double> room, double centre, double high,
                                    const Eigen::RowVectorXd& d_high, double low,
                                    const Eigen::RowVectorXd& d_low) {
  if (!room) return {slider, 0.5 * (high + low) + centre, 0.5 * (d_high + d_low)};
  const double a = high + centre - *room, b = low + centre + *room;
  if (a > 0) return {slider, a, d_high};
  if (b < 0) return {slider, b, d_low};
  return {slider, 0, Eigen::RowVectorXd::Zero(d_high.size())};
}

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
