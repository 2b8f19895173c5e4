#pragma once
// The amplitude of a motion: A = max over the period of |x|, found as the largest reversal, not the largest
// sample.
//
// With the extreme at theta_hat, x'(theta_hat) = 0, so that dA/dx_coefficients = sign phi(theta_hat)
// (envelope theorem), if the largest reversal is unique. Of several that are equal to rounding, as in a
// motion with a shorter period than the force, the first is taken.

#include <arcslip/elements/reversals.hpp>

#include <vector>

namespace arcslip::observables {

struct Extreme {
  double amplitude = 0;      // |x(theta)|, m
  double theta = 0;          // rad
  double sign = 1;           // of x there
  std::size_t reversal = 0;  // its index, in the order of theta
};

class Amplitude {
 public:
  explicit Amplitude(const elements::Harmonics& harmonics) : harmonics_(harmonics), reversals_(harmonics) {}

  /// x: coefficients of the motion, harmonics.size().
  Extreme of(elements::In x);
  /// All reversals, in the order of theta.
  std::vector<Extreme> all(elements::In x);
  /// The reversal nearest to an angle, modulo the period; the largest if there is none.
  Extreme near(elements::In x, double theta);

 private:
  elements::Harmonics harmonics_;
  elements::Reversals reversals_;
};

/// sign phi(theta) . dx, the change of A for a change dx of the coefficients.
double amplitude_change(const elements::Harmonics& harmonics, const Extreme& extreme, elements::In dx);

}  // namespace arcslip::observables
