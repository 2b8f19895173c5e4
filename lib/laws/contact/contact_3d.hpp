#pragma once
// A contact with friction in two tangential directions and a varying normal load: a tangential spring k_t
// with a Coulomb slider, the same in all directions of the plane, and a unilateral normal spring k_n under
// the preload N_0,
//
//   N = max(N_0 + k_n x_n, 0),   T = k_t (x - w),   |T| <= mu N,   x = (x_1, x_2)
//
// w: the slider, which rests while |T| < mu N, slips against T at |T| = mu N, and follows x while the contact
// is open. T acts against x, and N - max(N_0, 0) against x_n: the structure is in equilibrium with the
// preload at rest. A negative N_0 is a gap of -N_0/k_n. Where x stays on a line this is contact_2d.
//
// Events are located (planar_phases.hpp); integrals over stick and contact are closed, those over slip are by
// collocation (slip_collocation.hpp) with errors of 1e-12 of the largest mu N. With h = mu N/k_t, the
// derivatives of the direction psi of slip and of the rests w follow the history,
//
//   in slip, n = (cos psi, sin psi), t = n turned   h dpsi' + (x'.n) dpsi = dx'.t - psi' dh
//   at the onset of slip                            dpsi = t.(dx - dw)/h
//   at its end                                      dw = dx - dh n - h t dpsi
//   where stick begins at closing                   dw = dx - (x'/h') dh
//   where slip begins at closing                    dpsi = (t.dx' - psi' dh)/|x'|,  psi' = t.x''/(h' + |x'|)
//
// and close over the period where the contact never opens. Without slip w is centred (stick_feasibility.hpp).
// The error of harmonic balance falls as N^-3.
//
// In time a step has a linear path of (x, x_n), along which the slider is known in closed form.
//
// Fields: tangential_stiffness k_t, normal_stiffness k_n (N/m), friction_coefficient mu (-), normal_load N_0
// (N). Directions: tangential_1, tangential_2, orthogonal to one another, and normal, positive into the
// contact.

#include <arcslip/laws/law_type.hpp>

namespace arcslip::elements {

/// "contact_3d".
const PlainLaw& contact_3d();

std::unique_ptr<Element> make_contact_3d(const Harmonics& harmonics);
std::unique_ptr<Corners> make_contact_3d_corners(const Harmonics& harmonics);
/// The exact force at some angles, as Law::force_at.
Eigen::MatrixXd contact_3d_force(const Harmonics& harmonics, In u, Fields fields, Angles angles);

}  // namespace arcslip::elements
