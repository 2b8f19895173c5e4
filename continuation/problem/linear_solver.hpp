#pragma once
// A solver of the bordered systems of continuation,
//
//   [ J    C ] [x]   [f]        J: n x n,  C: n x m,  R: m x n,  D: m x m
//   [ R    D ] [y] = [g]
//
// whose matrix is regular at folds, where J alone is not. linear/linear_solvers.hpp has the implementations.

#include <arcslip/continuation/problem/problem.hpp>

#include <optional>

namespace arcslip::continuation {

/// The borders of J.
struct Borders {
  Borders(int n, int m) : columns(n, m), rows(n, m), corner(m, m) {}
  int width() const { return static_cast<int>(corner.rows()); }

  Eigen::MatrixXd columns;  // C, n x m
  Eigen::MatrixXd rows;     // transposed R, n x m
  Eigen::MatrixXd corner;   // D, m x m
};

/// Solver of bordered systems, which keeps the factors of one matrix. Not thread-safe: one for each thread.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// The name in results: "dense LU", "KLU".
  virtual const char* name() const = 0;

  /// False if the matrix is singular or not finite; the factors are then invalid. J keeps its kind, size and
  /// pattern from call to call. Throws std::invalid_argument for an unsupported kind.
  virtual bool factorize(const Jacobian& J, const Borders& borders) = 0;

  /// x: n + m, on entry the right-hand side (f, g), on return the solution; not finite after a failure.
  virtual void solve(Out x) const = 0;

  /// The same with the transposed matrix. False: no transposed solves, x is unchanged.
  virtual bool solve_transposed(Out x) const {
    static_cast<void>(x);
    return false;
  }

  /// Whether the last factors reuse pivots, or anything else, of earlier ones, so that they depend on the
  /// history in the last bits.
  virtual bool keeps_pivots() const { return false; }
  /// Makes the next factors independent of earlier ones.
  virtual void forget_pivots() {}

  /// Sign of the determinant of the bordered matrix, +1 or -1, if the solver provides it. It orients branches
  /// across kinks and detects branch points and jumps between branches. Without it tangents are oriented by
  /// the one before, and three further solves per point detect branch points and jumps where F is smooth.
  virtual std::optional<int> determinant_sign() const { return {}; }
};

}  // namespace arcslip::continuation
