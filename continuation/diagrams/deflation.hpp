#pragma once
// Further solutions of F(u, p) = 0 at fixed p: Newton's method from a guess, with the solutions that are
// known taken out (Farrell, Birkisson and Funke, SIAM J. Sci. Comput. 37, 2015).
//
//   const auto found = deflate(*problem, p, {u}, {u});  // u is known; what else is there near it?
//   for (const Vector& other : found) trace(problem, {.u = other, .p = p, .free = k}, ...);  // isolas too
//
// Deflated is F~ = m F, m = prod_i (1 / |u - u_i|^2 + 1) over the known solutions u_i, whose zeros are the
// others. Its Jacobian m J + F grad m^T differs from m J by rank one, along F. So its Newton step is that of
// F, s = -J^-1 F, scaled:
//
//   (m J + F grad m^T) s~ = -m F   =>   s~ = (1 + h . s~) s = s / (1 - h . s),   h = grad m / m,
//
// at the price of one solve with J. Near a known solution s ~ u_i - u and h . s ~ 2: s~ ~ -s leads away from
// it, twice as far each time. Steps are limited, to changing lengths so that they do not cycle, but not made
// to lower |F~|: it has poles at the known solutions and minima between them, over which the way to the
// others leads.
//
// No method of this kind proves that there are no others: an empty answer says that none was found.

#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <functional>
#include <vector>

namespace arcslip::continuation {

struct DeflationOptions {
  double tolerance = 1e-9;           // of the last correction s, relative to 1 + |u|, in scales
  double rounding_level = 1e-7;      // a correction that stagnates below this is accepted; >= tolerance
  int iterations = 100;              // for each attempt
  double largest_step = 2;           // |s~|, relative to 1 + |u|, in scales
  double apart = 1e-5;               // distance of solutions that are two, relative to 1 + |u|, in scales
  int solutions = 100;               // found, at most
  MakeLinearSolver linear_solver{};  // none: the problem's own, or what suits its Jacobian
  std::function<bool()> go_on{};     // asked at each iteration; false ends it with what was found
};

/// known: solutions, to rounding; guesses: where to begin, each n. From each guess until it leads to nothing
/// new; a guess that is a known solution is left in both directions of one that is not special. Returns the
/// solutions that are not known, in the order found; where the problem cannot be evaluated or linearized,
/// that attempt ends. p: all parameters. Throws std::invalid_argument where sizes or options do not fit.
std::vector<Vector> deflate(const Problem& problem, const Vector& p, const std::vector<Vector>& known,
                            const std::vector<Vector>& guesses, const DeflationOptions& options = {});

}  // namespace arcslip::continuation
