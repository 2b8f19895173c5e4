#pragma once
// Springs that couple several displacements, as the gradient of a potential:
//
//   V = sum over terms t of V_t prod_i q_i^p_ti,   f_i = dV/dq_i
//
// with whole p_ti of sum 2 to 10. The directions are the names that occur, each a degree of freedom or a
// place in the element. A law of formulas (formula_law.hpp), the derivatives of V, which is stored:
// coefficients and Jacobian, which is symmetric, are exact for the harmonics kept.
//
// Fields: the value V_t (J/m^n, n the sum of its powers) of each term of the option "potential":
// [{"powers": {"a": 2, "b": 2}, "value": 0.5}] has v1.

#include <arcslip/laws/law_type.hpp>

namespace arcslip::elements {

/// "polynomial_coupling".
const LawType& polynomial_coupling();

}  // namespace arcslip::elements
