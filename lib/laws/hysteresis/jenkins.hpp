#pragma once
// The Jenkins element (Masing, macroslip): a spring of stiffness k_d in series with a slider of slip limit
// p = mu F_n. f grows by k_d dx and stays within [-p, p].
//
// Exact: the slip onsets and reversals of x(theta) are found, and each phase is integrated in closed form.
// With the stick phases i from the anchor r_i, where f = s_i p, and the slip phases j of sign s_j:
//
//   F = k_d A + p B
//   A = kappa (G u - sum_i x(r_i) g_i),   B = kappa (sum_i s_i g_i + sum_j s_j l_j)
//   dF/du = kappa k_d (G - sum_i g_i phi(r_i)^T),   dF/dk_d = A at fixed p,   dF/dp = B
//
// G: integral of phi phi^T over all stick, g_i and l_j: of phi over one phase; kappa = 1/pi (mean row 1/(2
// pi)), or 2/pi over half a period for antisymmetric motion. The motion of the ends of phases does not enter,
// since f is continuous there; an anchor depends on x(r_i) only, since x'(r_i) = 0. See
// docs/theory/03-friction-integrals.md.
//
// Without slip (max x - min x <= 2 p/k_d) f = k_d (x - w), where the offset w of the slider is a choice
// (laws/slider_offset.hpp). Centred, w = (max x + min x)/2.
//
// Fields: stiffness k_d (N/m), friction_coefficient mu (-), normal_load F_n (N).
//
// In time the slider z rests while |k_d (q - z)| < p, and follows q at |f| = p.

#include <arcslip/laws/law_type.hpp>
#include <arcslip/laws/slider_offset.hpp>

namespace arcslip::elements {

namespace jenkins_field {
enum { stiffness, friction_coefficient, normal_load };
}

/// "jenkins"; its option "offset" is centred in the law itself.
const PlainLaw& jenkins();

std::unique_ptr<Element> make_jenkins(const Harmonics& harmonics, Offset offset = Offset::centred);

/// A slider with a spring of stiffness k (N/m) and the slip limit p (N), as an automaton.
Automaton jenkins_automaton(int memory, double k, double p);

/// Onset of slip at a reversal of its motion w: stuck since the reversal theta_a, where f = s_a p, it reaches
/// s p just at the reversal theta_r. Angles theta_a, theta_r;
///
///   h = (s k_d (w(theta_r) - w(theta_a)) - (1 - s s_a) p) / 2,  N
///
/// From full stick, theta_a is where w is least and theta_r where it is largest: h = k_d (max w - min w)/2 -
/// p. Of an element that sticks, s = s_a is the corner where another reversal becomes the highest or the
/// lowest, and the mean of its force is determined by that.
///
/// With a static offset that is so where a bound carries the slider; and where one begins to, from w = 0,
///
///   h = s k_d w(theta_r) - p,  N
std::unique_ptr<Corners> make_jenkins_corners(const Harmonics& harmonics, Offset offset = Offset::centred);

}  // namespace arcslip::elements
