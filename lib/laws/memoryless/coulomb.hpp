#pragma once
// Rigid Coulomb friction: f = mu N sgn(v), and |f| <= mu N at rest.
//
// In harmonics it is the friction of motions that reverse without a stop. With the reversals r of q(theta),
//
//   F = kappa mu N * integral of sgn(q') phi,   dF/du = kappa 2 mu N sum_r phi(r) phi'(r)^T / |q''(r)|
//
// kappa = 1/pi (mean row 1/(2 pi)), or 2/pi over half a period for antisymmetric motion. Both are exact for
// the harmonics kept. Since f jumps at reversals, those left out move them by 1/N: responses of order N have
// an error of order N^-1 (docs/theory/13-contacts.md).
//
// A motion stops at a reversal where friction can hold it there: set_valued(), Element::jump_over_bend().
// Harmonic balance then has further reversals during the stop instead, and converges slowly. A pair of
// reversals begins with q'' = 0, thus within a stop: no corners are known.
//
// Fields: friction_coefficient mu, normal_load N (N).

#include <arcslip/laws/law_type.hpp>

namespace arcslip::elements {

/// "coulomb".
const PlainLaw& coulomb();

}  // namespace arcslip::elements
