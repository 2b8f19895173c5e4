#pragma once
// The paper's oscillator and its load.

#include "lib/hbm/scenes.hpp"

#include <arcslip/optimize/search/optimum.hpp>

namespace paper_optimum {

inline const arcslip::optimize::OptimumProblem over_load{{{"damper.normal_load", 0.1, 100}}, 18, 22};

/// c = 0, one harmonic: kd A = p^2/(p - q), p = mu Fn, q = pi f0/4.
inline arcslip::scene::Scene closed_form(double load = 5) {
  arcslip::scene::Scene s = scenes::paper(1, load);
  arcslip::scene::set(s, "c.value", 0);
  return s;
}

inline double peak(double p, double q, double stiffness = 3500) {
  return p * p / (p - q) / stiffness;
}

}  // namespace paper_optimum
