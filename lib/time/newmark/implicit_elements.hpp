#pragma once
// The nonlinear elements in one implicit step: the increment y of the displacement x that solves
//
//   A y + sum_e D_e f_e = b
//
// with the forces f_e at the end of the step, which each law gives for D_e^T y, and their tangents T_e. Laws
// that depend on velocities take those of the end of the step, v1 = B y + S v0, and their tangent is
// D_e (f_q D_e^T + f_v D_e^T B) y.
//
// Where A is positive definite, all T_e are symmetric and no spring softens, y is the minimum of a convex
// function. Newton's method with the exact tangent A + sum_e D_e T_e D_e^T is kept from cycling between
// contact states by a search along each Newton step for where the slope of that function vanishes. Where a
// law's T_e is not symmetric (Law::symmetric_step) there is no such function: a step is halved until the
// residual falls. The factors of the tangent are kept as long as the T_e stay the same, and so, of piecewise
// linear laws alone, while the contact state does.

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/time/equation/equation_of_motion.hpp>

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

  ImplicitElements(std::vector<TimeElement> elements, int dofs);

  void set_matrix(const Matrix& A);
  /// v1 = B y + S v0; without it v1 = v0.
  void set_velocities(const Matrix& B, const Matrix& S);
  /// The phase of the excitation, rad, of the next state that is begun in, or of the end of the next step.
  void set_phase(double phase) { phase_ = phase; }
  /// The state in which the next step begins. A slider beyond its limit is drawn after.
  void begin(const Vector& x, const Vector& v, const Vector& z);
  /// The same with q = D^T x and its rate D^T v.
  void begin_at(const Vector& q, const Vector& rate, const Vector& z);

  /// y: a guess, then the solution. Does not allocate.
  Solved solve(const Vector& b, Vector& y);
  /// The end of the step, with its velocities, becomes the beginning of the next.
  void accept(const Vector& v);

  /// At the beginning of the step: forces (N, one for each direction), memory, and the energy that the
  /// elements hold (J).
  const Vector& force() const { return force_; }
  const Vector& memory() const { return z_; }
  double energy() const;
  /// After solve(): what the step did to one element, and how its memory changed.
  const elements::StepEnd& end(std::size_t element) const { return ends_[element]; }
  const Vector& memory_change() const { return dz_; }

  const std::vector<TimeElement>& elements() const { return elements_; }
  const Matrix& directions() const { return D_; }  // dofs x directions of all elements
  /// The first of an element's among these.
  Eigen::Index first_direction(std::size_t element) const { return first_[element]; }

  /// Of the last step accepted: changes of the forces at its beginning with the state there.
  /// dx, dv, dz: a column for each change.
  void force_change(const Matrix& dx, const Matrix& dv, const Matrix& dz, Matrix& df);
  /// Of the same step: changes of the solution. db: of b, becomes dy; dz: of the memory, becomes that at
  /// the end of the step.
  void differentiate(const Matrix& dx, const Matrix& dv, Matrix& dz, Matrix& db);

 private:
  void evaluate(const Vector& y);
  double residual(const Vector& y);
  bool factorize();
  double search(const Vector& y, double slope);
  double halve(const Vector& y, double size);

  std::vector<TimeElement> elements_;
  std::vector<std::unique_ptr<elements::TimeLaw>> laws_;
  std::vector<Eigen::Index> first_;
  std::vector<elements::StepEnd> ends_, starts_;  // of the step; of the state before the last accept()
  bool convex_ = true, moves_ = false;            // some law depends on velocities
  Matrix D_, size_of_D_, A_, size_of_A_, J_;
  Matrix B_of_D_, S_of_D_;  // B^T D, S^T D
  continuation::LU<double> lu_;
  Vector tangent_, factored_;  // all T_e one after the other; those that lu_ is of
  bool has_factors_ = false;
  double phase_ = 0, start_phase_ = 0,
         last_phase_ = 0;                   // at the end, at the beginning, before the last accept()
  Vector q_, z_, force_, last_q_, last_z_;  // at the beginning; before the last accept()
  Vector rate_, last_rate_;                 // D^T v likewise, where it is needed
  Vector new_force_, dq_, dz_;              // at the end
  Vector carried_, new_rate_;               // D^T S v0, D^T v1
  Vector b_, residual_, size_, step_, trial_, halved_, moved_;
  Matrix df_, dq_columns_;
};

}  // namespace arcslip::time
