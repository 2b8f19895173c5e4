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
#include <vector>

namespace arcslip::continuation {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using SparseMatrix = Eigen::SparseMatrix<double>;
using In = Eigen::Ref<const Vector>;
using Out = Eigen::Ref<Vector>;

/// A matrix-free Jacobian. Requires a user-defined linear solver (linear_solver.hpp).
class Operator {
 public:
  virtual ~Operator() = default;
  virtual void apply(In x, Out y) const = 0;  // y = J x
  /// y = J^T x. False: not available.
  virtual bool apply_transposed(In x, Out y) const {
    static_cast<void>(x), static_cast<void>(y);
    return false;
  }
};

using Jacobian = std::variant<Matrix, SparseMatrix, const Operator*>;

/// Result of an evaluation. outside_domain and failed both shorten the step; the stop message
/// distinguishes them.
enum class Evaluated { ok, outside_domain, failed };

/// y = J x, for every kind of Jacobian.
void apply(const Jacobian& J, In x, Out y);
/// y = J^T x. False: operator without transpose.
bool apply_transposed(const Jacobian& J, In x, Out y);

/// What an evaluation computes. `jacobian` includes the residual.
enum class Needs { residual, jacobian };

/// What a test of a piece asks: all of F, or only the part that left the piece last, where F has parts: then
/// `inside` may be wrong, `outside` is not.
enum class PieceTest { whole, part };

/// A named scalar of the problem.
struct Parameter {
  std::string name, unit;
  double value = 0;  // default
  double scale = 0;  // a large change, > 0; 0: the width of the window of the trace
  double lower = -1e300, upper = 1e300;

  /// The scale where there is no window: 1 if none is given.
  double change() const { return scale > 0 ? scale : 1; }
};

/// Which derivatives are differences of F, for want of a function of the user's. Their errors are nobody's
/// mistake, and what needs more digits takes better differences.
struct ByDifferences {
  bool jacobian = false, parameters = false;
};

/// Evaluates F at one point at a time. Mutable, one for each thread. It should own all its buffers, so
/// that evaluations do not allocate.
class Evaluator {
 public:
  virtual ~Evaluator() = default;

  /// Evaluates at (u, p): F, and if needed J = dF/du. u: n, p: as many as parameters().
  virtual Evaluated move_to(In u, In p, Needs needs) = 0;

  virtual const Vector& residual() const = 0;  // F, n

  /// J, n x n, of the last move with Needs::jacobian. Its kind, size and pattern never change.
  virtual const Jacobian& jacobian() const = 0;

  /// dF/dp_k at the last point, n.
  virtual void parameter_derivative(int k, Out dF) const = 0;

  /// Second derivatives of F at the last point: du = dg/du (n) and dp = dg/dp (all parameters) of
  /// g(u, p) = w . (J v + sum_k F_pk q_k). w, v: n, q: as many as parameters(). False: not provided;
  /// differences of J and F_p within one smooth piece are used instead.
  virtual bool second_derivative(In w, In v, In q, Out du, Out dp) const {
    static_cast<void>(w), static_cast<void>(v), static_cast<void>(q);
    static_cast<void>(du), static_cast<void>(dp);
    return false;
  }

  /// The derivative of F of this order, 2 or 3, along a line through the last point,
  ///
  ///   d = d^order / ds^order F(u + s v, p + s q) at s = 0,
  ///
  /// as of a Taylor series of F, for the coefficients of normal forms. v: n, q: as many as parameters().
  /// False: not provided; differences of J, or of F, within one smooth piece are used instead.
  virtual bool directional_derivative(int order, In v, In q, Out d) const {
    static_cast<void>(order), static_cast<void>(v), static_cast<void>(q), static_cast<void>(d);
    return false;
  }

  virtual ByDifferences by_differences() const { return {}; }

  /// The smooth piece of a piecewise smooth F at the last point; equal numbers mean the same piece.
  virtual std::uint64_t piece() const { return 0; }

  /// Of a problem with a state (Problem::initial_state()): F is from now on that after the last accepted
  /// point, which left this state. Every evaluation in between is a trial, and leaves the state as it is.
  virtual void set_state(In state) { static_cast<void>(state); }

  /// The state that the last point leaves if it is accepted, from the one that was set. Until the next
  /// set_state() F goes by that one.
  virtual void next_state(Out state) const { static_cast<void>(state); }

  /// Whether (u, p) is in this piece, which may cost less than F: many such tests locate a kink. Until the
  /// next move_to() there is no last point.
  virtual Evaluated test_piece(In u, In p, std::uint64_t piece, PieceTest test, bool& inside);
};

class LinearSolver;  // linear_solver.hpp
using MakeLinearSolver = std::function<std::unique_ptr<LinearSolver>()>;

/// A place of a problem, and the parameters that change along a branch through it.
struct PlaceOfProblem {
  Vector u, p;
  std::vector<int> changing;
};

/// The problem. Immutable, may be shared by threads.
class Problem {
 public:
  virtual ~Problem() = default;
  virtual int size() const = 0;
  virtual std::span<const Parameter> parameters() const = 0;

  /// Typical magnitude of each unknown, > 0, n.
  virtual Vector scales() const = 0;

  /// Mv = M v with the symmetric positive definite matrix M of the inner product <a, b> = a . M b that
  /// measures distances along a branch; a distance of 1 is large. False: the default, the sum of a_i b_i
  /// / scale_i^2.
  virtual bool metric(In v, Out Mv) const {
    static_cast<void>(v), static_cast<void>(Mv);
    return false;
  }

  /// In the initial state, if there is one.
  virtual std::unique_ptr<Evaluator> evaluator() const = 0;

  /// What F depends on besides (u, p), as many numbers as it takes: the damage, plastic strains and slips
  /// that the points before have left, or a reference that follows the branch. Here those before the first
  /// point. A trace keeps them: they change when a point is accepted, and by nothing else. At a point that
  /// was just accepted, J and dF/dp are those of going on in its direction, as of loading. Empty, the
  /// default: none.
  virtual Vector initial_state() const { return {}; }

  /// Whether evaluating F alone costs much less than factorizing J.
  virtual bool cheap_residual() const { return true; }

  /// Whether chord steps pay: not where J comes with F at little more than the cost of F.
  virtual bool chord_pays() const { return cheap_residual(); }

  /// Whether F is smooth wherever it is defined, so that Evaluator::piece() never changes: then corrections
  /// are not tested for kinks, and points are accepted by the error that is expected to remain.
  virtual bool smooth() const { return false; }

  /// A problem made of another one, whose derivatives are what its own are made of: the other one, with the
  /// place that belongs to a place of this one. Null: none.
  virtual const Problem* made_of(PlaceOfProblem& place) const {
    static_cast<void>(place);
    return nullptr;
  }

  /// Whether p_k is among the unknowns, so that it cannot be free.
  virtual bool is_unknown(int k) const {
    static_cast<void>(k);
    return false;
  }

  /// The same problem with this scale of parameter k, as of its window, which its own differences go by.
  /// Null, the default: it makes none.
  virtual std::shared_ptr<const Problem> with_scale(int k, double scale) const;

  /// The preferred linear solver. Null: the default for the kind of its Jacobian.
  virtual std::unique_ptr<LinearSolver> linear_solver() const;
};

/// Scales for a problem whose unknowns differ by decades, from a few of its solutions, such as the first
/// points of a trace with scales of 1: the largest magnitude of each unknown in them. One that is at most
/// `negligible` in all, as with rounding errors alone, gets the geometric mean of the others. Throws
/// std::invalid_argument for no solutions, or solutions of different sizes or that are not finite.
Vector proposed_scales(std::span<const Vector> solutions, double negligible = 1e-14);

/// Throws std::invalid_argument unless there is at least one parameter and names are unique.
void check_parameters(std::span<const Parameter> parameters);

/// Index of the parameter named `name`. Throws std::out_of_range, listing the parameters.
int parameter_index(const Problem& problem, const std::string& name);

/// Default values of all parameters.
Vector parameter_values(const Problem& problem);

}  // namespace arcslip::continuation
