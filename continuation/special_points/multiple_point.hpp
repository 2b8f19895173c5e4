#pragma once
// Multiple branch points of F(u, p) = 0, where [J F_p] has rank loss m >= 2, for instance due to symmetry.
//
// With x = (u, p), A = [J F_p], columns W (n x m) and rows C^T ((m+1) x (n+1)),
//
//   M = [ A    W ]      M [ V ] = [ 0 ]      M^T [ w_i ] = [ 0   ]
//       [ C^T  0 ],       [ G ]   [ I ],         [ g_i ]   [ e_i ]
//
// is regular there, and G = 0 (m x (m+1)) if and only if V spans the null space of A. The solutions of
// F + W beta = 0 at x + V y + z, C^T z = 0, define the reduced equation beta(y) = 0 (Lyapunov-Schmidt
// reduction), whose solutions are those of F = 0 near x. Its gradient is G, with dG_ij = -w_i . dA V_j: the
// point is the zero of G, (m+1) m equations in m + 1 unknowns, solved by least squares. Around it
//
//   beta(r y) / r^2 = Q(y) + r K(y) + O(r^2),   |y| = 1,
//
// with quadratic and cubic forms fitted to values of beta. All zeros on the sphere are found, and corrected
// to zeros of beta itself: the branches leave x in the directions V y as r -> 0.

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

/// guess: (u, p_along), n + 1; p: all parameters; rank_loss: m, 2 or 3; reach: maximum distance of the point
/// from the guess, in scales. Returns nothing if there is no such point within reach, or if forms of third
/// order do not determine its branches.
std::optional<MultiplePoint> locate_multiple_point(const Problem& problem, const Vector& p, int along,
                                                   const Vector& guess, int rank_loss, double reach,
                                                   const MakeLinearSolver& make_solver = {});

}  // namespace arcslip::continuation
