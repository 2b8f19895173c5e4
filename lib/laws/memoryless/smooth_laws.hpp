#pragma once
// Laws that are a formula of one displacement q (m) and its velocity v (m/s): a line of a table each, with
// fields, units and bounds.

#include <arcslip/laws/law_type.hpp>

namespace arcslip::elements {

/// "cubic_spring": stiffness q^3.
const PlainLaw& cubic_spring();
/// "van_der_pol": coefficient (q^2/amplitude^2 - 1) v, which feeds small motions and damps large ones.
const PlainLaw& van_der_pol();
/// "tanh_friction": friction_coefficient normal_load tanh(v/reference_velocity).
const PlainLaw& tanh_friction();

}  // namespace arcslip::elements
