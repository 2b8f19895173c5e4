#pragma once

#include "exit_code.hpp"
#include "options.hpp"

namespace arcslip::app {

/// Does what the options ask for. Throws UsageError, scene::SceneError, scene::FileError, output::WriteError.
ExitCode execute(const Options& options);

}  // namespace arcslip::app
