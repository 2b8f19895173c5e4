#pragma once
// The disc in which the slider of a contact with two tangential directions rests: its centre x(theta) is the
// tangential displacement, its radius h = mu N/k_t.

#include <arcslip/fourier/series.hpp>

#include <Eigen/Core>

#include <vector>

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

/// At one angle, rad.
struct DiscInstant {
  double theta;
  Eigen::Vector2d x;
  double h;
};

/// Angles at equal distances over a period.
struct DiscAngles {
  explicit DiscAngles(int count);
  std::vector<double> theta, cosine, sine;
};

/// h and derivatives by the angle, of x = (x[0], x[1]) and h, at several angles.
template <int count>
struct DiscNodes {
  using Nodes = Eigen::Matrix<double, count, 1>;
  Nodes v[2], a[2];
  Nodes h, dh, ddh;
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
  /// At the angles of the indices 0, stride, 2 stride ... of a list as long as theirs.
  void at(const DiscAngles& angles, std::size_t stride, std::vector<DiscInstant>& instants) const;
  template <int count>
  void at(const Eigen::Matrix<double, count, 1>& cosines, const Eigen::Matrix<double, count, 1>& sines,
          DiscNodes<count>& nodes) const;
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

template <int count>
void Disc::at(const Eigen::Matrix<double, count, 1>& cosines, const Eigen::Matrix<double, count, 1>& sines,
              DiscNodes<count>& nodes) const {
  using Nodes = Eigen::Matrix<double, count, 1>;
  Nodes c = cosines, s = sines;
  nodes.h.setConstant(u_(0, 2));
  for (Nodes* derivative : {&nodes.v[0], &nodes.v[1], &nodes.a[0], &nodes.a[1], &nodes.dh, &nodes.ddh})
    derivative->setZero();
  for (int n = 1; n <= harmonics_.order; ++n) {
    for (int i = 0; i < 3; ++i) {
      const double a = u_(n, i), b = u_(harmonics_.order + n, i), square = static_cast<double>(n) * n;
      const Nodes even = a * c + b * s;
      (i < 2 ? nodes.v[i] : nodes.dh) += (n * b) * c - (n * a) * s;
      (i < 2 ? nodes.a[i] : nodes.ddh) -= square * even;
      if (i == 2) nodes.h += even;
    }
    const Nodes next = c.cwiseProduct(cosines) - s.cwiseProduct(sines);
    s = s.cwiseProduct(cosines) + c.cwiseProduct(sines);
    c = next;
  }
}

}  // namespace arcslip::elements
