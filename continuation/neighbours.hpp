#pragma once
// Derivatives of J and F_p by differences, within one smooth piece of F.
//
// Central where both sides of x lie in the piece of x, as far as F can be evaluated there:
//
//   f'(0) = (f(h) - f(-h)) / 2h + O(h^2),
//
// and else one-sided of the same order, f'(0) = +-(4 f(+-h) - f(+-2h) - 3 f(0)) / 2h, on the side that does.
// Where neither does, h is shortened.

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
  constexpr double shorter = 0.1;
  constexpr int attempts = 5;
  for (int k = 0; k < attempts; ++k, h *= shorter) {
    const bool ahead = go(0, h), behind = go(1, -h);
    if (ahead && behind) return DifferenceQuotient{{h, -h}, {0.5 / h, -0.5 / h}, 0};
    if (ahead && go(1, 2 * h)) return DifferenceQuotient{{h, 2 * h}, {2 / h, -0.5 / h}, -1.5 / h};
    if (behind && go(0, -2 * h)) return DifferenceQuotient{{-2 * h, -h}, {0.5 / h, -2 / h}, 1.5 / h};
  }
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
