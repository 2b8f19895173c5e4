#pragma once
// A unilateral spring with a gap: f = k (q - g) for q > g, else 0.
//
// Exact: the angles where q(theta) = g are found, and with the integrals G of phi phi^T and l of phi over all
// contact phases (moments.hpp),
//
//   F = k A,   A = kappa (G u - g l),   dF/du = kappa k G,   dF/dk = A,   dF/dg = -kappa k l
//
// kappa = 1/pi (mean row 1/(2 pi)). The motion of the ends of contact does not enter, since f is continuous
// there. Where q just touches g, a contact phase of length s appears or vanishes: J is continuous and varies
// with s, the square root of the penetration.
//
// Fields: stiffness k (N/m), gap g (m), at least 0.

#include <arcslip/elements/law.hpp>

namespace arcslip::elements {

/// "gap_spring".
const PlainLaw& gap_spring();

}  // namespace arcslip::elements
