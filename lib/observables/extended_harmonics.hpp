#pragma once
// The equations with more harmonics at a solution of order N, and their linearization.
//
// With u the harmonics kept, X the neglected ones (zero at the solution) and q the branch's free parameter,
//
//   [ J_uu J_uX F_u,q ] [ du ]     [ r_u ]
//   [ J_Xu J_XX F_X,q ] [ dX ]  = -[ r_X ]
//   [ b_u  b_X  b_q   ] [ dq ]     [ r_b ]
//
// is solved by block sweeps: dX with the diagonal blocks of J_XX, one for each harmonic, and
// (du, dq) with the factors of the bordered matrix of order N from the branch. Two sweeps; the ratio of their
// changes shows whether they converge.

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/hbm/problem.hpp>

#include <vector>

namespace arcslip::observables {

class WideEquations {
 public:
  /// Friction is exact in these equations, even if the problem samples it.
  WideEquations(const hbm::HbmProblem& problem, const elements::Harmonics& wide);

  /// Of the sweeps: b is zero in the kept unknowns of `row`, where there is none, and given by the solver.
  struct Border {
    continuation::Vector row;  // b_u, b_X in the layout of the wide unknowns; empty: that of the solver
    double parameter = 0;      // b_q
    double value = 0;          // r_b
  };
  struct Change {
    continuation::Vector u;  // du, dX in the layout of the wide unknowns
    double parameter = 0;    // dq
  };

  /// u: kept unknowns. False: the equations cannot be evaluated there.
  bool move_to(continuation::In u, continuation::In p);
  const hbm::HbmEvaluator& at() const { return *evaluator_; }
  const hbm::HbmProblem& problem() const { return problem_; }

  /// Prepares for solve(): the diagonal blocks at the last point. q: index of the free parameter.
  void factorize(int q);
  /// The bordered matrix of order N at the last place, with a border row in wide unknowns.
  bool factorize_kept(const Border& border, int q, continuation::LinearSolver& solver) const;

  /// Solves at the last point, with blocks computed there or nearby. Returns the size of the second sweep
  /// relative to the first.
  double solve(const continuation::LinearSolver& kept, const continuation::Vector& r, const Border& border,
               Change& change, double enough = 0);

  /// y = J du + F_q dq in all rows, at the last point.
  void apply(const Change& change, int q, continuation::Vector& y) const { apply(*evaluator_, change, q, y); }

  /// A point next to the last one, which stays that of all other calls. False: it cannot be evaluated, or is
  /// in another piece.
  bool look_nearby(continuation::In wide, continuation::In p);
  /// The motion at a point next to the last one, in any piece; null: it cannot be evaluated.
  const hbm::HbmEvaluator* look_at(continuation::In wide, continuation::In p);
  const continuation::Vector& residual_nearby() const { return nearby_->residual(); }
  void apply_nearby(const Change& change, int q, continuation::Vector& y) const {
    apply(*nearby_, change, q, y);
  }

  void embed(continuation::In u, continuation::Vector& wide) const;
  /// The kept part, which is set to zero in `wide`.
  void take_kept(continuation::Vector& wide, continuation::Out kept) const;

 private:
  static void apply(const hbm::HbmEvaluator& at, const Change& change, int q, continuation::Vector& y);

  const hbm::HbmProblem& narrow_;
  elements::Harmonics kept_, wide_;
  hbm::HbmProblem problem_;
  std::unique_ptr<hbm::HbmEvaluator> evaluator_, nearby_;
  std::vector<int> orders_;                    // neglected, n > N
  std::vector<continuation::LU<double>> lus_;  // of their blocks, 2 r x 2 r
  Eigen::MatrixXd block_;
  continuation::Vector u_, F_q_, rest_, sweep_, part_, kept_part_, harmonic_, harmonic_residual_;
};

}  // namespace arcslip::observables
