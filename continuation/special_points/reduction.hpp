#pragma once
// The reduced equation of Lyapunov and Schmidt beside a place x = (u, p): see multiple_point.hpp.

#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <memory>
#include <string>

namespace arcslip::continuation {

class Reduction {
 public:
  /// rank_loss: m, 1 or more. Each place needs transposed solves.
  Reduction(const Problem& problem, const Vector& p, int along, int rank_loss,
            const MakeLinearSolver& make_solver);

  /// To x, where C and W are taken from the null spaces of A as they are told there. False: F or its
  /// linearization cannot be had, or M is singular.
  bool move_to(const Vector& x);

  const Vector& x() const { return x_; }
  const Matrix& right() const { return V_; }       // V, (n+1) x (m+1), orthonormal in scales
  const Matrix& left() const { return W_; }        // W, n x m, orthonormal
  const Matrix& gradient() const { return G_; }    // G, m x (m+1)
  const Vector& scales() const { return scale_; }  // of x
  double size() const { return x_.cwiseQuotient(scale_).norm(); }
  double magnitude() const {
    return magnitude_;
  }  // of |w_1| . |A x| in a generic direction x, and a tenth of |A x|

  /// Moves along z to the place where F + W beta = 0; returns beta, m. Not finite where F cannot be
  /// evaluated.
  Vector settle();

  /// H_i = -dG_i/dy, (m+1) x (m+1) each, stacked: m (m+1) x (m+1), by differences of A. False: not to be had.
  bool form(Matrix& H);

  /// beta(y), and x + V y + z in `place`. Not finite where it is not found.
  Vector beta(const Vector& y, Vector& place);

 private:
  bool evaluate(const Vector& x, Needs needs);
  bool factorize();
  void solve();
  bool left_vectors(Matrix& left);
  bool null_spaces();

  const Problem& problem_;
  Vector p_;
  int along_;
  Eigen::Index n_, m_;
  std::unique_ptr<Evaluator> at_;
  std::unique_ptr<LinearSolver> M_;
  Borders borders_;
  Vector scale_, x_, F_p_, rhs_;
  Matrix C_, V_, W_, G_;
  double shift_ = 0, magnitude_ = 0;
};

// Whether the solutions around one are a curve at all, or a surface, as where a symmetry turns each of them
// into a family (an orbit of rotations, of shifts in time) and no phase condition picks one.

/// A sentence where F = 0, to rounding, all around v = (u, p) in the plane of the two directions in which [J
/// F_p] is smallest: beta(y) of reduction.hpp with m = 1 is zero on a circle, where it is of the size of |y|
/// at a point of a regular branch and of |y|^2 at a branch point. Empty: nothing to say.
std::string doubt_of_isolation(const Problem& problem, const Vector& v, const Vector& p, int along,
                               const MakeLinearSolver& make_solver);

}  // namespace arcslip::continuation
