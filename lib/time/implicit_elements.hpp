#pragma once
// The nonlinear elements in one implicit step: the increment y of the displacement x that solves
//
//   A y + sum_e d_e f_e = b
//
// with the forces f_e at the end of the step. A Jenkins element is exact over a step in which q = d . x moves
// one way: with f at its beginning, f_e = clamp(f + kd d . y, -mu Fn, mu Fn). A cubic spring: k3 (q + d .
// y)^3.
//
// Where A is positive definite and no spring softens, y is the minimum of a convex function. Newton's method
// with the exact tangent A + sum_e t_e d_e d_e^T is kept from cycling between contact states by a search
// along each Newton step for where the slope of that function vanishes. The factors of the tangent are kept
// as long as the t_e stay the same, and so, with Jenkins elements alone, while the contact state does.

#include <arcslip/continuation/dense_algebra.hpp>
#include <arcslip/time/equation_of_motion.hpp>

#include <vector>

namespace arcslip::time {

enum class Solved {
  yes,
  no,          // not after largest_iterations
  singular,    // a motion that nothing holds in this contact state
  not_finite,  // beyond all numbers
};

class ImplicitElements {
 public:
  static constexpr int largest_iterations = 60;

  ImplicitElements(std::vector<Element> elements, int dofs);

  void set_matrix(const Matrix& A);
  /// The state in which the next step begins. A slider beyond its limit is drawn after.
  void begin(const Vector& x, const Vector& z) { begin_at(D_.transpose() * x, z); }
  /// The same with q_e = d_e . x.
  void begin_at(const Vector& q, const Vector& z);

  /// y: a guess, then the solution. Does not allocate.
  Solved solve(const Vector& b, Vector& y);
  /// The end of the step becomes the beginning of the next.
  void accept();

  /// At the beginning of the step: forces (N), sliders (m), and the energy that the elements hold (J).
  const Vector& force() const { return force_; }
  const Vector& slider() const { return z_; }
  double energy() const;
  /// At its end, after solve(): forces, and the way each slider went (m).
  const Vector& new_force() const { return new_force_; }
  const Vector& slip() const { return slip_; }
  bool slides(std::size_t element) const;

  const std::vector<Element>& elements() const { return elements_; }
  const Matrix& directions() const { return D_; }  // dofs x elements

  /// Of the last step solved, accepted or not: changes of the forces at its beginning with the state there.
  /// dx, dz: a column for each change.
  void force_change(const Matrix& dx, const Matrix& dz, Matrix& df) const;
  /// Of the last step solved: changes of the solution. db: of b, becomes dy; dz: of the sliders, becomes that
  /// at the end of the step.
  void differentiate(const Matrix& dx, Matrix& dz, Matrix& db);

 private:
  void evaluate(const Vector& y);
  double residual(const Vector& y);
  bool factorize();
  double search(const Vector& y, double slope);

  std::vector<Element> elements_;
  Matrix D_, size_of_D_, A_, size_of_A_, J_;
  continuation::LU<double> lu_;
  Vector factored_;  // the t_e that lu_ is of
  bool has_factors_ = false;
  Vector q_, z_, force_, stiffness_;        // at the beginning; df/dq of elements that stick
  Vector new_force_, tangent_, dq_, slip_;  // at the end
  Vector b_, residual_, size_, step_, trial_;
  Matrix df_;
};

}  // namespace arcslip::time
