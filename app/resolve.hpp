#pragma once
// The scene that the command line asks for: the file's, with what --set, --harmonics, --from and --to change.

#include "options.hpp"

#include <arcslip/scene/scene.hpp>

#include <cstddef>

namespace arcslip::app {

/// Reads the scene and applies --set and --harmonics. Throws scene::FileError, scene::SceneError for what is
/// wrong in the file, and UsageError for what is wrong on the command line.
scene::Scene resolve(const Options& options);

/// Applies --from and --to to a study. Throws UsageError where the range is empty then.
void set_range(scene::Study& study, const scene::Scene& scene, const Options& options);

/// Tells what the scene's own check says of the study with this index, which the options made, by these
/// options. Throws UsageError.
void check_study(const scene::Scene& scene, std::size_t index, const Options& options);

/// The scene's first study of the verb's kind, over the parameter that was asked for if there is one, with
/// what the command line says; it is made from that where there is none. Throws UsageError.
scene::Study study_of_verb(scene::Scene& scene, scene::StudyKind kind, const Options& options);

/// The same of the verb optimize: the scene's first study of kind optimum, with the parameters, bounds,
/// window and settings of the command line.
scene::Study optimum_of_verb(scene::Scene& scene, const Options& options);

}  // namespace arcslip::app
