#pragma once
// What must hold between the sections of a scene, each of which is sound by itself.

#include <arcslip/scene/faults.hpp>

namespace arcslip::scene::file {

/// Samples suffice for the order where friction is sampled.
void check_samples(const Scene& scene, Faults& faults);
/// No force beyond the highest harmonic.
void check_excitation(const Scene& scene, Faults& faults);
/// Some mass, some stiffness, and something that acts on each degree of freedom.
void check_structure(const Scene& scene, Faults& faults);
/// Tied fields have one value.
void check_ties(const Scene& scene, Faults& faults);

}  // namespace arcslip::scene::file
