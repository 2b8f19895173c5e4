// Reversals of the motion at corners of a piecewise linear force (piecewise_linear_curve.hpp).
#include <arcslip/laws/memoryless/piecewise_linear_curve.hpp>

#include <arcslip/fourier/reversals.hpp>
#include <arcslip/laws/reversal_condition.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arcslip::elements {
namespace {

class PiecewiseLinearCorners final : public Corners {
 public:
  PiecewiseLinearCorners(const std::vector<PiecewiseLinearShape>& shapes, bool antisymmetric,
                         const Harmonics& h)
      : shapes_(shapes), antisymmetric_(antisymmetric), h_(h), reversals_(h), phi_(h.size()) {}

  void equations(const Corner& corner, In w, Fields fields, Equations& at) override {
    const PiecewiseLinearCurve curve(shapes_, fields);
    const std::size_t i = corner_of(corner);
    const double jump = jump_at(curve, i), k = side(corner) * std::abs(jump);
    const Values values = series_values(h_, w, corner.angles[0]);
    const double beyond = values.x - curve.corner(i);
    set_reversal_row(h_, corner, w, 1, at);
    at.values[0] = k * beyond;
    series_basis(h_, corner.angles[0], phi_);
    at.by_motion.row(0) = k * phi_.transpose();
    at.by_angle(0, 0) = k * values.d1;
    const auto& terms = curve.shape().terms;
    for (std::size_t a = 0; a < terms.size(); ++a)
      at.by_field(0, static_cast<Eigen::Index>(a)) =
          side(corner) * std::copysign(1.0, jump) * (terms[a][i + 1].slope - terms[a][i].slope) * beyond;
    if (terms.size() < fields.size())
      at.by_field(0, static_cast<Eigen::Index>(terms.size())) =
          -k * curve.shape().corners[i] * curve.length_sign();
  }

  double size(const Corner& corner, In w, Fields fields) override {
    const double mean = h_.odd ? 0 : std::abs(w[0]);
    return std::abs(jump_at({shapes_, fields}, corner_of(corner))) * (series_bound(h_, w, 0) + mean);
  }

  bool polish(Corner& corner, In w, Fields) override {
    return polish_reversal(h_, w, side(corner), corner.angles[0]);
  }

  std::vector<Corner> near(In w, Fields fields, double tolerance) override {
    const PiecewiseLinearCurve curve(shapes_, fields);
    std::vector<Corner> found;
    for (const Reversal& at : reversals_.find(w))
      for (const double sign : {1.0, -1.0}) {
        const double x = sign * at.x, theta = sign > 0 ? at.theta : at.theta + std::numbers::pi;
        if (sign < 0 && !h_.odd) break;
        const int is_maximum = series_values(h_, w, theta).d2 < 0 ? 1 : 0;
        for (std::size_t i = 0; i + 1 < curve.lines(); ++i) {
          const double jump = jump_at(curve, i);
          if (jump == 0) continue;
          const Corner corner{2 * static_cast<int>(i) + is_maximum, {theta}};
          const bool is_near = std::abs(jump * (x - curve.corner(i))) <= tolerance * size(corner, w, fields);
          if (is_near && !is_listed(found, corner, w)) found.push_back(corner);
        }
      }
    return found;
  }

 private:
  static std::size_t corner_of(const Corner& corner) { return static_cast<std::size_t>(corner.guard / 2); }
  static double side(const Corner& corner) { return corner.guard % 2 == 1 ? 1 : -1; }
  static double jump_at(const PiecewiseLinearCurve& curve, std::size_t i) {
    return curve.slope(i + 1) - curve.slope(i);
  }

  // An image of one that is there, by a symmetry of the motion.
  bool is_listed(const std::vector<Corner>& all, const Corner& corner, In w) const {
    const int mirrored = 2 * static_cast<int>(shapes_.front().corners.size()) - 1 - corner.guard;
    return std::any_of(all.begin(), all.end(), [&](const Corner& other) {
      const double shift = corner.angles[0] - other.angles[0];
      return (other.guard == corner.guard && is_image(h_, w, shift, 1)) ||
             (antisymmetric_ && other.guard == mirrored && is_image(h_, w, shift, -1));
    });
  }

  std::vector<PiecewiseLinearShape> shapes_;
  bool antisymmetric_;
  Harmonics h_;
  Reversals reversals_;
  Eigen::VectorXd phi_;
};

}  // namespace

std::unique_ptr<Corners> make_piecewise_linear_corners(const std::vector<PiecewiseLinearShape>& shapes,
                                                       bool antisymmetric, const Harmonics& harmonics) {
  return std::make_unique<PiecewiseLinearCorners>(shapes, antisymmetric, harmonics);
}

}  // namespace arcslip::elements
