#include <arcslip/elements/jenkins_force.hpp>

#include <arcslip/elements/friction_phases.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::elements {

std::vector<double> jenkins_force(const Harmonics& h, In u, double stiffness, double slip_limit,
                                  std::span<const double> angles) {
  std::vector<double> force(angles.size(), 0.0);
  if (stiffness == 0 || slip_limit == 0) return force;
  FrictionPhases search(h);
  const auto& phases = search.find(u, slip_limit / stiffness);
  if (phases.empty()) {
    const double centre = h.odd ? 0 : 0.5 * (search.highest().x + search.lowest().x);
    for (std::size_t i = 0; i < angles.size(); ++i)
      force[i] = stiffness * (series_values(h, u, angles[i]).x - centre);
    return force;
  }
  const double begin = phases.front().begin;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double spans = std::floor((angles[i] - begin) / h.span());
    const double theta = angles[i] - spans * h.span();
    const double sign = h.odd && std::fmod(spans, 2) != 0 ? -1 : 1;  // x(theta + pi) = -x(theta)
    const auto after = std::upper_bound(phases.begin(), phases.end(), theta,
                                        [](double t, const FrictionPhase& phase) { return t < phase.begin; });
    const FrictionPhase& phase = after == phases.begin() ? phases.front() : *(after - 1);
    const double stick =
        phase.sign * slip_limit + stiffness * (sign * series_values(h, u, angles[i]).x - phase.anchor_x);
    force[i] = sign * (theta < phase.end ? stick : phase.slip_sign * slip_limit);
  }
  return force;
}

}  // namespace arcslip::elements
