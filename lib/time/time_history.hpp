#pragma once
// Results of a time integration, independent of the integrator.

#include <arcslip/time/equation_of_motion.hpp>

#include <vector>

namespace arcslip::time {

/// One element at the instants of a history.
struct ElementTimeHistory {
  std::string name;
  std::vector<double> displacement;  // d . x, m
  std::vector<double> force;         // N, against the motion
  std::vector<double>
      slider;  // z of the first slider along the first direction, m; empty where there is none
};

struct TimeHistory {
  std::vector<double> time;          // s
  std::vector<double> displacement;  // of the response, m
  std::vector<double> velocity;      // m/s
  std::vector<ElementTimeHistory> elements;
};

/// Energies over an interval, J:  input = friction + viscous + stored.
struct EnergyBalance {
  double input = 0;     // work of the excitation
  double friction = 0;  // dissipated by the friction elements
  double viscous = 0;   // dissipated by the dampers
  double stored = 0;    // change of kinetic and elastic energy, that of the elements included

  double defect() const { return input - friction - viscous - stored; }
};

}  // namespace arcslip::time
