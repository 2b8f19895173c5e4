#pragma once
// Consistency checks between the sections of a scene, each of which is valid by itself.

#include <arcslip/scene/faults.hpp>

namespace arcslip::scene::file {

/// With sampled friction the samples suffice for the order.
void check_samples(const Scene& scene, Faults& faults);
/// Nothing that one sector of a ring cannot have.
void check_cyclic(const Scene& scene, Faults& faults);
/// No force beyond the highest harmonic.
void check_excitation(const Scene& scene, Faults& faults);
/// No absolute response where the ground runs away.
void check_frames(const Scene& scene, Faults& faults);
/// Some mass, some stiffness, and something that acts on each degree of freedom.
void check_structure(const Scene& scene, Faults& faults);

}  // namespace arcslip::scene::file
