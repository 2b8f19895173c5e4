#pragma once
// Pseudo-transient continuation (Kelley and Keyes, SIAM J. Numer. Anal. 35, 1998): F(u, p) = 0 as the
// equilibrium of u' = F, or of u' = -F, by steps of the implicit Euler method with one linearization each,
//
//   (I / h -+ J) du = +-F,
//
// whose length h grows as |F| falls (switched evolution relaxation): from a motion that follows the flow to
// Newton's method. It needs no direct way from the guess to the solution, and J may be singular on it.
// Equilibria that attract in one of the directions of time are reached from their basins; many others too,
// since long steps damp all motions. Not installed.

#include <arcslip/continuation/correction/corrector.hpp>

#include <memory>

namespace arcslip::continuation {

/// A motion from a guess. Not for Jacobians that are operators: step() is then false.
class PseudoTransient {
 public:
  /// with: its evaluator is used between the calls of step(), and it must outlive this. solver: none, the
  /// default. guess: (u, p), n + 1. direction: +1 for u' = F, -1 for u' = -F.
  PseudoTransient(const Problem& problem, Corrector& with, std::unique_ptr<LinearSolver> solver,
                  const Vector& guess, int direction);

  /// False: no step that the problem can be evaluated at, or the guess is a solution.
  bool step();

  const Vector& point() const { return v_; }     // (u, p)
  double residual() const { return residual_; }  // |F| there, in scales of u

 private:
  bool look();
  bool is_solution(const Vector& scales) const;
  bool solve();

  Corrector& with_;
  int direction_;
  std::unique_ptr<LinearSolver> solver_;
  Borders none_;
  Vector v_, trial_, change_, F_;
  Jacobian J_;
  double residual_ = 0, length_ = 0;
};

}  // namespace arcslip::continuation
