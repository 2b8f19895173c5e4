#pragma once
// The scene to run: that of the file, modified by --set, --harmonics and the options of a study.

#include "command_line/options.hpp"

#include <arcslip/scene/scene.hpp>

#include <cstddef>

namespace arcslip::app {

/// Reads the scene and applies --set and --harmonics. Throws scene::FileError or scene::SceneError for errors
/// in the file, and UsageError for errors on the command line.
scene::Scene resolve(const CommandOptions& options, const scene::Catalogue& catalogue);

/// Whether a study has all keys given by the options.
bool takes_keys(const scene::Study& study, const CommandOptions& options);

/// The scene with the options applied to one of its studies. Throws UsageError, naming the option, if the
/// result is not a valid study.
scene::Scene with_options(const scene::Scene& scene, std::size_t study, const CommandOptions& options);

/// The index of the study to run for the verb: the scene's first study of its kind (over the requested
/// parameter, if given) with the options applied, or a new one made from the options. Adds it to the scene.
/// Throws UsageError.
std::size_t study_of_verb(scene::Scene& scene, const CommandOptions& options);

}  // namespace arcslip::app
