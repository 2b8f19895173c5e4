#pragma once
// Coulomb friction regularized by the velocity: f = mu F_n tanh(v/v_0).
//
// It creeps where Coulomb friction sticks: below v_0 it is a viscous damper of mu F_n/v_0. Sampled; harmonics
// of f and error of the samples fall exponentially beyond V/v_0, V the largest velocity.
//
// Fields: friction_coefficient mu, normal_load F_n (N), reference_velocity v_0 (m/s).

#include <arcslip/laws/law.hpp>

namespace arcslip::elements {

/// "tanh_friction".
const PlainLaw& tanh_friction();

}  // namespace arcslip::elements
