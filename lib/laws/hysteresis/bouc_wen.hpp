#pragma once
// The hysteresis of Bouc and Wen, with a yield displacement:
//
//   f = a k q + (1 - a) k z,   z' = q' (1 - |z/z_y|^n (s sgn(q' z) + 1 - s))
//
// so that |z| <= z_y. The first loading has the stiffness k at q = 0 and a k far beyond z_y. s = 1/2 unloads
// with the stiffness k; as n grows, the law becomes a spring a k next to a friction damper of stiffness
// (1 - a) k and slip limit (1 - a) k z_y. In the common form z' = A q' - beta |q'| |z|^(n-1) z - gamma q'
// |z|^n: A = 1, beta = s/z_y^n, gamma = (1 - s)/z_y^n. k (a q^2 + (1 - a) z^2)/2 is stored, and the rest of
// the work dissipated, which is never negative for s >= 1/2.
//
// In harmonic balance z is an unknown of the element's own. Its equation knows no rate:
// dz/dtheta - dq/dtheta (1 - ...) = 0, m, sampled in time. Its second derivative has jumps, so that the
// harmonics of z fall as m^-3, and the error of the samples with the square of their distance: of N harmonics
// 2 min(N, 32) N + 128 samples are taken, or more where the scene samples friction with more. The truncation
// estimate includes this error, since it looks at the equations with more harmonics and samples. A motion of
// no size leaves the mean of z open: 1e-12 of it in its own equation holds it at 0 there.
//
// In time: the implicit midpoint rule in q, in steps of at most z_y/n. Multipliers: as a Hysteresis.
//
// Fields: stiffness k (N/m), elastic_share a, yield_displacement z_y (m), exponent n, shape s.
// Sources: Bouc 1967; Wen 1976; Ismail, Ikhouane & Rodellar 2009.

#include <arcslip/laws/law_type.hpp>

namespace arcslip::elements {

/// "bouc_wen".
const PlainLaw& bouc_wen();

}  // namespace arcslip::elements
