#pragma once
// The second Lyapunov coefficient of u' = F(u, p) at a generalized Hopf point. On the centre manifold
//
//   u = u_0 + H(z, z*),   H = sum a_jk z^j z*^k,   a_10 = q,   z' = i omega z + c1 z |z|^2 + c2 z |z|^4 + ...
//
// and F(u_0 + H) = H_z z' + H_z* z*'. With f_jk the coefficient of z^j z*^k in F(u_0 + H) of an H of the
// orders below j + k, J q = i omega q, J^T w = -i omega w and <q, q> = <w, q> = 1,
//
//   (i omega (j - k) - J) a_jk = f_jk - ((j - 1) c1 + (k - 1) c1*) a_(j-1)(k-1)
//   c1 = <w, f_21>,   c2 = <w, f_32>,   <w, a_21> = 0,   l2 = Re c2 / omega
//
// (Kuznetsov 2004, section 8.7, where c2 is one form of 15 terms over 12; Re c2 is the same where Re c1 = 0.)
// Each order m = j + k follows from the derivative of order m - 1 at r = 0 of
//
//   d/dr F(u_0 + H(r e^(i phi))) = J dH/dr,
//
// m! times the sum of f_jk e^(i (j-k) phi), at six angles of half a turn: the other half has (-1)^m times
// that.

#include <arcslip/continuation/linear/shifted_solver.hpp>
#include <arcslip/continuation/normal_forms/directional_derivatives.hpp>
#include <arcslip/continuation/problem/branch.hpp>

namespace arcslip::continuation {

/// pair: the eigenvalue i omega with its vectors. Not known where J consists of differences or is an
/// operator, or F has no derivatives within its piece. The evaluator is moved. Not installed.
Coefficient second_lyapunov(Evaluator& at, const PlaceOfForms& place, const Eigenpair& pair);

}  // namespace arcslip::continuation
