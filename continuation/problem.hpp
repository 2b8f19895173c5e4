#pragma once
// The user's problem F(u, p) = 0: n equations, n unknowns u, and a vector p of named parameters.

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace arcslip::continuation {

using Vector = Eigen::VectorXd;
using Jacobian = Eigen::MatrixXd;
using In = Eigen::Ref<const Vector>;
using Out = Eigen::Ref<Vector>;

/// What became of an evaluation: `outside_domain` makes the step shorter, `failed` too, and is told apart in
/// the stop.
enum class Evaluated { ok, outside_domain, failed };

/// What an evaluation is to prepare. `jacobian` includes the residual.
enum class Needs { residual, jacobian };

/// A named scalar of the problem.
struct Parameter {
  std::string name, unit;
  double value = 0;  // default
  double scale = 1;  // a change that counts as large, > 0
  double lower = -1e300, upper = 1e300;
};

/// Evaluates F at one place at a time. Mutable, one for each thread, owns every buffer: nothing that it does
/// after its making allocates memory.
class Evaluator {
 public:
  virtual ~Evaluator() = default;

  /// Moves to (u, p) in one pass: F, and J = dF/du where it is needed. u: n, p: as many as parameters().
  virtual Evaluated move_to(In u, In p, Needs needs) = 0;

  virtual const Vector& residual() const = 0;    // F, n
  virtual const Jacobian& jacobian() const = 0;  // J, n x n; as of the last move with Needs::jacobian

  /// dF/dp_k at the place of the last move, n.
  virtual void parameter_derivative(int k, Out dF) const = 0;

  /// Which smooth piece of a piecewise smooth F the last move came to; equal numbers mean the same piece.
  virtual std::uint64_t piece() const { return 0; }
};

/// The problem itself. Immutable, shared by threads.
class Problem {
 public:
  virtual ~Problem() = default;
  virtual int size() const = 0;
  virtual std::span<const Parameter> parameters() const = 0;

  /// Typical magnitude of each unknown, > 0: distances on a branch are sums of (du_i / scale_i)^2.
  virtual Vector scales() const = 0;

  virtual std::unique_ptr<Evaluator> evaluator() const = 0;
};

/// Index of the parameter called `name`. Throws std::out_of_range naming what there is.
int parameter_index(const Problem& problem, const std::string& name);

/// Default values of all parameters.
Vector parameter_values(const Problem& problem);

}  // namespace arcslip::continuation
