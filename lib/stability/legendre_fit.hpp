#pragma once
// Polynomials on [0, 1] through values at the nodes of Gauss and Legendre. Private.
//
//   p(s) = sum_l b_l P_l(2s - 1),   b = by_values * values
//
// What p leaves out is orthogonal to the polynomials of a lower degree than the number of nodes, up to an
// error of twice that order; the size of the last b says what it is.

#include <arcslip/time/equation/equation_of_motion.hpp>

namespace arcslip::time {

struct LegendreFit {
  /// count: of nodes, at most 20: beyond, powers lose their digits.
  explicit LegendreFit(int count);

  int count;
  Vector nodes;
  Matrix by_values;  // row l: b_l by the values at the nodes
  Matrix powers;     // row l: the coefficients of s^j of P_l(2s - 1)
  Matrix integral;   // row i: the integral from 0 to node i by the values at the nodes
};

}  // namespace arcslip::time
