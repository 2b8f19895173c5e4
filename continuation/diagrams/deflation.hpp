#pragma once
// Further solutions of F(u, p) = 0 at fixed p by deflation: Newton's method with the known solutions removed
// (Farrell, Birkisson and Funke, SIAM J. Sci. Comput. 37, 2015).
//
//   const auto found = deflate(*problem, p, {u}, {u});  // solutions other than u, from guesses near u
//   for (const Vector& other : found) trace(problem, {.u = other, .p = p, .free = k}, ...);  // isolas too
//
// The zeros of the deflated residual F~ = m F, m = prod_i (1 / |u - u_i|^2 + 1) over the known solutions u_i,
// are the other solutions. Its Jacobian m J + F grad m^T is a rank-one update of m J along F. So its Newton
// step is that of F, s = -J^-1 F, scaled:
//
//   (m J + F grad m^T) s~ = -m F   =>   s~ = (1 + h . s~) s = s / (1 - h . s),   h = grad m / m,
//
// at the cost of one solve with J. Near a known solution s ~ u_i - u and h . s ~ 2: s~ ~ -s leads away from
// it, doubling the distance each time. Steps are limited, with varying limits so that they do not cycle, but
// |F~| need not decrease: it has poles at the known solutions and minima between them, which the iteration
// has to cross.
//
// Finding no further solution does not prove that there is none.

#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/control/run_control.hpp>

#include <vector>

namespace arcslip::continuation {

struct DeflationOptions {
  double tolerance = 1e-9;           // of the last correction s, relative to 1 + |u|, in scales
  double rounding_level = 1e-7;      // a correction that stagnates below this is accepted; >= tolerance
  int iterations = 100;              // for each attempt
  double largest_step = 2;           // |s~|, relative to 1 + |u|, in scales
  double apart = 1e-5;               // least distance of distinct solutions, relative to 1 + |u|, in scales
  int solutions = 100;               // maximum number found
  MakeLinearSolver linear_solver{};  // none: the problem's own, or the default for its Jacobian
  control::Control control{};  // asked at each iteration; its end is that of the search, with what was found
};

/// known: solutions, to rounding; guesses: initial guesses, each n. Repeats from each guess until it yields
/// no new solution; a guess that is a known solution is left in both senses of a generic direction. An
/// attempt ends if the problem cannot be evaluated or linearized. p: all parameters. Returns the new
/// solutions, in the order found. Throws std::invalid_argument for wrong sizes or options.
std::vector<Vector> deflate(const Problem& problem, const Vector& p, const std::vector<Vector>& known,
                            const std::vector<Vector>& guesses, const DeflationOptions& options = {});

}  // namespace arcslip::continuation
