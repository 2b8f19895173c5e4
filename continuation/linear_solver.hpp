#pragma once
// Solvers of the bordered systems of continuation,
//
//   [ J    C ] [x]   [f]        J: n x n,  C: n x m,  R: m x n,  D: m x m
//   [ R    D ] [y] = [g]
//
// whose matrix is regular at folds, where J alone is not. One interface, three implementations: dense LU and
// sparse LU of the whole matrix, and block elimination around a solver of J alone, which may be user-defined.

#include <arcslip/continuation/problem.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>

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
  /// across kinks and detects branch points and jumps between branches; without it they go unchecked.
  virtual std::optional<int> determinant_sign() const { return {}; }
};

/// A solver of J x = b alone, such as an iterative solver or a solver of another library.
class PlainSolver {
 public:
  virtual ~PlainSolver() = default;
  virtual const char* name() const = 0;
  /// Prepares for solves with J. False on failure.
  virtual bool prepare(const Jacobian& J) = 0;
  /// x = J^-1 b. False if not converged.
  virtual bool solve(In b, Out x) const = 0;
  /// x = J^-T b. False if not converged, or without transposed solves.
  virtual bool solve_transposed(In b, Out x) const {
    static_cast<void>(b), static_cast<void>(x);
    return false;
  }
  /// Sign of det J, if known.
  virtual std::optional<int> determinant_sign() const { return {}; }
};

using MakeLinearSolver = std::function<std::unique_ptr<LinearSolver>()>;

/// LU with partial pivoting of the whole matrix. Neither factorize nor solves allocate for n <= 300.
/// Dense Jacobians.
std::unique_ptr<LinearSolver> dense_lu();

/// Sparse LU of the whole matrix by KLU. The ordering is reused, and the pivots as long as they are stable.
/// Sparse Jacobians.
std::unique_ptr<LinearSolver> klu();

/// Block elimination around a solver of J, with iterative refinement on the whole system (Govaerts and Pryce,
/// BIT 30, 1990), which tolerates a numerically singular J. For every kind of Jacobian that `plain` supports.
std::unique_ptr<LinearSolver> block_elimination(std::unique_ptr<PlainSolver> plain);

/// The default for the kind of Jacobian: dense LU or KLU. Throws std::invalid_argument for an Operator, which
/// requires a user-defined solver.
std::unique_ptr<LinearSolver> suitable_solver(const Jacobian& J);

/// Throws std::invalid_argument for an unsupported kind of Jacobian. kind: the supported one, "dense"
/// or "sparse".
[[noreturn]] void refuse_kind(const std::string& solver, const std::string& kind);

/// y = J x, for every kind of Jacobian.
void apply(const Jacobian& J, In x, Out y);
/// y = J^T x. False: operator without transpose.
bool apply_transposed(const Jacobian& J, In x, Out y);

}  // namespace arcslip::continuation
