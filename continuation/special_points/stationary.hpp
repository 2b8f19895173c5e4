#pragma once
// Curves of special points in two parameters: folds, and stationary points of any quantity q(u, p) along
// branches, such as the peaks of a frequency response.
//
// Along a branch in the parameter `along`, written a below, with x = (u, p_a), A = [J F_pa] (n x (n+1)) and a
// border row c, the tangent t is given by
//
//   B t = e_{n+1},   B = [ A   ]
//                        [ c^T ],
//
// where B, the matrix of the branch itself, is regular at folds and peaks. There
//
//   G(x, p) = dq/dx . t = 0.
//
// F = 0, G = 0 are n + 1 equations in x and one more free parameter, which trace() continues like any other
// problem, with events, kinks and boundaries. With the left vector B^T z = dq/dx,
// z = (w, G), the gradient of G is (Govaerts 2000, chapter 3: minimally augmented systems)
//
//   dG = d(dq/dx) . t - w . dA t,
//
// with the second derivatives of F and q along t from the problem or from differences, as they are symmetric.
// So one factorization of B and one transposed solve suffice: the augmented system is solved by block
// elimination with B and never formed. For a linear solver without transposed solves, directional derivatives
// of G are used, at one forward solve each (the Newton steps of Moore and Spence's system).
//
// Folds are the case q = p_a, but B is singular where F_pa lies in the range of J: at a cusp of a problem
// with a symmetry, as at 0 of p_a u - u^3 + p_b, and where the curve turns in the other parameter. So theirs
// is the bordered J, with the null vectors of the point before as borders,
//
//   M (v, g) = e_{n+1},   M^T (w, g) = e_{n+1},   M = [ J   b ]
//                                                     [ c^T 0 ],
//
// which is regular wherever J has rank n - 1. g is zero at folds, with the null vectors J v = 0, w J = 0, and
// its gradient is -w . dJ v. With the sign of det M it does not depend on those of b and c. A cusp is a zero
// of w . F_uu v v, a Bogdanov-Takens point one of w . v.

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <functional>
#include <memory>

namespace arcslip::continuation {

/// A scalar function of the solution. The evaluator is at (u, p).
struct StationaryQuantity {
  std::function<void(Evaluator& at, In u, In p, Out dq_du)> gradient;            // n
  std::function<double(Evaluator& at, In u, In p, int k)> parameter_derivative;  // dq/dp_k
  /// The gradient of q_u . v + sum_k q_pk r_k with respect to u (n) and all parameters. None: by differences.
  std::function<void(Evaluator& at, In u, In p, In v, In r, Out du, Out dp)> second_derivative = {};
};

/// The stationary points of q along branches in the parameter `along`, as a problem in the unknowns (u,
/// p_along) with the same parameters; p[along] is ignored. make_solver: for the bordered systems with B; if
/// none, the problem's own, or the default for its Jacobian. Throws std::out_of_range for an invalid index.
std::shared_ptr<const Problem> stationary_points(std::shared_ptr<const Problem> problem, int along,
                                                 StationaryQuantity quantity,
                                                 MakeLinearSolver make_solver = {});

/// The folds of branches in the parameter `along`.
std::shared_ptr<const Problem> folds(std::shared_ptr<const Problem> problem, int along,
                                     MakeLinearSolver make_solver = {});

/// On a curve of folds, zero at cusps: w . F_uu v v of the null vectors, |v| = 1 in scales, |w| = 1, times
/// the share of v in the tangent of the curve, which is 1 at a cusp. It is 0, and no event, where that
/// share is small. On other curves of stationary points its value is the second derivative of q
/// along the branch. Not a number where the linear solver does not know the sign of the determinant and n >
/// 500.
Monitor cusp_monitor();
inline constexpr const char* cusp_event = "cusp";  // name of the monitor and its events

/// On a curve of folds of u' = F, zero at Bogdanov-Takens points: w . v of the null vectors J v = 0, w J = 0
/// of length 1, times the sign of det [J w; v^T 0], so that it goes with the product of the other eigenvalues
/// of J. In one unknown it is never zero. Requires transposed solves; without them its value is never zero.
/// Not a number where the linear solver does not know the sign of the determinant and n > 500.
Monitor bogdanov_takens_monitor();

/// The unknowns (u, p_along) of a point of a branch in p_along, the start of a curve.
Vector with_parameter(const Point& point);

}  // namespace arcslip::continuation
