#pragma once
// Finite differences of J and F_p within one smooth piece of F (difference.hpp).

#include <arcslip/continuation/problem/difference.hpp>
#include <arcslip/continuation/special_points/augmented_problem.hpp>

#include <algorithm>
#include <array>
#include <optional>

namespace arcslip::continuation {

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
  template <class PlaceAt>
  bool take(const Site& here, double h, PlaceAt&& place);

  const InnerProblem& inner_;
  Vector scales_;
  std::array<Site, 2> places_;
  const Site* here_ = nullptr;
  DifferenceQuotient quotient_;
  Vector x_, p_, y_;
};

}  // namespace arcslip::continuation
