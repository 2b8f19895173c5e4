#pragma once

#include <arcslip/scene/scene.hpp>

#include <string>

namespace arcslip::scene {

/// The doubt about a study whose harmonics exceed the highest frequency to which the matrices of the scene
/// are reduced; "" where there is none. The harmonics of the scene at the highest frequency that the study
/// names; "" as long as an accuracy is to choose them.
std::string beyond_reduction(const Scene& scene, const Study& study);

}  // namespace arcslip::scene
