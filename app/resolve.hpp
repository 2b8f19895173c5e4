#pragma once
// The scene that the command line asks for: the file's, with what --set, --harmonics and the options of a
// study change.

#include "options.hpp"

#include <arcslip/scene/scene.hpp>

#include <cstddef>

namespace arcslip::app {

/// Reads the scene and applies --set and --harmonics. Throws scene::FileError, scene::SceneError for what is
/// wrong in the file, and UsageError for what is wrong on the command line.
scene::Scene resolve(const Options& options, const scene::Catalogue& catalogue);

/// Whether a study has all keys that the options give.
bool takes_keys(const scene::Study& study, const Options& options);

/// The scene with the keys that the options give in one of its studies. Throws UsageError where what they
/// make is no study, with the option that is at fault.
scene::Scene with_options(const scene::Scene& scene, std::size_t study, const Options& options);

/// The study that the verb asks for: the scene's first one of its kind, over the parameter that was asked for
/// if there is one, with what the options say; made from these where there is none. Changes the scene to one
/// that has it. Throws UsageError.
scene::Study study_of_verb(scene::Scene& scene, const Options& options);

}  // namespace arcslip::app
