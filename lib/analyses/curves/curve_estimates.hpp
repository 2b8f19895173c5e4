#pragma once
// What the harmonics left out do to the events of a curve of special points (docs/theory/07-observables.md).
//
// Each point of the curve has the change of its frequency and amplitude at its value of the parameter p,
// d omega and dA (observables/truncation.hpp). Along the curve, with its arclength s and y' = dy/ds:
//
//   an extremum of y = A or omega   y + dy has one at ds = -(dy)'/y'': dp = p' ds, d omega + omega' ds,
//                                   dA + A' ds
//   a turn in p                     dp = -d omega p'/omega' and dA - A' d omega/omega' at the same frequency,
//                                   which are regular; d omega = -omega' (dp)'/p''
//   a cusp of a curve of folds      omega = q + e (p - p_c) on the curve, q = c s^3, p - p_c = a s^2:
//                                   dp = -2 a (d omega)'/(3 c), d omega + e dp; dA has a pole,
//                                   r/s + dA_0; with A = b_1 s + b_2 s^2, p - p_c = a s^2 + a_3 s^3:
//                                   dA_0 + (b_2 - 3/4 b_1 a_3/a) dp/a
//
// Derivatives are those of polynomials through the event and two points on each side.

#include <arcslip/analyses/curves/special_curve.hpp>
#include <arcslip/results/response.hpp>

namespace arcslip::observables {

/// Sets the estimates of an event of the curve at this arclength, where they are known: parameter_estimate,
/// location_estimate, those of the amplitude and of the shares of stick.
void estimate_change(const SpecialCurve& curve, double arclength, ResponseEvent& event);

}  // namespace arcslip::observables
