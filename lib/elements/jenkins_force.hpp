#pragma once
// The force of the Jenkins element over one period, as it is: piece by piece, without a series.

#include <arcslip/elements/series.hpp>

#include <span>
#include <vector>

namespace arcslip::elements {

/// f (N) at each angle (rad), for the motion u in the layout of harmonics.hpp. stiffness: k_d, N/m;
/// slip_limit: p = mu F_n, N. Sticking f = s_a p + k_d (x - x(r_a)) from the last anchor r_a, slipping f = +p
/// or -p; without slip f is centred, as in jenkins.hpp.
std::vector<double> jenkins_force(const Harmonics& harmonics, In u, double stiffness, double slip_limit,
                                  std::span<const double> angles);

}  // namespace arcslip::elements
