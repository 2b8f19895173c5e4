#pragma once
// The scene that the command line asks for: the file's, with what --set, --harmonics, --from and --to change.

#include "options.hpp"

#include <arcslip/scene/scene.hpp>

namespace arcslip::app {

/// Reads the scene and applies --set and --harmonics. Throws scene::FileError, scene::SceneError for what is
/// wrong in the file, and UsageError for what is wrong on the command line.
scene::Scene resolve(const Options& options);

/// Applies --from and --to to a study. Throws UsageError where the range is empty then.
void set_range(scene::Study& study, const scene::Scene& scene, const Options& options);

/// The scene's first study of kind frf, with --from and --to; it is made from these where there is none.
/// Throws UsageError.
scene::Study frequency_study(scene::Scene& scene, const Options& options);

}  // namespace arcslip::app
