#pragma once
// A Jacobian next to one that its linear solver refuses, because it is singular to the last bit, or nearly.
//
// Each entry of the pattern is changed by a share of a size, with generic factors that are the same for (i,
// j) and (j, i), so that a symmetric J stays so. By the size of the entry itself the change does not depend
// on the units of equations and unknowns; it makes J regular where nonzero entries cancel. Where a row or a
// column is nearly zero the size has to be that of others: the largest entry of row or column, the smaller or
// the larger one. Not installed.

#include <arcslip/continuation/problem/problem.hpp>

#include <array>

namespace arcslip::continuation {

struct Nudge {
  enum class Size { of_entry, of_smaller, of_larger };
  double share;
  Size size;
};

/// In the order in which they are tried. Refinement with J itself gains a factor of `share` in each sweep,
/// and rounding costs one of epsilon / share. The last ones are for solvers that refuse what is near
/// singular.
inline constexpr std::array<Nudge, 5> nudges{{{1e-8, Nudge::Size::of_entry},
                                              {1e-8, Nudge::Size::of_smaller},
                                              {1e-8, Nudge::Size::of_larger},
                                              {1e-5, Nudge::Size::of_entry},
                                              {1e-5, Nudge::Size::of_larger}}};

/// nearby: of the kind and pattern of J. False: J is an operator, whose entries are not known.
bool nudged(const Jacobian& J, const Nudge& nudge, Jacobian& nearby);

}  // namespace arcslip::continuation
