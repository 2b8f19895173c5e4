#pragma once
// Whether a slider may rest for a whole period in a disc that moves, and its centred rest.
//
// A rest w is possible iff r(w) = max over theta of |x - w| - h is at most 0. r is convex: its minimiser is
// the centre of the rests that are possible, and the limit from slip as r -> 0. It is decided by two opposite
// active angles or by three, where |x - w| - h = r is largest.

#include <arcslip/elements/disc.hpp>

#include <vector>

namespace arcslip::elements {

class StickCentre {
 public:
  explicit StickCentre(const Harmonics& harmonics);

  /// The minimiser of r.
  void find(const Disc& disc);

  const Eigen::Vector2d& w() const { return w_; }
  double r() const { return r_; }
  const std::vector<double>& active() const { return active_; }  // rad
  /// dw by the coefficients of x_1, x_2 and h: 2 x 3 harmonics.size().
  void derivative(const Disc& disc, Eigen::Ref<Eigen::MatrixXd> dw) const;

 private:
  struct Point {
    double theta;
    Eigen::Vector2d x;
    double h;
  };
  double excess(const Point& at, const Eigen::Vector2d& w) const { return (at.x - w).norm() - at.h; }
  Point point(const Disc& disc, double theta) const;
  Point farthest(const Disc& disc);
  double climb(const Disc& disc, double theta) const;
  void solve(std::vector<Point>& basis);
  void pair(const Point& a, const Point& b);
  bool triple(const Point& a, const Point& b, const Point& c);
  void polish(const Disc& disc);

  Harmonics harmonics_;
  std::vector<Point> samples_;
  std::vector<double> excess_;
  Eigen::Vector2d w_ = Eigen::Vector2d::Zero();
  double r_ = 0;
  std::vector<double> active_;
};

}  // namespace arcslip::elements
