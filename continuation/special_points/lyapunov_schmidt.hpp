#pragma once
// Lyapunov-Schmidt reduction near a point x = (u, p): see multiple_point.hpp.

#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <memory>
#include <string>

namespace arcslip::continuation {

class LyapunovSchmidt {
 public:
  /// rank_loss: m, 1 or more. Without transposed solves W stays generic, which is regular as well but in
  /// general not as well conditioned.
  LyapunovSchmidt(const Problem& problem, const Vector& p, int along, int rank_loss,
                  const MakeLinearSolver& make_solver);

  /// Moves to x, with C and W from the null spaces of A there. False if F or its linearization cannot be
  /// evaluated, or M is singular.
  bool move_to(const Vector& x);

  const Vector& x() const { return x_; }
  const Matrix& right() const { return V_; }       // V, (n+1) x (m+1), orthonormal in scales
  const Matrix& left() const { return W_; }        // W, n x m, orthonormal
  bool has_left() const { return transposed_; }    // W spans the left null space
  const Matrix& gradient() const { return G_; }    // G, m x (m+1)
  const Vector& scales() const { return scale_; }  // of x
  double size() const { return x_.cwiseQuotient(scale_).norm(); }
  double magnitude() const {
    return magnitude_;
  }  // of |w_1| . |A x| in a generic direction x, and a tenth of |A x|

  /// Solves F + W beta = 0 along z; returns beta, m. Not finite if F cannot be evaluated.
  Vector settle();

  /// H_i = -dG_i/dy, (m+1) x (m+1) each, stacked: m (m+1) x (m+1), by differences of A. False on failure.
  bool form(Matrix& H);

  /// beta(y); x + V y + z in `place`. Not finite if not converged.
  Vector beta(const Vector& y, Vector& place);

 private:
  bool evaluate(const Vector& x, Needs needs);
  bool factorize();
  const Jacobian& regular_jacobian();
  void solve();
  bool left_vectors(Matrix& left);
  Matrix left_parts(const Matrix& left, const Matrix& changes);
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
  Jacobian regular_;    // of a sparse J
  Eigen::Index added_;  // entries that make it regular: m, or 0 for other J
  double shift_ = 0, magnitude_ = 0;
  bool transposed_ = true;
};

// Whether the solutions near a point form a curve, or a surface, as with a continuous symmetry (rotations,
// time shifts) and no phase condition.

/// A sentence if F = 0, to rounding, all around v = (u, p) in the plane of the two directions in which [J
/// F_p] is smallest: beta(y) of lyapunov_schmidt.hpp with m = 1 is then zero on a circle, where it is of
/// order |y| at a regular point and of order |y|^2 at a branch point. Or if combinations of the equations
/// vanish for all u, which it names. Empty otherwise.
std::string doubt_of_isolation(const Problem& problem, const Vector& v, const Vector& p, int along,
                               const MakeLinearSolver& make_solver);

}  // namespace arcslip::continuation
