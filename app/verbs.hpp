#pragma once
// What the command does for its options, and the parts of it: the scene to run, and the run of its studies.

#include "command_line/options.hpp"
#include "exit_code.hpp"

#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace arcslip::app {

/// Does what the options ask for. catalogue: the kinds of studies that a scene may hold. Throws UsageError,
/// scene::SceneError, scene::FileError, output::WriteError.
ExitCode execute(const CommandOptions& options, const scene::Catalogue& catalogue);

// The scene: that of the file, modified by --set, --harmonics and the options of a study.

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

// Studies with all that a run leaves: files, tables, the report and remarks.

/// Runs studies of a scene one after the other. notes: of their results. Checks all outputs before anything
/// is computed. Throws UsageError, output::WriteError.
ExitCode run_studies(const scene::Scene& scene, const std::vector<scene::Study>& studies,
                     const CommandOptions& options, const std::vector<std::string>& notes);

}  // namespace arcslip::app
