#pragma once
// A bilinear spring: stiffness k_1 up to a corner c, k_2 beyond,
//
//   f = k_1 q                          |q| <= c
//   f = sgn(q) (k_1 c + k_2 (|q| - c)) |q| > c
//
// With "one_sided": true only the corner at q = c is there, and f = k_1 q below it; with c = 0 it has k_1 on
// one side and k_2 on the other. Stiffnesses may be negative.
//
// Coefficients are exact (piecewise_linear.hpp). Fields: stiffness k_1, stiffness_beyond k_2 (N/m), corner c
// (m).

#include <arcslip/laws/law_type.hpp>

namespace arcslip::elements {

struct BilinearSpringOptions {
  bool one_sided = false;
  friend bool operator==(const BilinearSpringOptions&, const BilinearSpringOptions&) = default;
};

/// "bilinear_spring".
const LawType& bilinear_spring();

}  // namespace arcslip::elements
