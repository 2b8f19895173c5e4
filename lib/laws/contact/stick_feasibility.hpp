#pragma once
// Whether a slider may rest for a whole period in a disc that moves, and its centred rest.
//
// A rest w is possible iff r(w) = max over theta of |x - w| - h is at most 0. r is convex: its minimiser is
// the centre of the rests that are possible, and the limit from slip as r -> 0. It is decided by two opposite
// active angles or by three, where |x - w| - h = r is largest. x and h count without their means, next to
// which the motion may be very small, and in units of the motion.

#include <arcslip/laws/contact/planar_slider.hpp>

#include <optional>
#include <vector>

namespace arcslip::elements {

/// w and r with |x - w| - h = r at two or three instants: the minimiser for these, if all of them decide it.
struct StickMargin {
  Eigen::Vector2d w;
  double r;
};
StickMargin stick_margin(const DiscInstant& a, const DiscInstant& b);
/// None: they lie on a line, or no r is common to them.
std::optional<StickMargin> stick_margin(const DiscInstant& a, const DiscInstant& b, const DiscInstant& c);

class StickCentre {
 public:
  explicit StickCentre(const Harmonics& harmonics);

  /// The minimiser of r.
  void find(const Disc& disc);

  Eigen::Vector2d w() const { return mean_x_ + unit_ * w_; }
  double r() const { return unit_ * r_ - mean_h_; }
  const std::vector<double>& active() const { return active_; }  // rad
  /// dw by the coefficients of x_1, x_2 and h: 2 x 3 harmonics.size().
  void derivative(Eigen::Ref<Eigen::MatrixXd> dw) const;

 private:
  using Point = DiscInstant;
  double excess(const Point& at, const Eigen::Vector2d& w) const { return (at.x - w).norm() - at.h; }
  Point point(double theta) const;
  Point farthest();
  double climb(double theta) const;
  void solve(std::vector<Point>& basis);
  double half_spacing() const { return 0.5 * whole_turn / static_cast<double>(samples_.size()); }
  void merge_neighbours();
  double polish_three();
  double polish_opposite();
  void polish();
  void derivative_of_one(Eigen::Ref<Eigen::MatrixXd> dw) const;
  void derivative_of_three(Eigen::Ref<Eigen::MatrixXd> dw) const;
  void derivative_of_opposite(Eigen::Ref<Eigen::MatrixXd> dw) const;

  Harmonics harmonics_;
  Disc disc_;  // without means, in units
  Eigen::Matrix<double, Eigen::Dynamic, 3> varying_;
  Eigen::Vector2d mean_x_ = Eigen::Vector2d::Zero();
  double mean_h_ = 0, unit_ = 1;
  DiscAngles angles_;
  std::vector<Point> samples_;  // there
  std::vector<double> excess_;
  Eigen::Vector2d w_ = Eigen::Vector2d::Zero();  // from mean_x_, in units
  double r_ = 0;                                 // above -mean_h_, in units
  std::vector<double> active_;
};

}  // namespace arcslip::elements
