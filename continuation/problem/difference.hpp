#pragma once
// Finite differences within one smooth piece of F.
//
// Central differences, with h so small that both sides lie in the piece of x and F can be evaluated there,
//
//   f'(0) = (f(h) - f(-h)) / 2h + O(h^2),
//
// since near the end of a piece derivatives may be unbounded, as at the onset of contact. At the end itself,
// one-sided differences of the same order: f'(0) = +-(4 f(+-h) - f(+-2h) - 3 f(0)) / 2h.

#include <array>
#include <optional>

namespace arcslip::continuation {

constexpr double difference_step = 6e-6;  // h of central differences, relative: the cube root of the rounding

/// f'(0) = here * f(0) + sum of weight[i] * f(distance[i]).
struct DifferenceQuotient {
  std::array<double, 2> distance, weight;
  double here = 0;

  bool central() const { return here == 0; }
};

/// What is tried first where one side of 0 lies outside. `shorter`: shorter steps to both sides, for
/// derivatives that may be unbounded towards the end. `one_sided`: the whole step to one side, for F itself,
/// which is smooth up to the end of its piece: shorter steps lose digits, of F in proportion to 1/h.
enum class AtEnd { shorter, one_sided };

constexpr double shorter_step = 1.0 / 16;  // of one step to the next, if one-sided ones come first
constexpr int shorter_steps = 6;           // at most: down to a millionth

/// The quotient by the first step, from h down, of which one side at least has room.
template <class Go>
std::optional<DifferenceQuotient> difference_to_any_side(double h, Go&& go) {
  for (int k = 0; k < shorter_steps; ++k, h *= shorter_step) {
    const bool above = go(0, h), below = go(1, -h);
    if (above && below) return DifferenceQuotient{{h, -h}, {0.5 / h, -0.5 / h}, 0};
    if (above && go(1, 2 * h)) return DifferenceQuotient{{h, 2 * h}, {2 / h, -0.5 / h}, -1.5 / h};
    if (below && go(0, -2 * h)) return DifferenceQuotient{{-2 * h, -h}, {0.5 / h, -2 / h}, 1.5 / h};
  }
  return {};
}

/// go(i, distance): evaluates point i there; true if that succeeds and the point is in the piece of 0.
/// Afterwards the points are those of the quotient. Nothing if the piece is too narrow.
template <class Go>
std::optional<DifferenceQuotient> difference_within_piece(double h, Go&& go, AtEnd at_end = AtEnd::shorter) {
  if (at_end == AtEnd::one_sided) return difference_to_any_side(h, go);
  for (const double share : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const double d = share * h;
    if (go(0, d) && go(1, -d)) return DifferenceQuotient{{d, -d}, {0.5 / d, -0.5 / d}, 0};
  }
  for (const double d : {1e-4 * h, -1e-4 * h})
    if (go(0, d) && go(1, 2 * d)) return DifferenceQuotient{{d, 2 * d}, {2 / d, -0.5 / d}, -1.5 / d};
  return {};
}

}  // namespace arcslip::continuation
