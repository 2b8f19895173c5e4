#pragma once
// The corners of one element: the onset of a further contact phase, or the merging of two. A function h of
// its motion vanishes there, h < 0 without the phase and h > 0 with it. J has a rank-one jump along grad h,
// or changes with the square root of h.
//
// h depends on angles theta_i, each defined by an equation a_i = 0, such as w'(theta) = 0 for a reversal.
// There h is stationary with respect to the angle of a reversal, but not to every angle.

#include <arcslip/fourier/series.hpp>

#include <span>
#include <vector>

namespace arcslip::elements {

inline constexpr double same_corner_angle = 1e-9;  // rad: angles so close are one

struct Corner {
  int guard = 0;               // index of the condition, numbered by the law
  std::vector<double> angles;  // rad
};

/// Made for one set of harmonics. w: the element's motion, as Element::move_to has it.
class Corners {
 public:
  using Fields = std::span<const double>;

  /// Row 0 is h (N or m), the others a_i.
  struct Equations {
    Equations(Eigen::Index motion, int angles, Eigen::Index fields)
        : values(1 + angles),
          by_motion(1 + angles, motion),
          by_angle(1 + angles, angles),
          by_field(1 + angles, fields) {}
    Eigen::VectorXd values;
    Eigen::MatrixXd by_motion, by_angle, by_field;
  };

  virtual ~Corners() = default;

  /// At any angles.
  virtual void equations(const Corner& corner, In w, Fields fields, Equations& at) = 0;
  /// The scale of h at this motion, in the unit of h.
  virtual double size(const Corner& corner, In w, Fields fields) = 0;
  /// Corrects approximate angles to those of w. False: w has no such corner.
  virtual bool polish(Corner& corner, In w, Fields fields) = 0;
  /// The corners with |h| <= tolerance times its scale; one of those related by a symmetry of w.
  virtual std::vector<Corner> near(In w, Fields fields, double tolerance) = 0;
};

}  // namespace arcslip::elements
