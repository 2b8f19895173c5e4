#pragma once
// The verbs and options of the command, as CLI11 has them: of what they are made, not what they mean.

#include "key_options.hpp"
#include "options.hpp"

#include <CLI/CLI.hpp>

#include <map>
#include <string>
#include <vector>

namespace arcslip::app {

inline constexpr const char *run_verb = "run", *check_verb = "check", *reduce_verb = "reduce",
                            *new_verb = "new", *show_verb = "show", *plot_verb = "plot",
                            *compare_verb = "compare", *schema_verb = "schema", *manual_verb = "manual",
                            *completions_verb = "completions";

/// A verb that takes a scene.
struct Verb {
  std::string name, help;
  const scene::StudyType* type = nullptr;  // none: run, reduce, check
  std::vector<KeyOption> keys{};
};

/// Option values kept as text until parsing is complete.
struct Texts {
  std::vector<std::string> set;
  std::string harmonics, accuracy, combinations, threads, columns, events, tolerance, shell, figures,
      figure_size, figure_style;
  std::map<std::string, std::string> numbers{};  // of a new scene, by their options
};

/// All verbs, and the options of one of them, or of all for an empty name; likewise the kinds of the verb
/// new.
struct OptionTree {
  OptionTree(const scene::Catalogue& catalogue, const std::string& verb, const std::string& kind);
  OptionTree(const OptionTree&) = delete;
  OptionTree& operator=(const OptionTree&) = delete;

  std::vector<std::string> names() const;  // of the verbs

  CLI::App app{"Responses of vibrating structures with friction and other nonlinear elements.", "arcslip"};
  CommandOptions options;
  Texts texts;
  std::vector<Verb> verbs;
  std::map<const CLI::App*, const Verb*> verb_of;
  CLI::App* new_scene = nullptr;
};

/// The manual page for the verb manual, else the completions of a shell. all: with the options of all verbs.
/// Throws UsageError for another shell than bash, zsh and fish.
std::string shell_file(const std::string& verb, const std::string& shell, const CLI::App& all);

}  // namespace arcslip::app
