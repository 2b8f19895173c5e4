#pragma once
// Normal forms of u' = F(u, p) at points of codimension 2, by the homological equations of Kuznetsov, SIAM J.
// Numer. Anal. 36, 1999: on the centre manifold u = u_0 + sum w_i q_i + sum h_jk w^j w*^k / (j! k!), with
//
//   zero-Hopf    h200 = -J^inv (B(q0,q0) - g200 q0)          g200 = <p0, B(q0,q0)>
//                h011 = -J^inv (B(q1,q1*) - g011 q0)         g011 = <p0, B(q1,q1*)>
//                h110 = (i w - J)^inv (B(q0,q1) - g110 q1)   g110 = <p1, B(q0,q1)>
//                h020 = (2 i w - J)^-1 B(q1,q1)
//                g300 = <p0, C(q0,q0,q0) + 3 B(q0,h200)>
//                g111 = <p0, C(q0,q1,q1*) + B(q0,h011) + B(q1,h110*) + B(q1*,h110)>
//                g210 = <p1, C(q0,q0,q1) + 2 B(q0,h110) + B(q1,h200)>
//                g021 = <p1, C(q1,q1,q1*) + 2 B(q1,h011) + B(q1*,h020)>
//   double Hopf  h1100 = -J^-1 B(q1,q1*)                     h0011 = -J^-1 B(q2,q2*)
//                h2000 = (2 i w1 - J)^-1 B(q1,q1)            h0020 = (2 i w2 - J)^-1 B(q2,q2)
//                h1010 = (i (w1 + w2) - J)^-1 B(q1,q2)       h1001 = (i (w1 - w2) - J)^-1 B(q1,q2*)
//                g2100 = <p1, C(q1,q1,q1*) + 2 B(q1,h1100) + B(q1*,h2000)>
//                g1011 = <p1, C(q1,q2,q2*) + B(q1,h0011) + B(q2,h1001) + B(q2*,h1010)>
//                g1110 = <p2, C(q1,q1*,q2) + B(q2,h1100) + B(q1,h1001*) + B(q1*,h1010)>
//                g0021 = <p2, C(q2,q2,q2*) + 2 B(q2,h0011) + B(q2*,h0020)>
//
// (J - mu)^inv b is the solution x of the bordered system with <p, x> = 0. Coefficients are not known where F
// has no derivatives within its piece, or an eigenvalue is not apart from the others. Not installed.

#include <arcslip/continuation/linear/shifted_solver.hpp>
#include <arcslip/continuation/normal_forms/directional_derivatives.hpp>
#include <arcslip/continuation/problem/branch.hpp>

namespace arcslip::continuation {

/// right, left: null vectors of J.
Cusp cusp_form(Evaluator& at, const PlaceOfForms& place, const Vector& right, const Vector& left);
BogdanovTakens bogdanov_takens_form(Evaluator& at, const PlaceOfForms& place);
GeneralizedHopf generalized_hopf_form(Evaluator& at, const PlaceOfForms& place, double frequency);
/// l2 of the pair i omega, with its vectors. Not known where J consists of differences or is an operator, or
/// F has no derivatives within its piece.
Coefficient second_lyapunov(Evaluator& at, const PlaceOfForms& place, const Eigenpair& pair);
ZeroHopf zero_hopf_form(Evaluator& at, const PlaceOfForms& place, double frequency);
DoubleHopf double_hopf_form(Evaluator& at, const PlaceOfForms& place, double frequency,
                            double other_frequency);

/// The normal form of the Hopf point at the place whose pair is nearest to +- i frequency.
Hopf hopf_form_near(Evaluator& at, const PlaceOfForms& place, double frequency);

}  // namespace arcslip::continuation
