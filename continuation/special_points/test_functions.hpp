#pragma once
// Curves of zeros of test functions in two parameters: of any scalar of a solution that is no more than a
// function, such as the multipliers of a periodic motion.
//
// Along branches in the parameter `along`, written a below, with x = (u, p_a), the points sought are those of
//
//   F(u, p) = 0           n equations
//   g(u, p, k) = 0        m functions of the solution and of m - 1 further unknowns k
//
// n + m equations in (u, p_a, k) and one more free parameter p_b, which trace() continues like any other
// problem. Mostly m = 1. Further unknowns tell apart what g belongs to, as one pair of eigenvalues of many.
//
// The solutions of F = 0 over (p_a, p_b) are a surface, so that Newton's method needs the derivatives of g in
// few directions only: with A = [J F_pa], a border row c, and B = [A; c^T] (stationary.hpp),
//
//   B t = e_{n+1},  B X = (F_pb, 0)    the tangents of the surface
//   B y = (f, 0)                       for a right-hand side f
//
// the linear system (dx, dk, dp_b) has the solution dx = y + zeta t - X dp_b, where
//
//   g_x t zeta + g_k dk + (g_pb - g_x X) dp_b = -g - g_x y
//   c_x t zeta + ...                          = 0               the row of the continuation
//
// Derivatives of g are central differences within one smooth piece of F (problem/difference.hpp): two values
// of g for each direction, one factorization of B. At a piece where g jumps a curve ends.

#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <functional>
#include <memory>

namespace arcslip::continuation {

/// g(u, p, k). It may keep buffers, for one evaluator. at: at (u, p), moved there with Needs::residual or
/// more; p: all parameters; g: m. False: not known there.
using TestFunction = std::function<bool(Evaluator& at, In u, In p, In k, Out g)>;

struct TestFunctions {
  std::function<TestFunction()> make;  // called once for each evaluator
  Vector scales{};                     // of the m - 1 further unknowns: a large change, > 0
};

/// The zeros of g along branches in the parameter `along`, as a problem in the unknowns (u, p_along, k) with
/// the same parameters; p[along] is ignored. make_solver: for the bordered systems with B; if none, the
/// problem's own, or the default for its Jacobian. Throws std::out_of_range for an invalid index,
/// std::invalid_argument for scales that are not positive.
std::shared_ptr<const Problem> test_function_zeros(std::shared_ptr<const Problem> problem, int along,
                                                   TestFunctions functions,
                                                   MakeLinearSolver make_solver = {});

}  // namespace arcslip::continuation
