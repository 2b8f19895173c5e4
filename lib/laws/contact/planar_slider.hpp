#pragma once
// The disc in which the slider of a contact with two tangential directions rests: its centre x(theta) is the
// tangential displacement, its radius h = mu N/k_t.

#include <arcslip/fourier/series.hpp>

#include <Eigen/Core>

namespace arcslip::elements {

/// n turned by a right angle, counterclockwise.
inline Eigen::Vector2d quarter_turn(const Eigen::Vector2d& n) {
  return {-n[1], n[0]};
}

/// At one angle, with derivatives by it.
struct DiscPoint {
  Eigen::Vector2d x, v, a;  // x, x', x''
  double h, dh, ddh;        // h, h', h''
};

class Disc {
 public:
  explicit Disc(const Harmonics& harmonics);

  /// Coefficients of x_1, x_2 and h, harmonics.size() each.
  void set(In x_1, In x_2, In h);

  const Harmonics& harmonics() const { return harmonics_; }
  auto coefficients(int i) const { return u_.col(i); }  // of x_1, x_2, h
  DiscPoint at(double theta) const;
  DiscPoint at(double cosine, double sine) const;  // of the angle
  Eigen::Vector2d mean() const { return {u_(0, 0), u_(0, 1)}; }
  double largest() const { return largest_; }  // a bound of |h|
  /// A bound of the derivative of this order, 0 to 3: of |x| (without the mean), and of |h|.
  double motion_bound(int order) const { return motion_[order]; }
  double radius_bound(int order) const { return radius_[order]; }

 private:
  Harmonics harmonics_;
  Eigen::Matrix<double, Eigen::Dynamic, 3> u_;
  double motion_[4] = {}, radius_[4] = {}, largest_ = 0;
};

}  // namespace arcslip::elements
