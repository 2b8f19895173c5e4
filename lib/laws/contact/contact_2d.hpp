#pragma once
// A contact with friction and a varying normal load: a tangential spring k_t with a Coulomb slider, and a
// unilateral normal spring k_n under the preload N_0,
//
//   N = max(N_0 + k_n x_n, 0),   T = k_t (x_t - w),   |T| <= mu N
//
// w: the slider, which rests while |T| < mu N, slips at |T| = mu N, and follows x_t while the contact is
// open. T acts against x_t, and N - max(N_0, 0) against x_n: the structure is in equilibrium with the preload
// at rest. A negative N_0 is a gap of -N_0/k_n. With x_n = 0 this is the Jenkins element.
//
// Exact: with the phases of contact_phases.hpp, the coefficients n of N_0 + k_n x_n, the stick phases i from
// the rest w_i, and the integrals G_c over contact, G_s over stick and G_f over slip with its sign,
//
//   F_n = kappa G_c n - max(N_0, 0) e_0
//   F_t = kappa (k_t G_s u_t - k_t sum_i w_i g_i + mu G_f n),   g_i: integral of phi over stick phase i
//
// kappa = 1/pi (mean row 1/(2 pi)). The motion of the ends of phases does not enter the derivatives, since T
// and N are continuous there. The rests are, with c = mu k_n/k_t,
//
//   dw = phi(theta).du_t + s c phi(theta).du_n     at a reversal of x_t + s h, s = 1 or -1
//   dw = phi(theta).du_t - (x_t'/x_n') phi(theta).du_n     where stick begins at closing, whose angle moves
//
// Without slip w is a choice between the bounds a and b that it may have (contact_phases.hpp,
// laws/slider_offset.hpp). Centred, the contact holds no mean tangential force but what the varying load
// makes. The error of harmonic balance falls as N^-3.
//
// Fields: tangential_stiffness k_t, normal_stiffness k_n (N/m), friction_coefficient mu (-), normal_load N_0
// (N). Directions: tangential, normal, positive into the contact.

#include <arcslip/laws/contact/contact_phases.hpp>
#include <arcslip/laws/law_type.hpp>

namespace arcslip::elements {

/// "contact_2d"; its option "offset" is centred in the law itself.
const PlainLaw& contact_2d();

/// By its fields.
ContactLaw contact_law(Fields fields);

std::unique_ptr<Element> make_contact_2d(const Harmonics& harmonics, Offset offset = Offset::centred);
std::unique_ptr<Corners> make_contact_2d_corners(const Harmonics& harmonics, Offset offset = Offset::centred);

}  // namespace arcslip::elements
