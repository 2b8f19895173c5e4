#pragma once
// The elastic energy of a nonlinear element in its periodic motion.

#include <arcslip/laws/law.hpp>

namespace arcslip::observables {

/// At one angle (rad) of the motion, J: law.stored() with the memory that the law has there. motion: its
/// coefficients as for Element::move_to(). One force determines as many memories as it has directions; more,
/// as those of many sliders, come from a march between the reversals of the motion, after two periods. 0 of
/// laws whose force depends on the velocity.
double stored_energy(const elements::Law& law, elements::Fields fields, const elements::Harmonics& harmonics,
                     elements::In motion, double theta);

}  // namespace arcslip::observables
