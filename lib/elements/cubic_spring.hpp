#pragma once
// The cubic spring f = k_3 x^3 (N/m^3). Sampled with more than 4N + 1 points, which makes its coefficients
// and its Jacobian exact for the harmonics kept.
//
// Fields: stiffness k_3 (N/m^3).

#include <arcslip/elements/element.hpp>

namespace arcslip::elements {

std::unique_ptr<Element> make_cubic_spring(const Harmonics& harmonics);

}  // namespace arcslip::elements
