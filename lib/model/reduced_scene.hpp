#pragma once
// The reduced structure of a scene as files: the matrices of structure/reduction.hpp in Matrix Market format,
// the names of their rows, the loads of shapes, and the scene with these in place of its own.

#include <arcslip/control/error.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/scene/scene.hpp>

#include <string>
#include <utility>
#include <vector>

namespace arcslip::model {

struct ReducedScene {
  std::string scene;                                       // text of the scene file
  std::vector<std::pair<std::string, std::string>> files;  // that it names: names and texts
};

/// A structure that has no reduction, or none that files can hold: what() says why.
class NotReduced : public Error {
  using Error::Error;
};

/// folder: of the new scene and its files, to which the paths of other files become relative. The new scene
/// has the error of the reduction up to its highest frequency, and up to further ones below it, in the
/// scene's unit. Throws NotReduced where the matrices are not reduced or where the ground moves under all
/// rows, structure::ReductionError and control::Interrupted.
ReducedScene reduced_scene(const scene::Scene& scene, const std::string& folder,
                           const control::Control& control = {},
                           std::vector<double> further_frequencies = {});

}  // namespace arcslip::model
