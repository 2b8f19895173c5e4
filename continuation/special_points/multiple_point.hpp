#pragma once
// Where more than two branches of F(u, p) = 0 cross: [J F_p] loses m ranks at once, as by a symmetry.
//
// With x = (u, p), A = [J F_p], columns W (n x m) and rows C^T ((m+1) x (n+1)),
//
//   M = [ A    W ]      M [ V ] = [ 0 ]      M^T [ w_i ] = [ 0   ]
//       [ C^T  0 ],       [ G ]   [ I ],         [ g_i ]   [ e_i ]
//
// is regular there, and G = 0 (m x (m+1)) says that V spans the null space of A. The solutions of F + W beta
// = 0 at x + V y + z, C^T z = 0, tell the reduced equation beta(y) = 0 (Lyapunov and Schmidt), whose
// solutions are those of F = 0 beside x. Its gradient is G, with dG_ij = -w_i . dA V_j: the point is where G
// vanishes, (m+1) m equations in m + 1 unknowns, which are solved in the least squares' sense. Around it
//
//   beta(r y) / r^2 = Q(y) + r K(y) + O(r^2),   |y| = 1,
//
// by quadratic and cubic forms, from values of beta. All its zeros on the sphere are sought, and corrected to
// zeros of beta itself: branches that leave x in the directions V y as r -> 0.

#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace arcslip::continuation {

constexpr int largest_rank_loss = 3;

struct MultiplePoint {
  Vector x;                      // (u, p), n + 1
  int rank_loss = 2;             // m
  std::vector<Vector> tangents;  // of all branches, n + 1, |t| = 1 in scales; one for each branch
};

/// guess: (u, p_along), n + 1; p: all parameters; rank_loss: m, 2 or 3; reach: how far from the guess the
/// point may lie, in scales. Nothing where there is no such point within reach, where its branches are not
/// told by forms of third order, or where the linear solver has no transposed solves.
std::optional<MultiplePoint> locate_multiple_point(const Problem& problem, const Vector& p, int along,
                                                   const Vector& guess, int rank_loss, double reach,
                                                   const MakeLinearSolver& make_solver = {});

}  // namespace arcslip::continuation
