#pragma once
// The Jenkins element (Masing, macroslip): a spring of stiffness k_d in series with a slider of slip limit
// p = mu F_n. f grows by k_d dx and stays within [-p, p].
//
// Exact: for the given x(theta) the instants of slip onset and of reversal are found, and each phase is
// integrated in closed form. With the sticking phases i from the anchor r_i, where f = s_i p, and the
// slipping phases j of sign s_j:
//
//   F = k_d A + p B
//   A = kappa (G u - sum_i x(r_i) g_i),   B = kappa (sum_i s_i g_i + sum_j s_j l_j)
//   dF/du = kappa k_d (G - sum_i g_i phi(r_i)^T),   dF/dk_d = A at fixed p,   dF/dp = B
//
// G: integral of phi phi^T over all stick, g_i and l_j: of phi over one phase; kappa = 1/pi (mean row 1/(2
// pi)), or 2/pi over half a period where the motion is antisymmetric. Moving ends of phases do not enter,
// since f is continuous there; an anchor moves with x(r_i) alone, since x'(r_i) = 0. See docs/theory.md,
// section 3.
//
// Without slip (max x - min x <= 2 p/k_d) f is centred: f = k_d (x - (max x + min x)/2), the limit from the
// slipping side.
//
// Fields: stiffness k_d (N/m), friction_coefficient mu (-), normal_load F_n (N).

#include <arcslip/elements/element.hpp>

namespace arcslip::elements {

std::unique_ptr<Element> make_jenkins(const Harmonics& harmonics);

/// The same law sampled at `samples` equal intervals of the period (alternating frequency/time, Cameron &
/// Griffin 1989), with the exact Jacobian of the sampled force. For comparison; its error stalls near
/// samples^-2.
std::unique_ptr<Element> make_sampled_jenkins(const Harmonics& harmonics, int samples);

}  // namespace arcslip::elements
