#pragma once
// The maximum absolute value of a series over the period, without computing all reversals.
//
// 4 N + 16 samples in half a period lie at most pi/4 apart in the phase of the highest harmonic. The parabola
// through a largest sample and its neighbours then misses the top next to it by less than 0.9 % of the
// largest value (that of cos N theta is the worst), so that only tops within 2 % of the largest are polished.

#include <arcslip/fourier/series.hpp>

namespace arcslip::elements {

/// Owns its buffers; of() allocates nothing.
class LargestValue {
 public:
  explicit LargestValue(const Harmonics& harmonics);

  /// max |x| for the coefficients u, harmonics.size().
  double of(In u);

 private:
  double sample(Eigen::Index k) const;  // k = -1 .. count: beyond the span, too
  double polished(In u, double theta) const;

  Harmonics harmonics_;
  double step_;
  Eigen::MatrixXd basis_;  // samples x size
  Eigen::VectorXd samples_;
};

}  // namespace arcslip::elements
