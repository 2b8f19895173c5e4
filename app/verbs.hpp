#pragma once

#include "exit_code.hpp"
#include "options.hpp"

namespace arcslip::app {

/// Does what the options ask for. catalogue: the kinds of studies that a scene may hold. Throws UsageError,
/// scene::SceneError, scene::FileError, output::WriteError.
ExitCode execute(const CommandOptions& options, const scene::Catalogue& catalogue);

}  // namespace arcslip::app
