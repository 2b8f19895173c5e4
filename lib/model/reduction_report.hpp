#pragma once

#include <arcslip/control/run_control.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/scene/scene.hpp>

#include <optional>
#include <string>

namespace arcslip::observables {

/// How the matrices of a scene are reduced, its error to two digits; empty: they are not. The first call
/// reduces them, for all studies of the scene. Throws SceneError for matrices that cannot be reduced, and
/// Interrupted.
std::optional<model::Reduction> reduction(const scene::Scene& scene, const control::Control& control = {});

/// The error of the structure as it was given, where a reduction made it, and as it is reduced here, up to a
/// frequency, and that frequency, in the scene's unit: 0 or above the highest that is known stands for that.
/// Nothing where neither is reduced.
std::optional<scene::ErrorOfReduction> error_of_reduction(const scene::Scene& scene, double frequency,
                                                          const control::Control& control = {});

/// reduction() as a sentence, or "".
std::string prepare(const scene::Scene& scene, const control::Control& control);

}  // namespace arcslip::observables
