#pragma once
// The user's problem F(u, p) = 0: n equations, n unknowns u, and a vector p of named parameters.

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <variant>

namespace arcslip::continuation {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using SparseMatrix = Eigen::SparseMatrix<double>;
using In = Eigen::Ref<const Vector>;
using Out = Eigen::Ref<Vector>;

/// A Jacobian that is only applied, never seen. Its linear solver is the user's (linear_solver.hpp).
class Operator {
 public:
  virtual ~Operator() = default;
  virtual void apply(In x, Out y) const = 0;  // y = J x
  /// y = J^T x. False: there is no transpose.
  virtual bool apply_transposed(In x, Out y) const {
    static_cast<void>(x), static_cast<void>(y);
    return false;
  }
};

using Jacobian = std::variant<Matrix, SparseMatrix, const Operator*>;

/// What became of an evaluation: `outside_domain` makes the step shorter, `failed` too, and is told apart in
/// the stop.
enum class Evaluated { ok, outside_domain, failed };

/// y = J x, for every kind.
void apply(const Jacobian& J, In x, Out y);
/// y = J^T x. False: an operator without transpose.
bool apply_transposed(const Jacobian& J, In x, Out y);

/// What an evaluation is to prepare. `jacobian` includes the residual.
enum class Needs { residual, jacobian };

/// A named scalar of the problem.
struct Parameter {
  std::string name, unit;
  double value = 0;  // default
  double scale = 0;  // a change that counts as large, > 0; 0: the width of the window it is traced in
  double lower = -1e300, upper = 1e300;

  /// A change that counts as large where there is no window: 1, if no scale is given.
  double change() const { return scale > 0 ? scale : 1; }
};

/// Evaluates F at one place at a time. Mutable, one for each thread, owns every buffer: nothing that it does
/// after its making allocates memory.
class Evaluator {
 public:
  virtual ~Evaluator() = default;

  /// Moves to (u, p) in one pass: F, and J = dF/du where it is needed. u: n, p: as many as parameters().
  virtual Evaluated move_to(In u, In p, Needs needs) = 0;

  virtual const Vector& residual() const = 0;  // F, n

  /// J, n x n, as of the last move with Needs::jacobian. Its kind, size and pattern never change.
  virtual const Jacobian& jacobian() const = 0;

  /// dF/dp_k at the place of the last move, n.
  virtual void parameter_derivative(int k, Out dF) const = 0;

  /// Second derivatives of F, at the place of the last move: du = dg/du (n) and dp = dg/dp (all parameters)
  /// of g(u, p) = w . (J v + sum_k F_pk q_k). w, v: n, q: as many as parameters(). False: not given, and
  /// taken from differences of J and F_p within one smooth piece.
  virtual bool second_derivative(In w, In v, In q, Out du, Out dp) const {
    static_cast<void>(w), static_cast<void>(v), static_cast<void>(q);
    static_cast<void>(du), static_cast<void>(dp);
    return false;
  }

  /// Which smooth piece of a piecewise smooth F the last move came to; equal numbers mean the same piece.
  virtual std::uint64_t piece() const { return 0; }
};

class LinearSolver;  // linear_solver.hpp
using MakeLinearSolver = std::function<std::unique_ptr<LinearSolver>()>;

/// The problem itself. Immutable, shared by threads.
class Problem {
 public:
  virtual ~Problem() = default;
  virtual int size() const = 0;
  virtual std::span<const Parameter> parameters() const = 0;

  /// Typical magnitude of each unknown, > 0, n.
  virtual Vector scales() const = 0;

  /// Mv = M v, where M is the symmetric positive definite matrix of the inner product <a, b> = a . M b, in
  /// which distances on a branch are measured: 1 is a large one. False: the sum of a_i b_i / scale_i^2.
  virtual bool metric(In v, Out Mv) const {
    static_cast<void>(v), static_cast<void>(Mv);
    return false;
  }

  virtual std::unique_ptr<Evaluator> evaluator() const = 0;

  /// Whether evaluating F alone costs much less than factorizing J, so that chord steps pay.
  virtual bool cheap_residual() const { return true; }

  /// The solver that fits the problem best. Null: what suits the kind of its Jacobian.
  virtual std::unique_ptr<LinearSolver> linear_solver() const;
};

/// Throws std::invalid_argument unless there is one, and each has a name of its own.
void check_parameters(std::span<const Parameter> parameters);

/// Index of the parameter called `name`. Throws std::out_of_range naming what there is.
int parameter_index(const Problem& problem, const std::string& name);

/// Default values of all parameters.
Vector parameter_values(const Problem& problem);

}  // namespace arcslip::continuation
