#pragma once
// Whether the solutions around one are a curve at all, or a surface, as where a symmetry turns each of them
// into a family (an orbit of rotations, of shifts in time) and no phase condition picks one.

#include <arcslip/continuation/linear_solver.hpp>
#include <arcslip/continuation/problem.hpp>

#include <string>

namespace arcslip::continuation {

/// A sentence where F = 0, to rounding, all around v = (u, p) in the plane of the two directions in which [J
/// F_p] is smallest: beta(y) of reduction.hpp with m = 1 is zero on a circle, where it is of the size of |y|
/// at a point of a regular branch and of |y|^2 at a branch point. Empty: nothing to say.
std::string doubt_of_isolation(const Problem& problem, const Vector& v, const Vector& p, int along,
                               const MakeLinearSolver& make_solver);

}  // namespace arcslip::continuation
