#pragma once
// Solvers of the bordered systems of continuation,
//
//   [ J    C ] [x]   [f]        J: n x n,  C: n x m,  R: m x n,  D: m x m
//   [ R    D ] [y] = [g]
//
// whose matrix is regular at folds, where J alone is not. Three ways to one interface: dense LU and sparse LU
// of the whole matrix, and block elimination around a solver of J alone, which may be the user's own.

#include <arcslip/continuation/problem.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>

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

/// A solver of J x = b alone, as iterative solvers and solvers of other libraries are.
class PlainSolver {
 public:
  virtual ~PlainSolver() = default;
  virtual const char* name() const = 0;
  /// Makes ready for solves with J. False: not possible.
  virtual bool prepare(const Jacobian& J) = 0;
  /// x = J^-1 b. False: not reached.
  virtual bool solve(In b, Out x) const = 0;
  /// x = J^-T b. False: not reached, or there is no transpose.
  virtual bool solve_transposed(In b, Out x) const {
    static_cast<void>(b), static_cast<void>(x);
    return false;
  }
  /// Of J, where it is known.
  virtual std::optional<int> determinant_sign() const { return {}; }
};

using MakeLinearSolver = std::function<std::unique_ptr<LinearSolver>()>;

/// LU with partial pivoting of the whole matrix. Neither factorize nor solves allocate for n <= 300.
/// Dense Jacobians.
std::unique_ptr<LinearSolver> dense_lu();

/// Sparse LU of the whole matrix by KLU. The ordering is kept, and the pivots while they are good.
/// Sparse Jacobians.
std::unique_ptr<LinearSolver> klu();

/// Block elimination around a solver of J, with iterative refinement on the whole system (Govaerts and Pryce,
/// BIT 30, 1990), which survives a J that is singular to rounding. For every kind of Jacobian that `plain`
/// takes.
std::unique_ptr<LinearSolver> block_elimination(std::unique_ptr<PlainSolver> plain);

/// What suits the kind of Jacobian: dense LU or KLU. Throws std::invalid_argument for an Operator, whose
/// solver has to be named.
std::unique_ptr<LinearSolver> suitable_solver(const Jacobian& J);

/// What a solver throws for a Jacobian of another kind than its own: std::invalid_argument, with the solver's
/// name and the kind it takes, "dense" or "sparse".
[[noreturn]] void refuse_kind(const std::string& solver, const std::string& kind);

/// y = J x, for every kind.
void apply(const Jacobian& J, In x, Out y);
/// y = J^T x. False: an operator without transpose.
bool apply_transposed(const Jacobian& J, In x, Out y);

}  // namespace arcslip::continuation
