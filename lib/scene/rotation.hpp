#pragma once
// The rotation of a structure from matrices: its damping is C + Omega G, with gyroscopic or Coriolis forces
// in G, its stiffness K + Omega N + Omega^2 K2, with the circulatory forces of rotating damping in N, and the
// stiffening by centrifugal forces and the softening of a rotating frame in K2. The speed Omega is a
// parameter, or follows the excitation: Omega = frequency/engine_order, both as angles per time.

#include <arcslip/scene/field.hpp>

#include <vector>

namespace arcslip::scene {

struct Rotation {
  double highest_speed = 0;     // rad/s, up to which a reduced structure is right; 0: not given
  double engine_order = 0;      // 0: the speed is a parameter
  std::vector<Field> fields{};  // the speed, where it is one
  friend bool operator==(const Rotation& a, const Rotation& b) {
    return a.highest_speed == b.highest_speed && a.engine_order == b.engine_order;
  }
};

}  // namespace arcslip::scene
