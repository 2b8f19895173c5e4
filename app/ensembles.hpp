#pragma once
// The verbs "ensemble" and "merge": many samples of a study in one file.

#include "exit_code.hpp"
#include "command_line/options.hpp"

#include <arcslip/scene/scene.hpp>

namespace CLI {
class App;
}

namespace arcslip::app {

inline constexpr const char *ensemble_verb = "ensemble", *merge_verb = "merge";

/// Adds the options of a verb that no other verb has.
void add_ensemble_options(CLI::App& verb, CommandOptions& options);
void add_merge_options(CLI::App& verb, CommandOptions& options);

/// Throws UsageError, and the exceptions of ensemble::run() and ensemble::merge().
ExitCode compute_ensemble(const scene::Scene& scene, const CommandOptions& options);
ExitCode merge_ensemble(const CommandOptions& options);

}  // namespace arcslip::app
