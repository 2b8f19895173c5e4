#pragma once
// A problem with constraints, and as many of its parameters among the unknowns:
//
//   F(u, p) = 0              n equations
//   g_k(u, p) = c_k          m constraints
//
// in the unknowns (u, q), where q are m parameters that are freed by name. Each level c_k is a parameter,
// after those of the problem: it may be held, be the free one of a trace, or be among q, and is then an
// outcome.
//
//   // Two bars that share a length, under forces that keep it:
//   // the force f and the shift s follow from the level.
//   const auto length = weighted_sum({"length", "m", 2}, Vector::Ones(2));
//   const auto held = with_constraints(bars, {length, energy}, {"f", "s"});
//
// Conserved sums w . (u - u_0) = c, integrals with the weights of a quadrature, and phase conditions
// u_ref' . (u - u_ref) = 0 are weighted sums. A phase condition takes the place of a symmetry, and a
// conserved sum that of equations that depend on each other, if F has a parameter for it: the speed or the
// multiplier that is 0 or constant along the branch. (For sums without such a parameter see
// conserved_sums.hpp.)
//
// The systems with J are solved by the problem's own solver, as borders of J: dense, sparse or iterative.

#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace arcslip::continuation {

/// g(u, p) = c.
struct Constraint {
  Parameter level;                                           // c
  std::function<double(In u, In p)> value;                   // p: the parameters of the problem
  std::function<void(In u, In p, Out gradient)> gradient{};  // dg/du, n. None: differences, 2 n values
  std::function<double(In u, In p, int k)> derivative{};     // dg/dp_k. None: differences, 2 values
};

/// w . (u - reference) = c. No reference: w . u = c.
Constraint weighted_sum(Parameter level, Vector weights, Vector reference = {});

/// The problem in the unknowns (u, q), q in the order of `freed`, with the parameters of the problem and then
/// the levels. Those that are freed are unknowns, and what p says of them is ignored. make_solver: for
/// systems with bordered J; if none, the problem's own, or the default for its Jacobian. Differences of g are
/// central ones of steps 6e-6 max(|x|, scale), one-sided at the end of its domain. Bounds of freed parameters
/// do not end a branch. Throws std::invalid_argument if there are not as many
/// parameters as constraints, one of them twice, or constraints without a value or with names that there are,
/// std::out_of_range for an unknown name.
std::shared_ptr<const Problem> with_constraints(std::shared_ptr<const Problem> problem,
                                                std::vector<Constraint> constraints,
                                                const std::vector<std::string>& freed,
                                                MakeLinearSolver make_solver = {});

}  // namespace arcslip::continuation
