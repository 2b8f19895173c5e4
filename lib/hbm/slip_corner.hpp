#pragma once
// The corners of frequency branches where a friction element begins to slip at a reversal of its motion w:
// stuck since the reversal theta_a, where f = sigma_a mu F_n, it comes to the slip limit in the direction
// sigma just at the reversal theta_r,
//
//   h = (sigma k_d (w(theta_r) - w(theta_a)) - (1 - sigma sigma_a) mu F_n) / 2 = 0,   w'(theta_a) =
//   w'(theta_r) = 0.
//
// h < 0: no slip phase there, h > 0: a short one. From full stick, theta_a is where w is least and theta_r
// where it is largest: h = k_d (max w - min w)/2 - mu F_n. Of an element that sticks, sigma = sigma_a is the
// corner where another reversal becomes the highest or the lowest, and the mean of its force is told by that.
// J jumps by rank one across h = 0, along grad h, so that a branch has two tangents there, and a peak or a
// fold may sit at the corner while another parameter changes.

#include <arcslip/continuation/stationary.hpp>
#include <arcslip/hbm/problem.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace arcslip::hbm {

/// Which corner: the element, the two reversals, and the signs of the force at the first and beyond the
/// second.
struct SlipCorner {
  int element = 0;                        // of the model, a Jenkins element
  double anchor = 0, reversal = 0;        // theta_a, theta_r, rad
  double anchor_sign = 1, slip_sign = 1;  // sigma_a, sigma
};

/// h (N) at a solution near the corner; theta_a and theta_r become those of the solution. nullopt: it has no
/// such reversals.
std::optional<double> slip_excess(const HbmProblem& problem, SlipCorner& corner, In u, In p);

/// mu F_n of an element, N.
double slip_limit(const HbmProblem& problem, int element, In p);

/// What h is measured by, N: mu F_n or, where the motion takes less, k_d |w|.
double slip_excess_size(const HbmProblem& problem, const SlipCorner& corner, In u, In p);

/// dh/du, n.
void slip_excess_gradient(const HbmProblem& problem, const SlipCorner& corner, In p, Out dh);
/// The same within the harmonics that the motion u has: a motion of a shorter period than the force's, or
/// whose half periods mirror each other, comes to the images of a corner together with it, and stays such a
/// motion on both sides of them.
void slip_excess_direction(const HbmProblem& problem, const SlipCorner& corner, In u, In p, Out d);
/// dh/dp_k.
double slip_excess_derivative(const HbmProblem& problem, const SlipCorner& corner, In u, In p, int k);

/// The corners that a solution is next to: |h| <= tolerance mu F_n.
std::vector<SlipCorner> slip_corners_near(const HbmProblem& problem, In u, In p, double tolerance);

/// F = 0, h = 0, w'(theta_a) = 0, w'(theta_r) = 0 as a problem in the unknowns (u, omega, theta_a, theta_r)
/// and the same parameters; p[frequency] is not looked at.
std::shared_ptr<const continuation::Problem> slip_corner_points(std::shared_ptr<const HbmProblem> problem,
                                                                const SlipCorner& corner);

/// Slopes dq/ds of a quantity on both sides of such a corner, along the branch over the frequency in the
/// orientation det [J F_omega; t^T] > 0, which is the same on both sides. direction: +1 where that leads from
/// stick to slip, -1 from slip to stick. NaN where a side has no tangent.
struct CornerSlopes {
  double stick = 0, slip = 0;
  int direction = 0;
  bool is_maximum() const { return direction * stick > 0 && direction * slip < 0; }
  bool is_extreme() const { return stick * slip < 0; }
};

/// At corners of one kind along a curve. Owns its buffers.
class CornerSides {
 public:
  CornerSides(std::shared_ptr<const HbmProblem> problem, const SlipCorner& corner,
              continuation::Quantity quantity);

  /// x: (u, omega, theta_a, theta_r); p[frequency] is not looked at.
  CornerSlopes slopes(In x, In p);

 private:
  double slope(double side, int& direction);

  std::shared_ptr<const HbmProblem> problem_;
  SlipCorner corner_;
  continuation::Quantity quantity_;
  std::unique_ptr<HbmEvaluator> evaluator_;
  std::unique_ptr<continuation::LinearSolver> solver_;
  continuation::Borders border_;
  Vector u_, beside_, p_, dh_, dq_, t_, scales_;
};

}  // namespace arcslip::hbm
