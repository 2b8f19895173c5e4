#pragma once
// What the problems of special points have in common: each holds another one, whose parameter p_a is among
// its unknowns. With x = (u, p_a), n + 1, the matrix A(x, p) = [J F_pa] is n x (n + 1), and their systems are
// solved by a few solves with J and borders.

#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <functional>
#include <memory>

namespace arcslip::continuation {

/// Throws std::invalid_argument for none.
std::shared_ptr<const Problem> given(std::shared_ptr<const Problem> problem);

/// Whether p_k is among the unknowns: it cannot be free as well.
bool is_unknown(const Problem& problem, int k);

/// The problem inside, the index of p_a, and how bordered systems with its J are solved.
struct InnerProblem {
  /// Throws std::out_of_range for an index without parameter.
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

  /// x: n + 1; p: all parameters, of which p[along] is not looked at.
  Evaluated move_to(In x, In p);

  Evaluator& at() const { return *evaluator_; }
  In u() const { return x_.head(F_pa_.size()); }
  const Vector& x() const { return x_; }
  const Vector& p() const { return p_; }  // p[along] is that of x
  const Vector& F_pa() const { return F_pa_; }

  void apply(In d, Out y) const;             // y = A d
  bool apply_transposed(In w, Out y) const;  // y = A^T w. False: an operator without transpose

  /// The gradient of w . A d: by x (n + 1) and by all parameters. False: the problem does not give it.
  bool second_derivative(In w, In d, Out dx, Out dp);

 private:
  int along_;
  std::unique_ptr<Evaluator> evaluator_;
  Vector x_, p_, F_pa_, q_;
};

/// Factors of the bordered matrix at one place. As long as somebody else holds them, those of the next place
/// are other ones.
class SharedFactors {
 public:
  explicit SharedFactors(const InnerProblem& inner) : inner_(inner) {}
  bool factorize(const Jacobian& J, const Borders& borders);
  const std::shared_ptr<LinearSolver>& now() const { return now_; }

 private:
  const InnerProblem& inner_;
  std::shared_ptr<LinearSolver> now_, spare_;
};

/// A problem in the unknowns (x, further) and the parameters of the inner one. scales: of the further
/// unknowns. It outlives neither `inner` nor what the functions hold.
std::shared_ptr<const Problem> augmented(std::shared_ptr<const InnerProblem> inner, Vector scales,
                                         std::function<std::unique_ptr<Evaluator>()> evaluator,
                                         MakeLinearSolver linear_solver);

}  // namespace arcslip::continuation
