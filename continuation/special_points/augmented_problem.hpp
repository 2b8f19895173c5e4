#pragma once
// Common base of the problems of special points: each wraps an inner problem, with its parameter p_a as a
// further unknown. With x = (u, p_a), n + 1, the matrix A(x, p) = [J F_pa] is n x (n + 1), and the linear
// systems are solved by a few solves with bordered J.

#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <functional>
#include <memory>

namespace arcslip::continuation {

/// Throws std::invalid_argument for a null pointer.
std::shared_ptr<const Problem> given(std::shared_ptr<const Problem> problem);

/// The inner problem, the index of p_a, and the solver of bordered systems with J.
struct InnerProblem {
  /// Throws std::out_of_range for an invalid index.
  InnerProblem(std::shared_ptr<const Problem> problem, int along, MakeLinearSolver make_solver);

  const Parameter& parameter(int k) const { return problem->parameters()[static_cast<std::size_t>(k)]; }
  int size() const { return problem->size(); }
  Vector scales() const;  // of x, n + 1

  std::shared_ptr<const Problem> problem;
  int along;
  MakeLinearSolver make_solver;
};

/// The inner problem at one x, with its Jacobian.
class Site {
 public:
  explicit Site(const InnerProblem& inner);

  /// x: n + 1; p: all parameters; p[along] is ignored.
  Evaluated move_to(In x, In p);

  Evaluator& at() const { return *evaluator_; }
  In u() const { return x_.head(F_pa_.size()); }
  const Vector& x() const { return x_; }
  const Vector& p() const { return p_; }  // with p[along] from x
  const Vector& F_pa() const { return F_pa_; }

  void apply(In d, Out y) const;             // y = A d
  bool apply_transposed(In w, Out y) const;  // y = A^T w. False: operator without transpose

  /// The gradient of w . A d with respect to x (n + 1) and all parameters. False: not provided by
  /// the problem.
  bool second_derivative(In w, In d, Out dx, Out dp);

 private:
  int along_;
  std::unique_ptr<Evaluator> evaluator_;
  Vector x_, p_, F_pa_, q_;
};

/// Factors of the bordered matrix at one point. While shared, the next point gets new ones.
class SharedFactors {
 public:
  explicit SharedFactors(const InnerProblem& inner) : inner_(inner) {}
  bool factorize(const Jacobian& J, const Borders& borders);
  const std::shared_ptr<LinearSolver>& now() const { return now_; }

 private:
  const InnerProblem& inner_;
  std::shared_ptr<LinearSolver> now_, spare_;
};

/// The tangent t of a branch, B t = e_{n+1} with B = [A; c^T].
class BorderedTangent {
 public:
  /// c: a generic row until there is a tangent, orthogonal to it by no symmetry. scales: of x, n + 1.
  explicit BorderedTangent(Vector scales);

  /// False: B is singular.
  bool compute(SharedFactors& factors, const Jacobian& J, const Vector& F_pa);
  /// Makes this tangent the next row, the best choice for the conditioning of B.
  void take_border();
  const Vector& operator*() const { return t_; }

 private:
  Vector scales_, c_, t_;
  Borders border_;
};

/// A problem in the unknowns (x, further) with the parameters of the inner problem. scales: of the further
/// unknowns. `inner` and everything the functions refer to must outlive it.
std::shared_ptr<const Problem> augmented(std::shared_ptr<const InnerProblem> inner, Vector scales,
                                         std::function<std::unique_ptr<Evaluator>()> evaluator,
                                         MakeLinearSolver linear_solver);

}  // namespace arcslip::continuation
