#pragma once
// The command line options.

#include "../exit_code.hpp"

#include <arcslip/control/error.hpp>
#include <arcslip/output/figures.hpp>
#include <arcslip/scene/keys/json_tree.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/scene/study_type.hpp>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace arcslip::app {

/// A parameter and its range on the command line: name.field, or name.field=lower:upper.
struct RangeOption {
  std::string parameter;
  std::optional<std::pair<double, double>> range;
};

/// A key of a study, given by an option.
struct GivenKey {
  scene::Key key;
  std::string text;  // "--from 18", for messages
  // ranges: of KeyType::parameters and KeyType::followed
  std::variant<scene::file::Node, std::vector<RangeOption>> value;
};

/// Of the verbs "ensemble" and "merge".
struct EnsembleOptions {
  std::string study, keep, part;   // "" for none
  std::vector<std::string> parts;  // paths
};

/// Of --set: a parameter and its value, or a text with a unit or a formula.
struct Assignment {
  std::string parameter, text;
  std::optional<double> value;  // none: it is no plain number
};

struct CommandOptions {
  std::string verb;                        // "run", "check", "show" ..., or the verb of a kind of study
  const scene::StudyType* type = nullptr;  // of the verb
  std::string scene;                       // path
  std::vector<Assignment> set;
  std::optional<int> harmonics;
  std::optional<double> accuracy;
  std::vector<GivenKey> keys;                    // of the study; run: of its frequency responses
  std::string out, json, csv;                    // paths, "-" for standard output (json, csv), "" for none
  std::string report;                            // path; "": run writes it to its folder, other verbs none
  std::optional<int> combinations;               // of for_each, maximum
  std::optional<int> threads;                    // combinations computed at the same time
  std::vector<std::string> columns, events;      // of tables; empty: as they are
  std::string new_kind;                          // of the verb new
  std::map<std::string, double> new_numbers;     // by their options, those that are given
  std::map<std::string, std::string> new_texts;  // names, and files by what stands for them in the usage
  EnsembleOptions ensemble;
  std::array<std::string, 2> files{};  // of results
  std::string x, y;                    // columns to plot; "": the usual ones
  double tolerance = 0;                // of compare
  output::FigureOptions figures{};
  bool receptance = false;  // a figure of it for each of amplitudes
  bool coefficients = false;
  bool quiet = false;
};

/// Invalid arguments. what() names the argument and the remedy.
class UsageError : public Error {
  using Error::Error;
};

/// Text printed instead of a run: help, the version, the schema of scenes.
struct Information {
  std::string text;
};

/// The commit, the compiler, and the libraries with their versions and licences; of BLAS the one that is
/// loaded.
std::string build_details();

/// catalogue: the kinds of studies, each with its verb. Throws UsageError.
std::variant<CommandOptions, Information> parse(int argc, const char* const* argv,
                                                const scene::Catalogue& catalogue);

}  // namespace arcslip::app
