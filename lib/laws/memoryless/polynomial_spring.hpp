#pragma once
// A spring whose force is a polynomial, f = sum over n of c_n q^n with powers n from 1 to 9.
//
// Sampled with more than (g + 1) N points, g the highest power: coefficients and Jacobian are exact for the
// harmonics kept.
//
// Fields: c_n (N/m^n) for each power of the option "coefficients": {"2": 3.0, "3": 1.0} has c2 and c3.

#include <arcslip/laws/law_type.hpp>

#include <vector>

namespace arcslip::elements {

/// "polynomial_spring".
const LawType& polynomial_spring();

/// The options of an element with these powers, each from 1 to 9 and once. Throws std::invalid_argument.
scene::Settings polynomial_powers(std::vector<int> powers);

}  // namespace arcslip::elements
