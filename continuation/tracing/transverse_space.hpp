#pragma once
// Whether a branch passes a singular point in a step, where the linear solver does not know the sign of the
// determinant: section 8.5 of the theory.
//
// B = [J F_p; r^T] is the matrix of the step. With k more borders,
//
//   [ B    b ] [V]   [0]
//   [ C^T  0 ] [G] = [I],      det G = det B / det [B b; C^T 0] = det -(C^T X)^-1,   B X = b,
//
// changes its sign where B is singular, and with the factors at hand it costs k solves. The columns of b are
// generic and zero in the row of r, and X is taken across the tangent, so that neither depends on r. C is the
// orthonormal basis of X at the last point: near a branch point it holds the null vector, so that the
// bordered matrix is regular there. With the basis Q of X at the new point, det C^T Q is the product of the
// cosines between both spaces: 1 in the limit of short steps, and -1 beyond a branch point. Where it is near
// 0, the bordered matrix is nearly singular itself, and the sign of det G does not tell. k = 3: X holds the
// modes nearest to zero, so that one of them may cross it next to others that do not. Not installed.

#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/continuation/correction/curve_point.hpp>
#include <arcslip/continuation/tracing/state.hpp>
#include <arcslip/continuation/tracing/trial_step.hpp>

namespace arcslip::continuation {

class TransverseSpace {
 public:
  /// Both outlive this.
  TransverseSpace(const Corrector& factors, State& state) : factors_(factors), s_(state) {}

  enum class Sign { kept, changed, open };

  /// From the last point to the end of a step that is tried, whose factors are at hand.
  Sign compare(TrialStep& trial);

  /// Takes over the space of a point at which the branch goes on, whose factors are at hand. Does nothing
  /// where the sign of the determinant is known.
  void keep(TrialStep& trial, const CurvePoint& place);

 private:
  void choose_borders(Eigen::Index size);
  bool measure(const CurvePoint& place, Vector& basis);
  bool orthonormalize(Vector& basis, Eigen::Index column);
  double determinant(const Vector& one, const Vector& other);

  const Corrector& factors_;
  State& s_;
  Vector x_, y_;  // n + 1
};

}  // namespace arcslip::continuation
