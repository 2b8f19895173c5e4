#pragma once
// Studies with all that a run leaves: files, tables, the report and remarks.

#include "command_line/options.hpp"
#include "exit_code.hpp"

#include <arcslip/scene/scene.hpp>

#include <string>
#include <vector>

namespace arcslip::app {

/// Runs studies of a scene one after the other. notes: of their results. Checks all outputs before anything
/// is computed. Throws UsageError, output::WriteError.
ExitCode run_studies(const scene::Scene& scene, const std::vector<scene::Study>& studies,
                     const CommandOptions& options, const std::vector<std::string>& notes);

}  // namespace arcslip::app
