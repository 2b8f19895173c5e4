#pragma once
// The corners of frequency branches, where a guard of an element vanishes, h = 0
// (laws/grazing_condition.hpp): on the side h > 0 its contact has one more phase than on the other.
//
// Where J jumps across h = 0, by rank one along grad h, a branch has two tangents, and a peak or a fold may
// sit at the corner while another parameter changes.

#include <arcslip/continuation/special_points/stationary.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/laws/grazing_condition.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace arcslip::hbm {

/// A corner of an element of the model.
struct Corner : elements::Corner {
  int element = 0;
};

/// h at a solution near the corner; the angles become those of the solution. nullopt: it has no such corner.
std::optional<double> corner_excess(const HbmProblem& problem, Corner& corner, In u, In p);

/// The scale of h.
double corner_size(const HbmProblem& problem, const Corner& corner, In u, In p);

/// dh/du, n.
void corner_gradient(const HbmProblem& problem, const Corner& corner, In u, In p, Out dh);
/// The same within the harmonics of the motion u: a motion with a shorter period than the force, or an
/// antisymmetric one, reaches all images of a corner at once, and keeps its symmetry on both sides.
void corner_direction(const HbmProblem& problem, const Corner& corner, In u, In p, Out d);
/// dh/dp_k.
double corner_derivative(const HbmProblem& problem, const Corner& corner, In u, In p, int k);

/// The corners near a solution: |h| <= tolerance times its scale.
std::vector<Corner> corners_near(const HbmProblem& problem, In u, In p, double tolerance);

/// x and the angles of a corner: the unknowns of corner_points().
Vector with_angles(const Vector& x, const Corner& corner);
/// The corner with the angles at the end of these unknowns.
Corner at_angles(Corner corner, const Vector& unknowns);

/// F = 0, h = 0 and the equations of the angles as a problem in the unknowns (u, omega, angles) with the same
/// parameters; p[frequency] is ignored.
std::shared_ptr<const continuation::Problem> corner_points(std::shared_ptr<const HbmProblem> problem,
                                                           const Corner& corner);

/// Slopes dq/ds of a quantity on both sides of such a corner, along the branch over the frequency in the
/// orientation det [J F_omega; t^T] > 0, which is the same on both sides: below is h < 0, above h > 0.
/// direction: +1 where that leads from below to above. NaN where a side has no tangent.
struct CornerSlopes {
  double below = 0, above = 0;
  int direction = 0;
  bool is_maximum() const { return direction * below > 0 && direction * above < 0; }
  bool is_extreme() const { return below * above < 0; }
};

/// At corners of one kind along a curve. Owns its buffers.
class CornerSides {
 public:
  CornerSides(std::shared_ptr<const HbmProblem> problem, const Corner& corner,
              continuation::StationaryQuantity quantity);

  /// x: (u, omega, angles); p[frequency] is ignored.
  CornerSlopes slopes(In x, In p);

 private:
  double slope(double side, int& direction);

  std::shared_ptr<const HbmProblem> problem_;
  Corner corner_;
  continuation::StationaryQuantity quantity_;
  std::unique_ptr<HbmEvaluator> evaluator_;
  std::unique_ptr<continuation::LinearSolver> solver_;
  continuation::Borders border_;
  Vector u_, nearby_, p_, dh_, dq_, t_, scales_;
};

}  // namespace arcslip::hbm
