#pragma once
// Derivatives of J and F_p by differences, within one smooth piece of F.
//
// Central, with h so short that both sides lie in the piece of x and F can be evaluated there,
//
//   f'(0) = (f(h) - f(-h)) / 2h + O(h^2),
//
// for beside the end of a piece derivatives may grow without bound, as where a contact begins. At the end
// itself, one-sided of the same order on the side that does: f'(0) = +-(4 f(+-h) - f(+-2h) - 3 f(0)) / 2h.

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

/// go(i, distance): evaluates place i there, and says whether it could and is in the piece of 0. The places
/// are then those of the quotient. Nothing where there is no room.
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

/// Places beside one of the inner problem, for derivatives of A and of what else depends on the place.
class Neighbours {
 public:
  explicit Neighbours(const InnerProblem& inner);

  /// Takes its places along d, n + 1, or along p_k; `here` has to stay where it is. False: there is no room.
  bool along(const Site& here, In d);
  bool over(const Site& here, int k);

  /// Calls f(place, weight) for each place: the derivative of g is the sum of weight * g(place).
  template <class F>
  void sum(F&& f) {
    if (quotient_.here != 0) f(*here_, quotient_.here);
    for (std::size_t i = 0; i < places_.size(); ++i) f(places_[i], quotient_.weight[i]);
  }

  void derivative(In d, Out y);              // y = dA d, n
  bool transposed_derivative(In w, Out dx);  // dx = dA^T w, n + 1. False: an operator without transpose
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
