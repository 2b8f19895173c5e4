#pragma once
// The natural modes of the structure without contacts and without dampers.

#include <arcslip/control/run_control.hpp>
#include <arcslip/time/equation/equation_of_motion.hpp>

#include <limits>
#include <memory>

namespace arcslip::time {

/// (K - squares_j M) V_j = 0 with the symmetric part of K, V^T M V = 1, squares rising, (rad/s)^2; and the
/// motions without mass, V_s^T K V_s = 1.
struct NaturalModes {
  Vector squares;
  Matrix V, without_mass;
};

/// control: asked between its two decompositions; if it has ended, there are none. Throws SingularMass where
/// a motion without mass has a damper, or no spring of its own.
std::shared_ptr<const NaturalModes> natural_modes(const EquationOfMotion& equation,
                                                  const control::Control& control = {});

/// Which of them have inertia: of the lowest `most` those up to a natural frequency, rad/s, and the first ten
/// in any case.
struct ModesKept {
  double highest = std::numeric_limits<double>::infinity();
  int most = std::numeric_limits<int>::max();
};

}  // namespace arcslip::time
