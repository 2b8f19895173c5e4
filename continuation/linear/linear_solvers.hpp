#pragma once
// Three solvers of bordered systems (problem/linear_solver.hpp): dense LU and sparse LU of the whole matrix,
// and block elimination around a solver of J alone, which may be user-defined.

#include <arcslip/continuation/problem/linear_solver.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::continuation {

/// A solver of J x = b alone, such as an iterative solver or a solver of another library.
class PlainSolver {
 public:
  virtual ~PlainSolver() = default;
  virtual const char* name() const = 0;
  /// Prepares for solves with J. False on failure, as where J is singular: a matrix next to it is then
  /// prepared, of the same kind and pattern. It may also throw.
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

/// LU with partial pivoting of the whole matrix. Neither factorize nor solves allocate for n <= 300.
/// Dense Jacobians.
std::unique_ptr<LinearSolver> dense_lu();

/// The same for unknowns in groups, such as the harmonics of a periodic motion. groups: that of each unknown,
/// 0 and more. Equations that contain unknowns of one group only are eliminated first, group by group, where
/// that is accurate: from 100 unknowns on, as in a joint of many contacts most of which stick. Throws
/// std::invalid_argument for a negative group, and where J has not as many unknowns.
std::unique_ptr<LinearSolver> dense_lu_by_groups(const std::vector<int>& groups);

/// Sparse LU of the whole matrix by KLU. The ordering is reused, and the pivots as long as they are stable.
/// Sparse Jacobians.
std::unique_ptr<LinearSolver> klu();

/// Block elimination around a solver of J, with iterative refinement on the whole system (Govaerts and Pryce,
/// BIT 30, 1990), which tolerates a singular J: where `plain` fails, it works next to J, unless J is an
/// operator. For every kind of Jacobian that `plain` supports.
std::unique_ptr<LinearSolver> block_elimination(std::unique_ptr<PlainSolver> plain);

/// The default for the kind of Jacobian: dense LU or KLU. Throws std::invalid_argument for an Operator, which
/// requires a user-defined solver.
std::unique_ptr<LinearSolver> suitable_solver(const Jacobian& J);

/// Throws std::invalid_argument for an unsupported kind of Jacobian. kind: the supported one, "dense"
/// or "sparse".
[[noreturn]] void refuse_kind(const std::string& solver, const std::string& kind);

}  // namespace arcslip::continuation
