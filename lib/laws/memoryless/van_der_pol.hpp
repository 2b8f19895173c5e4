#pragma once
// The damper of van der Pol, f = c (q^2/q_0^2 - 1) v: it feeds motions smaller than q_0 and damps larger
// ones.
//
// A cosine of amplitude A loses pi c w A^2 (A^2/(4 q_0^2) - 1) in a period: without other damping an
// oscillation grows to A = 2 q_0 (van der Pol 1926). What is dissipated is negative for smaller ones. Sampled
// with more than 4N + 1 points, which makes coefficients and Jacobian exact for the harmonics kept.
//
// Fields: coefficient c (N s/m), amplitude q_0 (m).

#include <arcslip/laws/law.hpp>

namespace arcslip::elements {

/// "van_der_pol".
const PlainLaw& van_der_pol();

}  // namespace arcslip::elements
