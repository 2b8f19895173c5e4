#pragma once

#include <arcslip/scene/scene.hpp>

#include <string>

namespace arcslip::observables {

/// Reduces the structure of a scene for all of its studies, where that takes long, before the first of them.
/// A sentence on what was done, or "". Throws SceneError for matrices that cannot be reduced, and
/// Interrupted.
std::string prepare(const scene::Scene& scene, const scene::StopRequest& stop);

}  // namespace arcslip::observables
