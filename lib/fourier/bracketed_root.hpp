#pragma once
// Roots of trigonometric polynomials in a bracket.

#include <cmath>

namespace arcslip::elements {

struct Slopes {
  double f, f1, f2;  // of a function, with its derivatives
};

/// Halley's method for a function in a bracket between whose ends it changes its sign, with bisection where
/// it leaves the bracket. order: the highest harmonic. The error is the cube of the last step, at rounding
/// level. Returns the root and calls at_last(root - t) with its distance from the last evaluation, at t.
template <class Function, class AtLast>
double bracketed_root(int order, Function&& at, double lower, double upper, double guess, bool rising,
                      AtLast&& at_last) {
  constexpr int most_steps = 60;    // with bisection
  constexpr double settled = 5e-6;  // rad of the highest harmonic, and of a step over the distance to a turn
  constexpr double finest = 1e-13;  // rad: where roots nearly coincide
  double t = guess > lower && guess < upper ? guess : 0.5 * (lower + upper);
  for (int k = 0;; ++k) {
    const auto [f, f1, f2] = at(t);
    ((f > 0) == rising ? upper : lower) = t;
    double next = f == 0 ? t : t - 2 * f * f1 / (2 * f1 * f1 - f * f2);
    if (!(next >= lower && next <= upper)) next = 0.5 * (lower + upper);
    const double step = std::abs(next - t);
    const bool cubic = step * order <= settled && step * std::abs(f2) <= settled * std::abs(f1);
    if (cubic || step <= finest || k == most_steps) {
      at_last(next - t);
      return next;
    }
    t = next;
  }
}

}  // namespace arcslip::elements
