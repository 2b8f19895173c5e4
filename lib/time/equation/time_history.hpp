#pragma once
// Results of a time integration, independent of the integrator.

#include <arcslip/time/equation/equation_of_motion.hpp>

#include <vector>

namespace arcslip::time {

/// One element at the instants of a history.
struct ElementTimeHistory {
  std::string name;
  std::vector<double> displacement;  // d . x, m
  std::vector<double> force;         // N, against the motion
  std::vector<double>
      slider;  // z of the first slider along the first direction, m; empty where there is none
  std::vector<double> normal_load;  // N; empty where it does not vary
};

struct TimeHistory {
  std::vector<double> time;          // s
  std::vector<double> displacement;  // of the response, m
  std::vector<double> velocity;      // m/s
  std::vector<ElementTimeHistory> elements;
};

/// The sum of the normal loads of some elements at the instants, N.
inline std::vector<double> total_load(const TimeHistory& history, std::size_t first, std::size_t count) {
  std::vector<double> sum(history.time.size());
  for (std::size_t e = first; e < first + count; ++e)
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += history.elements[e].normal_load[i];
  return sum;
}

/// Energies over an interval, J:  input = friction + viscous + stored.
struct EnergyBalance {
  double input = 0;     // work of the excitation
  double friction = 0;  // dissipated by the friction elements
  double viscous = 0;   // dissipated by the dampers and by circulatory forces
  double stored = 0;    // change of kinetic and elastic energy, that of the elements included

  double defect() const { return input - friction - viscous - stored; }
};

}  // namespace arcslip::time
