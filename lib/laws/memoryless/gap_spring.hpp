#pragma once
// A spring behind a gap: f = k (q - g) for q > g, else 0. With "two_sided": true there is one on each side,
//
//   f = k max(q - g, 0) - k max(-q - g, 0),   antisymmetric
//
// A negative gap is a preload: the spring is compressed by -g at rest, where the structure is in equilibrium
// with it. What acts is the change of its force,
//
//   f = k max(q - g, 0) - k max(-g, 0),
//
// k q in contact, and k g where it is lost. Two preloaded springs balance each other: the stiffness is 2 k as
// long as both touch, |q| < -g, and k beyond.
//
// Coefficients are exact (piecewise_linear.hpp). Fields: stiffness k (N/m), gap g (m).

#include <arcslip/laws/law_type.hpp>

namespace arcslip::elements {

struct GapSpringOptions {
  bool two_sided = false;
  friend bool operator==(const GapSpringOptions&, const GapSpringOptions&) = default;
};

/// "gap_spring".
const LawType& gap_spring();

}  // namespace arcslip::elements
