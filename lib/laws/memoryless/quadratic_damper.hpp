#pragma once
// The quadratic damper f = c |v| v, as of a body in a turbulent flow (Morison) or of an orifice.
//
// Exact: between reversals |v| is a trigonometric polynomial, and with the integrals G of |v| phi phi^T over
// the period (fourier/moments.hpp), the coefficients v = w D u of the velocity and kappa = 1/pi (mean row
// 1/(2 pi)),
//
//   F = kappa c G v,   dF/du = 2 kappa c w G D,   dF/dw = 2 F/w
//
// for f_v = 2 c |v|. The motion of the reversals does not enter, since v = 0 there.
//
// Fields: coefficient c (N s^2/m^2), at least 0.

#include <arcslip/laws/law_type.hpp>

namespace arcslip::elements {

/// "quadratic_damper".
const PlainLaw& quadratic_damper();

}  // namespace arcslip::elements
