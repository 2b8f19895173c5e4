#pragma once
// Curves of branch points in two parameters, and the extended system that locates a branch point.
//
// Along a branch in the parameter `along`, written a below, with x = (u, p_a), the matrix A = [J F_pa]
// (n x (n+1)) has rank n - 1 where two branches cross. With a column b (n) and rows C^T (2 x (n+1)),
//
//   M = [ A    b ]      M [ V   ] = [ 0   ]      M^T [ w ] = [ 0 ] (n+1)
//       [ C^T  0 ],       [ g^T ]   [ I_2 ],         [ g ]   [ 1 ]
//
// is regular there, and g = (g_1, g_2) = 0 if and only if V spans the null space of A; then w A = 0. Together
// with F = 0 this is one condition too many for a single parameter: an imperfection destroys a branch point.
// With an unfolding parameter beta and a fixed direction b_0,
//
//   F(u, p) + beta b_0 = 0,   g_1 = g_2 = 0
//
// are n + 2 equations in (u, p_a, beta), regular at transversal crossings (Griewank and Reddien, SIAM J.
// Numer. Anal. 21, 1984; Govaerts 2000, chapters 3 and 5). Two branches of F = 0 cross if beta = 0; a
// symmetry of F keeps beta at 0. The gradients are
//
//   dg_j = -w . dA V_j,
//
// with the second derivatives of F from differences along V_j, as they are symmetric. One factorization of M
// and one transposed solve suffice: the linear systems are solved by block elimination with M, which is
// solved like the system of the branch itself, with borders of width 2. For a linear solver without
// transposed solves, directional derivatives of g are used, at two forward solves each.

#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <memory>

namespace arcslip::continuation {

/// The branch points of branches in the parameter `along`, as a problem in the unknowns (u, p_along, beta)
/// with the same parameters; p[along] is ignored. unfolding: b_0, n, not orthogonal to w, scaled so that
/// beta = 1 is large: see BranchPointLocation. make_solver: for the bordered systems with M; if none, the
/// problem's own, or the default for its Jacobian. Throws std::out_of_range for an invalid index,
/// std::invalid_argument if b_0 does not have n entries.
std::shared_ptr<const Problem> branch_points(std::shared_ptr<const Problem> problem, int along,
                                             Vector unfolding, MakeLinearSolver make_solver = {});

/// The null vectors of A, approximate near a branch point.
struct NullSpace {
  Matrix right;       // V, (n+1) x 2, nearly orthonormal in scales
  Vector left;        // w, n; empty if the linear solver has no transposed solves
  Vector complement;  // b, n: w . b = 1, |b| = 1
  Matrix form;        // w . F_xx V_i V_j, 2 x 2, symmetric. Not finite if F cannot be evaluated near x.
};

/// The null space at the last Jacobian evaluation of an evaluator of branch_points(). Throws
/// std::invalid_argument for other evaluators.
NullSpace null_space(const Evaluator& at);

}  // namespace arcslip::continuation
