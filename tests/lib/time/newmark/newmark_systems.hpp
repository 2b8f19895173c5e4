#pragma once
// Small systems for time integration.

#include "lib/time/equation/systems.hpp"

#include <arcslip/time/newmark/newmark_periods.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace time_test {

using namespace arcslip::time;
using systems::add_damper;
using systems::oscillator;
using systems::paper;

inline Vector vector(std::initializer_list<double> values) {
  Vector v(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), v.begin());
  return v;
}

inline void add_cubic(EquationOfMotion& equation, Vector direction, double k3) {
  equation.add("spring", arcslip::elements::cubic_spring().law({}), {k3}, std::move(direction));
}

inline Solved run(Newmark& newmark, long steps) {
  Solved solved = Solved::yes;
  for (long k = 0; k < steps && solved == Solved::yes; ++k) solved = newmark.step();
  return solved;
}

/// The last of many periods.
inline PeriodMotion settled(const EquationOfMotion& equation, long steps, long periods,
                            bool with_history = false) {
  Newmark newmark(equation, steps);
  const PeriodMotion first = newmark_periods(newmark, at_rest(equation), periods - 1, false, true);
  return newmark_periods(newmark, first.end, 1, with_history, false);
}

}  // namespace time_test
