#pragma once
// A piecewise linear force at given fields (piecewise_linear.hpp). A view: shapes and fields
// outlive it.

#include <arcslip/laws/memoryless/piecewise_linear.hpp>

namespace arcslip::elements {

class PiecewiseLinearCurve {
 public:
  PiecewiseLinearCurve(const std::vector<PiecewiseLinearShape>& shapes, Fields fields);

  const PiecewiseLinearShape& shape() const { return *shape_; }
  std::size_t lines() const { return shape_->lines(); }
  double length() const { return length_; }
  double length_sign() const { return sign_; }  // dL/d(its field); 0: L is no field
  double corner(std::size_t i) const { return shape_->corners[i] * length_; }

  /// The line at q: at a corner, that on its left.
  std::size_t line_at(double q) const;
  /// Whether line j has no length: the corners at its ends coincide.
  bool is_empty(std::size_t j) const;
  double slope(std::size_t j) const;
  double offset(std::size_t j) const;
  double force(std::size_t j, double q) const;

 private:
  Fields fields_;
  const PiecewiseLinearShape* shape_;
  double length_ = 1, sign_ = 0;
};

std::unique_ptr<Element> make_piecewise_linear(const std::vector<PiecewiseLinearShape>& shapes,
                                               const Harmonics& harmonics);

/// A maximum of the motion reaches corner i from below (guard 2 i + 1), or a minimum from above (guard 2 i).
/// One angle, that of the reversal; h = +-|jump of the slope| (w - corner), N.
std::unique_ptr<Corners> make_piecewise_linear_corners(const std::vector<PiecewiseLinearShape>& shapes,
                                                       bool antisymmetric, const Harmonics& harmonics);

}  // namespace arcslip::elements
