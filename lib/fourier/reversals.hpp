#pragma once
// The reversals of a motion: all roots of dx/dtheta over one span of the harmonics, found rigorously.
//
// dx/dtheta is sampled, and each interval is decided by a bound of its curvature, |x'''| <= M = sum n^3
// |X_n|: no root where both ends lie farther than M h^2/8 from zero on the same side; one root where they
// differ in sign and |x'_1 - x'_0| > M h^2/2 (x' is monotone); else the interval is halved. Double roots
// closer than about 1e-5 rad, whose loops are below rounding, may be left out as a pair.

#include <arcslip/fourier/series.hpp>

#include <vector>

namespace arcslip::elements {

/// Of the range of the motion: reversals so close are equally high.
inline constexpr double same_height = 1e-12;

struct Reversal {
  double theta;  // in [start, start + span)
  double x;
};

class Reversals {
 public:
  explicit Reversals(const Harmonics& harmonics);

  /// In the order of theta. The reference holds until the next call. Empty where x is constant.
  const std::vector<Reversal>& find(In u);

  /// The same within [begin, end], a part of the span that is not much longer than a sample of it.
  const std::vector<Reversal>& within(In u, double begin, double end);

  /// The root of x(theta) = target on a piece where x is monotone from `from` to `to`, target between their
  /// x.
  double crossing(In u, const Reversal& from, const Reversal& to, double target) const;

 private:
  struct Slope {
    double theta, d1;
    bool positive;
  };

  void one_harmonic(In u);
  void search(In u, const Slope& from, const Slope& to, double M, int depth, int column);
  Reversal polish(In u, const Slope& from, const Slope& to) const;

  Harmonics harmonics_;
  int intervals_;
  double start_, step_;
  Eigen::MatrixXd derivative_;  // intervals x size: x' at the grid
  Eigen::MatrixXd between_;     // size x 3 intervals: between its points
  Eigen::VectorXd samples_;
  std::vector<Reversal> found_;
};

}  // namespace arcslip::elements
