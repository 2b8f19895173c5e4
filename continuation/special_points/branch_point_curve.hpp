#pragma once
// Curves of branch points in two parameters, and the equations that a branch point is located with.
//
// Along a branch in the parameter `along`, written a below, with x = (u, p_a), the matrix A = [J F_pa]
// (n x (n+1)) has rank n - 1 where two branches cross. With a column b (n) and rows C^T (2 x (n+1)),
//
//   M = [ A    b ]      M [ V   ] = [ 0   ]      M^T [ w ] = [ 0 ] (n+1)
//       [ C^T  0 ],       [ g^T ]   [ I_2 ],         [ g ]   [ 1 ]
//
// is regular there, and g = (g_1, g_2) = 0 says that V spans the null space of A and w A = 0. That F = 0
// holds as well is one condition too many in a single parameter: an imperfection breaks a branch point. With
// an unfolding parameter beta and a fixed direction b_0,
//
//   F(u, p) + beta b_0 = 0,   g_1 = g_2 = 0
//
// are n + 2 equations in (u, p_a, beta) that are regular where the branches cross transversally (Griewank and
// Reddien, SIAM J. Numer. Anal. 21, 1984; Govaerts 2000, chapters 3 and 5). Where beta = 0 two branches of F
// = 0 cross; a symmetry keeps it there. The gradients are
//
//   dg_j = -w . dA V_j,
//
// second derivatives of F, by differences along V_j because these are symmetric. One factorization of M and
// one transposed solve serve all: the linear systems are solved by block elimination in M, which is solved as
// the branch itself is, with borders of width 2. A linear solver without transposed solves is served by
// derivatives of g in the directions that are needed, two forward solves for each.

#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <memory>

namespace arcslip::continuation {

/// The branch points of branches in the parameter `along`, as a problem in the unknowns (u, p_along, beta)
/// and the same parameters; p[along] is not looked at. unfolding: b_0, n, not orthogonal to w, and so large
/// that beta = 1 is large: see BranchPointLocation. Throws std::out_of_range for an index without parameter,
/// std::invalid_argument where b_0 has not n entries. make_solver: of the bordered systems in M; if none, the
/// problem's own, or what suits.
std::shared_ptr<const Problem> branch_points(std::shared_ptr<const Problem> problem, int along,
                                             Vector unfolding, MakeLinearSolver make_solver = {});

/// A near a branch point, where its null space is told by V and w.
struct NullSpace {
  Matrix right;       // V, (n+1) x 2, near to orthonormal in scales
  Vector left;        // w, n; empty where the linear solver has no transposed solves
  Vector complement;  // b, n: w . b = 1, |b| = 1
  Matrix form;        // w . F_xx V_i V_j, 2 x 2, symmetric. Not finite where F cannot be evaluated beside x.
};

/// Where an evaluator of branch_points() last evaluated the Jacobian. Throws std::invalid_argument for
/// others.
NullSpace null_space(const Evaluator& at);

}  // namespace arcslip::continuation
