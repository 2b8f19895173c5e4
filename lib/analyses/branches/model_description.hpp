#pragma once
// What a scene is a model of, in sentences for people, and what in it is probably not meant.

#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/scene/scene.hpp>

#include <span>
#include <string>
#include <vector>

namespace arcslip::observables {

/// The frequencies over which a study looks for resonances.
struct WindowOfStudy {
  std::string study;
  FrequencyWindow window;
};

/// facts: masses of the coordinates, or along x, y and z where all their names end so; the first natural
/// frequencies, free and stuck, with their damping ratios; the deflection under the amplitude of the forces.
/// doubts: what is likely wrong, each with what to do.
struct ModelDescription {
  std::vector<std::string> facts, doubts;
};

/// Of structures with at most 1000 degrees of freedom that are no rotors; of others the masses alone. Throws
/// Interrupted.
ModelDescription describe_model(const scene::Scene& scene, std::span<const WindowOfStudy> windows,
                                const control::Control& control = {});

}  // namespace arcslip::observables
