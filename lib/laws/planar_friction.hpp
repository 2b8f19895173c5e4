#pragma once
// A law with two tangential directions and a normal one: a slider under a normal load that varies and may
// open (laws/contact/contact_3d.hpp). What its slider does along a motion depends on these numbers alone
// (laws/contact/planar_phases.hpp).

#include <span>

namespace arcslip::elements {

/// An optional part of such a law: Law::plane_friction().
class PlaneFriction {
 public:
  /// Stiffnesses k_t, k_n (N/m), friction coefficient, and the normal load at rest, N.
  struct Contact {
    double k_t, k_n, mu, N_0;
  };
  virtual Contact contact(std::span<const double> fields) const = 0;

 protected:
  ~PlaneFriction() = default;
};

}  // namespace arcslip::elements
