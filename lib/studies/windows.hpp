#pragma once
// Windows of frequencies that a scene leaves out.

#include <arcslip/analyses/branches/model_description.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace arcslip::studies {

/// Whether a study looks for resonances in a window that the scene leaves out.
bool lacks_window(const scene::Study& study);

/// The windows that a scene gives, of frequencies and not of one frequency.
std::vector<observables::WindowOfStudy> windows_of(const scene::Scene& scene);

/// Gives a study of the scene that lacks a window one around the first resonance
/// (analyses/branches/proposed_window.hpp), over the values that it gives to parameters. Returns a sentence
/// about it, "" where it has one or looks for none. Throws SceneError where no resonance is known, and
/// Interrupted.
std::string propose_window(scene::Scene& scene, std::size_t study, const control::Control& control = {});

}  // namespace arcslip::studies
