#pragma once
// The amplitude of a motion: A = max over the period of |x|, found as the largest reversal, not the largest
// sample; of a response at several places the largest of all.
//
// With the extreme at theta_hat, x'(theta_hat) = 0, so that dA/dx_coefficients = sign phi(theta_hat)
// (envelope theorem), if the largest reversal is unique. Of several that are equal to rounding, as in a
// motion with a shorter period than the force, the first is taken.

#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/fourier/reversals.hpp>

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace arcslip::hbm {
class HbmEvaluator;
}

namespace arcslip::observables {

inline constexpr double turn_angle = 2 * std::numbers::pi;

struct Extreme {
  double amplitude = 0;      // |x(theta)|, m
  double theta = 0;          // rad
  double sign = 1;           // of x there
  std::size_t reversal = 0;  // its index, in the order of theta
  int place = 0;             // of the response

  /// Which of the smooth functions it is that the amplitude is the largest of.
  std::uint64_t part() const { return static_cast<std::uint64_t>(place) << 32 | reversal; }
};

class Amplitude {
 public:
  explicit Amplitude(const elements::Harmonics& harmonics) : harmonics_(harmonics), reversals_(harmonics) {}

  /// x: coefficients of the motion, harmonics.size().
  Extreme of(elements::In x);
  /// The largest over the places of the response of unknowns u, at the last parameters of `at`; of those
  /// that are equal to rounding the first. x: the coefficients of that place.
  Extreme of(const hbm::HbmEvaluator& at, elements::In u, elements::Out x);
  /// All reversals, in the order of theta.
  std::vector<Extreme> all(elements::In x);
  /// The reversal nearest to an angle, modulo the period; the largest if there is none.
  Extreme near(elements::In x, double theta);

 private:
  elements::Harmonics harmonics_;
  elements::Reversals reversals_;
  continuation::Vector other_;  // coefficients of a further place
};

/// sign phi(theta) . dx, the change of A for a change dx of the coefficients.
double amplitude_change(const elements::Harmonics& harmonics, const Extreme& extreme, elements::In dx);

}  // namespace arcslip::observables
