#pragma once
// Where two branches of F(u, p) = 0 cross: the point to rounding, and the tangents of both branches.
//
// The point solves the equations of branch_points() by Newton's method at fixed other parameters, from a
// guess that is known roughly: quadratically, where bisection along a branch loses half of the digits,
// because the matrices of the branch are singular there. The tangents are t = y_1 V_1 + y_2 V_2 with
//
//   alpha y_1^2 + 2 beta y_1 y_2 + gamma y_2^2 = 0,   [alpha beta; beta gamma]_ij = w . F_xx V_i V_j,
//
// the algebraic branching equation (Keller 1977): two directions where the form is indefinite.

#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/continuation/special_points/branch_point_curve.hpp>

#include <cmath>
#include <memory>
#include <optional>

namespace arcslip::continuation {

/// A solution of F + beta b_0 = 0, g = 0: a branch point, or where one was before an imperfection broke it.
struct BranchPointLocation {
  Vector x;              // (u, p_along), n + 1
  double imperfection;   // beta: two branches at a distance of about sqrt(2 |beta|) in scales do not cross
  double rounding;       // of beta: as measured, and not below that of a distance of 1e-7
  Vector unfolding;      // b_0, n: along w, |b_0| = |w . F_xx V_i V_j| (Frobenius) at the guess
  NullSpace null_space;  // at x
  bool branches_cross() const { return std::abs(imperfection) <= rounding; }

  /// The unknowns (u, p_along, beta) of branch_points(problem, along, unfolding), to start a curve from.
  Vector unknowns() const;
};

/// guess: (u, p_along), n + 1; p: all parameters. Nothing where Newton's method does not converge. What it
/// finds may lie away from the guess. make_solver as in branch_points().
std::optional<BranchPointLocation> locate_branch_point(std::shared_ptr<const Problem> problem,
                                                       const Vector& p, int along, const Vector& guess,
                                                       MakeLinearSolver make_solver = {},
                                                       const NewtonOptions& options = {});

/// The tangents of both branches, that nearest to `tangent` (n + 1) first and in its direction. Nothing where
/// the branches do not cross, or not at an angle: isolated points (a definite form) and points that are not
/// simple.
std::optional<BranchPoint> describe_branch_point(const Problem& problem, int along,
                                                 const BranchPointLocation& at, const Vector& tangent);

}  // namespace arcslip::continuation
