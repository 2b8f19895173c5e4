#pragma once
// A formula with kinks or jumps in the frequency domain, exact where its smooth pieces are:
//
//   F_n = kappa sum over pieces of the integral of f(q, v, phase) (cos n theta, sin n theta),
//   dF/du = kappa sum over pieces of the integral of (df/du) phi + sum over kinks theta_k of (f_- - f_+) phi
//   dtheta_k/du
//
// with the pieces between the kinks of the motion (kink_finder.hpp), each by Gauss and Legendre's rule of 12
// nodes on panels of a quarter wave of the highest harmonic, or less. Private.

#include <arcslip/laws/memoryless/formula_law.hpp>

#include <memory>

namespace arcslip::elements {

std::unique_ptr<Element> kinked_element(const FormulaLaw& law, const Harmonics& harmonics);

}  // namespace arcslip::elements
