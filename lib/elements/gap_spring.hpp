#pragma once
// A one-sided spring behind a gap: f = k (q - g) where q > g, else 0.
//
// Exact: for the given q(theta) the angles where q = g are found, and with G the integral of phi phi^T over
// all contact and l that of phi (moments.hpp),
//
//   F = k A,   A = kappa (G u - g l),   dF/du = kappa k G,   dF/dk = A,   dF/dg = -kappa k l
//
// kappa = 1/pi (mean row 1/(2 pi)). Moving ends of the contact do not enter, since f is continuous there.
// Where q just touches g, a contact of length s is born or closed: J is continuous and changes with s, the
// root of the depth.
//
// Fields: stiffness k (N/m), gap g (m), at least 0.

#include <arcslip/elements/law.hpp>

namespace arcslip::elements {

/// "gap_spring".
const PlainLaw& gap_spring();

}  // namespace arcslip::elements
