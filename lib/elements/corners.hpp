#pragma once
// The corners of one element: where one more phase of its contact is about to be born, or two become one. A
// function h of its motion vanishes there, h < 0 without the phase and h > 0 with it. J jumps by rank one
// along grad h, or changes there with the root of h.
//
// h depends on angles theta_i, each told by an equation a_i = 0, as w'(theta) = 0 of a reversal. Where these
// hold, h does not change with the angles, so that grad h is the partial derivative.

#include <arcslip/elements/series.hpp>

#include <span>
#include <vector>

namespace arcslip::elements {

struct Corner {
  int guard = 0;               // which condition it is, by the law's own numbering
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

  /// How many each corner has.
  virtual int angles() const = 0;
  /// At any angles.
  virtual void equations(const Corner& corner, In w, Fields fields, Equations& at) = 0;
  /// What h is measured by at this motion, in the unit of h.
  virtual double size(const Corner& corner, In w, Fields fields) = 0;
  /// From angles nearby to those of w. False: w has no such corner.
  virtual bool polish(Corner& corner, In w) = 0;
  /// |h| <= tolerance times its size. Of corners that are images of one another by a symmetry of w, one.
  virtual std::vector<Corner> near(In w, Fields fields, double tolerance) = 0;
};

}  // namespace arcslip::elements
