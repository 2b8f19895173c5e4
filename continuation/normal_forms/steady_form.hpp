#pragma once
// Normal forms of u' = F(u, p) where one real eigenvalue is zero: folds, branch points and cusps.
//
// On the centre manifold u = u_0 + z q + z^2 h / 2 + ..., with J q = 0, J^T w = 0, <q, q> = <w, q> = 1 and a
// parameter p of u_p along a branch,
//
//   z' = b (p - p_0) + a z^2 + c z^3           away from branch points
//   z' = d (p - p_0) z + a z^2 + c z^3         along a branch through a branch point
//
//   a = <w, B(q, q)> / 2,   b = <w, F_p>,   d = <w, D^2 F (q, 0) (u_p, 1)>
//   J h = -B(q, q) + 2 a q, <w, h> = 0,     c = <w, C(q, q, q) + 3 B(q, h)> / 6
//
// (Kuznetsov 2004, sections 3.2, 5.4.2 and 8.7; c at a cusp and at a pitchfork, where a = 0).

#include <arcslip/continuation/normal_forms/directional_derivatives.hpp>
#include <arcslip/continuation/problem/branch.hpp>

namespace arcslip::continuation {

/// Coefficients from null vectors of any length, q: right, w: left, n. Not known where w . q = 0. Not
/// installed.
class SteadyForm {
 public:
  SteadyForm(Evaluator& at, const PlaceOfForms& place, const Vector& right, const Vector& left);

  /// Whether w . q is not zero.
  bool usable() const { return usable_; }

  Coefficient quadratic();
  Coefficient unfolding();
  /// c. J is factorized once. Not known for an operator.
  Coefficient cubic();
  /// d along a tangent of a branch, n + 1, with dp != 0.
  Coefficient crossing(const Vector& tangent);

 private:
  const RealForm& B();

  DirectionalDerivatives forms_;
  Eigen::Index n_;
  Vector q_, w_;
  RealForm B_;
  bool usable_ = false;
};

/// Adds the coefficients of a fold, or of a simple branch point with its tangents. The evaluator is moved.
void add_normal_form(Evaluator& at, const PlaceOfForms& place, Fold& fold);
void add_normal_form(Evaluator& at, const PlaceOfForms& place, BranchPoint& point);

}  // namespace arcslip::continuation
