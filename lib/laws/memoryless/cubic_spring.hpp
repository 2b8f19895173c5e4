#pragma once
// The cubic spring f = k_3 q^3 (N/m^3). Sampled with more than 4N + 1 points, which makes its coefficients
// and its Jacobian exact for the harmonics kept.
//
// Fields: stiffness k_3 (N/m^3).

#include <arcslip/laws/law.hpp>

namespace arcslip::elements {

/// "cubic_spring".
const PlainLaw& cubic_spring();

}  // namespace arcslip::elements
