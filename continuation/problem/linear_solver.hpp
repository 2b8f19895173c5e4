#pragma once
// A solver of the bordered systems of continuation,
//
//   [ J    C ] [x]   [f]        J: n x n,  C: n x m,  R: m x n,  D: m x m
//   [ R    D ] [y] = [g]
//
// whose matrix is regular at folds, where J alone is not. linear/linear_solvers.hpp has those that are there.

#include <arcslip/continuation/problem/problem.hpp>

#include <optional>

namespace arcslip::continuation {

/// What stands around J.
struct Borders {
  Borders(int n, int m) : columns(n, m), rows(n, m), corner(m, m) {}
  int width() const { return static_cast<int>(corner.rows()); }

  Eigen::MatrixXd columns;  // C, n x m
  Eigen::MatrixXd rows;     // transposed R, n x m
  Eigen::MatrixXd corner;   // D, m x m
};

/// Keeps the factors of one bordered matrix. One for each thread.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// As results report it: "dense LU", "KLU".
  virtual const char* name() const = 0;

  /// False where the matrix is singular or not finite; the factors are then not usable. J keeps its kind,
  /// size and pattern from call to call. Throws std::invalid_argument for a kind that the solver does not
  /// take.
  virtual bool factorize(const Jacobian& J, const Borders& borders) = 0;

  /// x: n + m, on entry the right-hand side (f, g), on return the solution. Not finite where it failed.
  virtual void solve(Out x) const = 0;

  /// The same with the transposed matrix. False: this solver has no transposed solves, x is as it was.
  virtual bool solve_transposed(Out x) const {
    static_cast<void>(x);
    return false;
  }

  /// Whether the last factors took pivots, or anything else, from earlier ones, so that they are not those of
  /// this matrix alone to the last bit.
  virtual bool keeps_pivots() const { return false; }
  /// So that the next factors do not.
  virtual void forget_pivots() {}

  /// Sign of the determinant of the bordered matrix, +1 or -1, where the solver knows it. It orients branches
  /// across kinks and tells branch points and jumps; without it their parity goes unchecked.
  virtual std::optional<int> determinant_sign() const { return {}; }
};

}  // namespace arcslip::continuation
