#pragma once
// The sign of the velocity, s(theta) = sgn(dq/dtheta), between the reversals of a motion, and its exact
// integrals
//
//   I_k = integral over one span of s(theta) exp(i k theta),   k = 0 .. 3N
//
// Where the motion is antisymmetric, I_k is that of half a period, which is of use for odd k.

#include <arcslip/fourier/moments.hpp>
#include <arcslip/fourier/reversals.hpp>

#include <complex>
#include <vector>

namespace arcslip::elements {

class VelocitySign {
 public:
  explicit VelocitySign(const Harmonics& harmonics);

  /// u: coefficients of q. Without reversals, as of a constant motion, all integrals are 0.
  void move_to(In u);
  const std::vector<Reversal>& reversals() const { return turns_; }
  std::complex<double> integral(int k) const {
    return k < 0 ? std::conj(integrals_[static_cast<std::size_t>(-k)])
                 : integrals_[static_cast<std::size_t>(k)];
  }

  /// The moments of the weight s(theta) w(theta) over one span. w: coefficients, harmonics.size().
  void moments(In w, Moments& result) const;

 private:
  Harmonics harmonics_;
  Reversals search_;
  std::vector<Reversal> turns_;
  std::vector<std::complex<double>> integrals_, middle_, half_;
};

}  // namespace arcslip::elements
