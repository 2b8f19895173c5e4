#pragma once

#include <arcslip/scene/scene.hpp>

#include <string>

namespace arcslip::scene {

/// The harmonics of the scene at the highest frequency that the study names, in the scene's unit; 0 where it
/// names none, and as long as an accuracy is to choose the harmonics.
double highest_harmonic(const Scene& scene, const Study& study);

/// The doubt about a study whose harmonics exceed the highest frequency to which the matrices of the scene
/// are reduced; "" where there is none.
std::string beyond_reduction(const Scene& scene, const Study& study);

}  // namespace arcslip::scene
