#pragma once
// The normal form of u' = F(u, p) at a Hopf point, on its centre manifold
//
//   u = u_0 + z q + z* q* + z^2 h20 / 2 + z z* h11 + z*^2 h20* / 2 + ...,   z' = i omega z + c z |z|^2 + ...
//
// With J q = i omega q, J^T w = -i omega w, <q, q> = <w, q> = 1 and the terms of each order compared,
//
//   h11 = -J^-1 B(q, q*),   h20 = (2 i omega - J)^-1 B(q, q)
//   c   = <w, C(q, q, q*) + 2 B(q, h11) + B(q*, h20)> / 2,   l1 = Re c / omega
//
// (Kuznetsov 2004, section 5.4; his l1 is the same). The pair's eigenvalue moves along the branch by
//
//   mu_p = <w, d(J q)/dp> = <w, D^2 F (q, 0) (u_p, 1)>,   J u_p = -F_p.

#include <arcslip/continuation/normal_forms/directional_derivatives.hpp>
#include <arcslip/continuation/problem/branch.hpp>

namespace arcslip::continuation {

/// DirectionalDerivatives::jacobian() of a place, with errors_of_jacobian().
struct KnownJacobian {
  Jacobian J;
  Matrix errors;
};

/// Adds the normal form to a Hopf point with its frequency and vectors. The evaluator is moved. Coefficients
/// stay unknown where F has no derivatives within its piece, J is an operator or singular, or the pair is not
/// apart from the others. J by differences is replaced by extrapolated ones. J: of
/// the place, if known. Not installed.
void add_normal_form(Evaluator& at, const PlaceOfForms& place, Hopf& hopf, const KnownJacobian* J = nullptr);

}  // namespace arcslip::continuation
