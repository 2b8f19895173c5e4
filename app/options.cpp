#include "options.hpp"

#include "ensembles.hpp"
#include "key_options.hpp"
#include "option_values.hpp"

#include <arcslip/results/text.hpp>
#include <arcslip/results/version.hpp>
#include <arcslip/scene/combinations.hpp>
#include <arcslip/scene/format/json_schema.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <map>

namespace arcslip::app {
namespace {

constexpr std::string_view exit_codes =
    "Exit codes: 0 done, 1 usage or file, 2 invalid scene, 3 stopped early with partial results written.";

constexpr const char *run_verb = "run", *check_verb = "check", *reduce_verb = "reduce";
constexpr int most_threads = 1024;

struct Verb {
  std::string name, help;
  const scene::StudyType* type = nullptr;  // none: run, ensemble, merge, reduce, check
  std::vector<KeyOption> keys{};
};

/// The keys "from" and "to" of a kind with a frequency range.
std::vector<scene::Key> range_keys(const scene::Catalogue& catalogue) {
  std::vector<scene::Key> keys;
  for (const auto& type : catalogue.studies) {
    for (const scene::Key& key : type->keys()) {
      const bool is_end = key.name == "from" || key.name == "to";
      if (keys.size() < 2 && key.type == scene::KeyType::frequency && is_end) keys.push_back(key);
    }
  }
  return keys;
}

std::vector<Verb> verbs_of(const scene::Catalogue& catalogue) {
  std::vector<Verb> verbs{{run_verb, "run every study of the scene: results and figures"}};
  for (const auto& type : catalogue.studies)
    verbs.push_back({std::string(type->verb()), std::string(type->help()), type.get()});
  for (scene::Key key : range_keys(catalogue)) {
    key.help += " of frequency responses";
    verbs.front().keys.push_back({key});
  }
  verbs.push_back({ensemble_verb, "compute many samples of a study into one file, and go on where it ended"});
  verbs.push_back({merge_verb, "join the files of parts of an ensemble"});
  verbs.push_back({reduce_verb, "write the reduced structure of the scene, and the scene with it"});
  verbs.push_back({check_verb, "validate the scene and print it with every default"});
  return verbs;
}

std::string names_of(const std::vector<Verb>& verbs) {
  std::string names;
  for (const Verb& verb : verbs) names.append(names.empty() ? "" : ", ").append(verb.name);
  return names + " or schema";
}

/// Option values kept as text until parsing is complete.
struct Texts {
  std::vector<std::string> set;
  std::string harmonics, accuracy, combinations, threads;
};

/// The options of every verb that takes a scene.
void add_scene_options(CLI::App& verb, CommandOptions& options, Texts& texts) {
  verb.add_option("SCENE", options.scene, "scene file (JSON, format arcslip-scene-1)")
      ->required()
      ->type_name("");
  verb.footer(std::string(exit_codes));
  verb.add_option("--set", texts.set,
                  "set a parameter, e.g. damper.normal_load=3; overrides its values in for_each, cases and "
                  "scatter; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME.FIELD=VALUE");
  verb.add_option("--harmonics", texts.harmonics, "highest harmonic of the harmonic balance")->type_name("N");
  verb.add_option("--accuracy", texts.accuracy,
                  "relative accuracy of amplitudes, by which studies choose the highest harmonic")
      ->type_name("E");
}

/// Keeps a reference to `of`, which must stay valid.
void add_key_option(CLI::App& verb, KeyOption& of) {
  CLI::Option* option = verb.add_option(of.name(), of.texts, of.help());
  option->type_name(of.type_name())->allow_extra_args(false);  // what follows may be the scene
  if (of.key.type == scene::KeyType::window)
    option->expected(2);
  else if (of.key.type == scene::KeyType::parameters)
    option->expected(1)->take_all();
  else
    option->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::Throw);
}

void add_running_options(CLI::App& verb, CommandOptions& options, Texts& texts) {
  verb.add_option("--threads", texts.threads,
                  "threads for combinations, load cases of an optimum, and elements of a response (default: "
                  "as many as there are processors)")
      ->type_name("N");
  verb.add_flag("--quiet", options.quiet, "print only errors, no progress and no notes");
}

void add_study_options(CLI::App& verb, Verb& of, CommandOptions& options, Texts& texts) {
  for (KeyOption& option : of.keys) add_key_option(verb, option);
  verb.add_option("--out", options.out,
                  std::string("folder for results and figures (default: ") +
                      (of.name == run_verb ? "out/<name of the scene file>)" : "none are written)"))
      ->type_name("DIR");
  verb.add_option("--json", options.json, "write results as JSON to a file, or - for standard output")
      ->type_name("FILE|-");
  verb.add_option("--csv", options.csv,
                  "write results as CSV to a file, with events and a summary in further files (a.events.csv, "
                  "a.summary.csv), or - for standard output")
      ->type_name("FILE|-");
  verb.add_option("--report", options.report,
                  std::string("write results as a page for a browser, in one file (default: ") +
                      (of.name == run_verb ? "report.html in the folder for results)" : "none is written)"))
      ->type_name("FILE");
  if (of.type == nullptr || studies::kind_of(*of.type).takes_coefficients()) {
    verb.add_flag("--coefficients", options.coefficients,
                  "include the Fourier coefficients of each response in JSON");
  }
  verb.add_option("--combinations", texts.combinations,
                  "maximum number of combinations of the values in for_each (default: " +
                      std::to_string(scene::usual_combinations) + ")")
      ->type_name("N");
  add_running_options(verb, options, texts);
}

void add_options(CLI::App& verb, Verb& of, CommandOptions& options, Texts& texts) {
  if (of.type != nullptr) of.keys = options_of(of.type->keys());
  if (of.name == merge_verb) return add_merge_options(verb, options);
  add_scene_options(verb, options, texts);
  if (of.name == ensemble_verb) {
    add_ensemble_options(verb, options);
    add_running_options(verb, options, texts);
  } else if (of.name == reduce_verb) {
    verb.add_option("--out", options.out,
                    "folder for the matrices and the scene (default: out/<name of the scene file>_reduced)")
        ->type_name("DIR");
    verb.add_flag("--quiet", options.quiet, "print only errors");
  } else if (of.name == check_verb) {
    verb.add_flag("--quiet", options.quiet, "print nothing if the scene is valid");
  } else {
    add_study_options(verb, of, options, texts);
  }
}

/// The number given for a key by an option, if any.
std::optional<double> number_of(const CommandOptions& options, const std::string& key) {
  for (const GivenKey& given : options.keys) {
    const auto* node = std::get_if<scene::file::Node>(&given.value);
    if (given.key.name == key && node != nullptr && node->get<double>() != nullptr)
      return *node->get<double>();
  }
  return std::nullopt;
}

bool given(const CLI::App& verb, const std::string& option) {
  const CLI::Option* found = verb.get_option_no_throw(option);
  return found != nullptr && found->count() > 0;
}

void check_consistent(const CommandOptions& options, const CLI::App& verb) {
  for (const auto& [option, path] : {std::pair{"--json", &options.json},
                                     {"--csv", &options.csv},
                                     {"--out", &options.out},
                                     {"--report", &options.report}})
    if (given(verb, option) && path->empty())
      throw UsageError("--out, --json, --csv and --report need a nonempty name");
  if (options.report == "-")
    throw UsageError("--report needs the name of a file: a page does not go to standard output");
  if (!options.json.empty() && options.json == options.csv) {
    throw UsageError("--json and --csv both go to " +
                     (options.json == "-" ? "standard output" : options.json) +
                     ": choose another path for one of them");
  }
  const auto from = number_of(options, "from"), to = number_of(options, "to");
  if (from && to && !(*from < *to)) {
    throw UsageError("--from must be below --to; found --from " + results::shortest(*from) + " and --to " +
                     results::shortest(*to));
  }
}

void check_values_given(const CLI::App& verb, const Texts& texts) {
  for (const auto& [option, text] : {std::pair{"--harmonics", &texts.harmonics},
                                     {"--accuracy", &texts.accuracy},
                                     {"--combinations", &texts.combinations},
                                     {"--threads", &texts.threads}})
    if (given(verb, option) && text->empty()) throw UsageError(std::string(option) + ": found no value");
}

/// Reads the texts of the verb's options into their values.
void read_texts(const CLI::App& verb, const Verb& of, const Texts& texts, CommandOptions& options) {
  for (const std::string& text : texts.set) options.set.push_back(assignment(text));
  options.harmonics = whole_number("--harmonics", texts.harmonics, "a whole number, the highest harmonic");
  options.accuracy = accuracy(texts.accuracy);
  options.combinations =
      whole_number("--combinations", texts.combinations, "a whole number, the combinations at most");
  options.threads = whole_number("--threads", texts.threads, "a whole number, the threads");
  if (options.threads && (*options.threads < 1 || *options.threads > most_threads))
    throw UsageError("--threads " + texts.threads + ": must be an integer from 1 to " +
                     std::to_string(most_threads));
  for (const KeyOption& option : of.keys)
    if (given(verb, option.name())) options.keys.push_back(option.given());
}

}  // namespace

std::variant<CommandOptions, Information> parse(int argc, const char* const* argv,
                                                const scene::Catalogue& catalogue) {
  const std::string hint = "Run arcslip --help for the verbs, arcslip VERB --help for their options.";
  CommandOptions options;
  Texts texts;
  CLI::App app("Responses of vibrating structures with friction and other nonlinear elements.", "arcslip");
  app.require_subcommand(1);
  app.set_version_flag("--version", "arcslip " + std::string(results::version()), "print the version");
  app.set_help_flag("--help,-h", "print this help");
  app.get_formatter()->label("SUBCOMMAND", "VERB SCENE");
  app.footer(std::string(exit_codes) + "\nRun arcslip VERB --help for the options of a verb.");

  std::vector<Verb> verbs = verbs_of(catalogue);
  std::map<const CLI::App*, const Verb*> verb_of;
  for (Verb& each : verbs) {
    CLI::App* verb = app.add_subcommand(each.name, each.help);
    verb->group("Verbs");
    verb_of.emplace(verb, &each);
    if (argc >= 2 && each.name == argv[1]) add_options(*verb, each, options, texts);  // no others are needed
  }

  CLI::App* const schema = app.add_subcommand("schema", "print the JSON Schema of scene files, for editors");
  schema->group("Verbs");

  if (argc < 2)
    throw UsageError("no verb given. Give a verb and a scene, as in arcslip run scene.json\n" + hint);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion& version) {
    return Information{std::string(version.what()) + "\n"};
  } catch (const CLI::CallForHelp&) {
    return Information{app.help()};
  } catch (const CLI::ParseError& error) {
    const std::string first = argv[1];
    if (app.get_subcommands().empty() && !first.empty() && first.front() != '-') {
      throw UsageError("unknown verb \"" + results::visible(first) + "\", must be " + names_of(verbs) + "\n" +
                       hint);
    }
    throw UsageError(results::visible(error.what()) + "\n" + hint);
  }
  const CLI::App* verb = app.get_subcommands().front();
  check_values_given(*verb, texts);
  if (verb == schema) return Information{scene::json_schema(catalogue)};
  const Verb& chosen = *verb_of.at(verb);
  options.verb = chosen.name;
  options.type = chosen.type;
  read_texts(*verb, chosen, texts, options);
  check_consistent(options, *verb);
  return options;
}

}  // namespace arcslip::app
