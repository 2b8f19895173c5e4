#pragma once
// The bordered system of a branch,
//
//   [ J    F_p ] [x]   [f]
//   [ r^T   0* ] [y] = [g],      * r has n + 1 entries: the border row includes the parameter's column
//
// by LU with partial pivoting of the whole (n+1) x (n+1) matrix, which is regular at folds, where J is not.

#include <arcslip/continuation/problem.hpp>

#include <Eigen/LU>

namespace arcslip::continuation {

/// Keeps the factors; neither factorize nor the solves allocate for n <= 300.
class BorderedLU {
 public:
  explicit BorderedLU(int n);

  /// row: n + 1.
  /// Returns false where the matrix is singular or not finite; the factors are then not usable.
  bool factorize(const Jacobian& J, In F_p, In row);

  /// x: n + 1 on entry the right-hand side (f, g), on return the solution.
  void solve(Out x) const;
  /// The same with the transposed matrix.
  void solve_transposed(Out x) const;

  /// +1 or -1.
  int determinant_sign() const { return sign_; }

 private:
  Eigen::MatrixXd matrix_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  mutable Vector work_;
  double row_scale_ = 1;
  int sign_ = 1;
};

}  // namespace arcslip::continuation
