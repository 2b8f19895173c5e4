#pragma once
// Three ways to solve bordered systems (problem/linear_solver.hpp): dense LU and sparse LU of the whole
// matrix, and block elimination around a solver of J alone, which may be the user's own.

#include <arcslip/continuation/problem/linear_solver.hpp>

#include <memory>
#include <optional>
#include <string>

namespace arcslip::continuation {

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

}  // namespace arcslip::continuation
