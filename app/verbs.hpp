#pragma once

#include "command_line/options.hpp"
#include "exit_code.hpp"

namespace arcslip::app {

/// Does what the options ask for. catalogue: the kinds of studies that a scene may hold. Throws UsageError,
/// scene::SceneError, scene::FileError, output::WriteError.
ExitCode execute(const CommandOptions& options, const scene::Catalogue& catalogue);

}  // namespace arcslip::app
