#pragma once
// Finite differences of J and F_p within one smooth piece of F.
//
// Central differences, with h so small that both sides lie in the piece of x and F can be evaluated there,
//
//   f'(0) = (f(h) - f(-h)) / 2h + O(h^2),
//
// since near the end of a piece derivatives may be unbounded, as at the onset of contact. At the end itself,
// one-sided differences of the same order: f'(0) = +-(4 f(+-h) - f(+-2h) - 3 f(0)) / 2h.

#include <arcslip/continuation/inner_problem.hpp>

#include <algorithm>
#include <array>
#include <optional>

namespace arcslip::continuation {

constexpr double difference = 6e-6;  // h of central differences, relative: the cube root of the rounding

/// f'(0) = here * f(0) + sum of weight[i] * f(distance[i]).
struct DifferenceQuotient {
  std::array<double, 2> distance, weight;
  double here = 0;
};

/// go(i, distance): evaluates point i there; true if that succeeds and the point is in the piece of 0.
/// Afterwards the points are those of the quotient. Nothing if the piece is too narrow.
template <class Go>
std::optional<DifferenceQuotient> difference_within_piece(double h, Go&& go) {
  for (const double share : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const double d = share * h;
    if (go(0, d) && go(1, -d)) return DifferenceQuotient{{d, -d}, {0.5 / d, -0.5 / d}, 0};
  }
  for (const double d : {1e-4 * h, -1e-4 * h})
    if (go(0, d) && go(1, 2 * d)) return DifferenceQuotient{{d, 2 * d}, {2 / d, -0.5 / d}, -1.5 / d};
  return {};
}

/// Neighbouring points of a point of the inner problem, for derivatives of A and other functions of
/// the point.
class Neighbours {
 public:
  explicit Neighbours(const InnerProblem& inner);

  /// Chooses the points along d, n + 1, or along p_k; `here` must not move. False if the piece is too narrow.
  bool along(const Site& here, In d);
  bool over(const Site& here, int k);

  /// Calls f(point, weight) for each point: the derivative of g is the sum of weight * g(point).
  template <class F>
  void sum(F&& f) {
    if (quotient_.here != 0) f(*here_, quotient_.here);
    for (std::size_t i = 0; i < places_.size(); ++i) f(places_[i], quotient_.weight[i]);
  }

  void derivative(In d, Out y);              // y = dA d, n
  bool transposed_derivative(In w, Out dx);  // dx = dA^T w, n + 1. False: operator without transpose
  double parameter_derivative(In w, int k);  // w . dF_pk

 private:
  template <class Place>
  bool take(const Site& here, double h, Place&& place);

  const InnerProblem& inner_;
  Vector scales_;
  std::array<Site, 2> places_;
  const Site* here_ = nullptr;
  DifferenceQuotient quotient_;
  Vector x_, p_, y_;
};

}  // namespace arcslip::continuation
