#include "options.hpp"

#include "ensembles.hpp"
#include "key_options.hpp"
#include "new_scene.hpp"
#include "option_values.hpp"

#include <arcslip/results/text.hpp>
#include <arcslip/results/version.hpp>
#include <arcslip/scene/combinations.hpp>
#include <arcslip/scene/format/json_schema.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace arcslip::app {
namespace {

constexpr std::string_view exit_codes =
    "Exit codes: 0 done, 1 usage or file, 2 invalid scene, 3 stopped early with partial results written.";

constexpr const char *run_verb = "run", *check_verb = "check", *reduce_verb = "reduce", *new_verb = "new",
                     *schema_verb = "schema";
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

/// "a, b or c; did you mean b?"
std::string one_of(const std::vector<std::string>& names, const std::string& word) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text.append(i == 0 ? "" : i + 1 == names.size() ? " or " : ", ").append(names[i]);
  const std::string near = scene::nearest(word, names);
  return text + (near.empty() ? "" : "; did you mean " + near + "?");
}

std::vector<std::string> names_of(const std::vector<Verb>& verbs) {
  std::vector<std::string> names;
  for (const Verb& verb : verbs) names.push_back(verb.name);
  names.insert(names.end(), {new_verb, schema_verb});
  return names;
}

/// Names the nearest option for one that the verb does not have.
std::string hint_of_option(const CLI::App& verb, int argc, const char* const* argv) {
  std::vector<std::string> known;
  for (const CLI::Option* option : verb.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (int i = 2; i < argc; ++i) {
    std::string word = argv[i];
    word = word.substr(0, word.find('='));
    if (!word.starts_with("--") || std::find(known.begin(), known.end(), word) != known.end()) continue;
    const std::string near = scene::nearest(word, known);
    return near.empty() ? "" : "; did you mean " + near + "?";
  }
  return "";
}

/// Option values kept as text until parsing is complete.
struct Texts {
  std::vector<std::string> set;
  std::string harmonics, accuracy, combinations, threads, columns, events;
  std::map<std::string, std::string> numbers{};  // of a new scene, by their options
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
  if (of.is_flag()) {
    verb.add_flag(of.names() + "{true}", of.texts, of.help() + "; as --" + of.key.name + ", or with =VALUE")
        ->multi_option_policy(CLI::MultiOptionPolicy::Throw);
    return;
  }
  CLI::Option* option = verb.add_option(of.names(), of.texts, of.help());
  option->type_name(of.type_name())->allow_extra_args(false);  // what follows may be the scene
  if (of.key.type == scene::KeyType::window)
    option->expected(2);
  else if (of.key.type == scene::KeyType::parameters || of.key.name == "for_each")
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
  verb.add_option(
          "--columns", texts.columns,
          "columns of the table on standard output and of --csv, as frequency,amplitude (default: a few "
          "on standard output, all in --csv)")
      ->type_name("NAME,NAME...");
  verb.add_option("--events", texts.events,
                  "kinds of events in these tables, as peak,fold, or none (default: all)")
      ->type_name("KIND,KIND...");
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

/// The options of a kind of new scene.
void add_new_options(CLI::App& app, const NewKind& kind, CommandOptions& options, Texts& texts) {
  for (const std::string& file : kind.files)
    app.add_option(file, options.new_texts[file], "matrix, in a format of a scene")
        ->required()
        ->type_name("");
  for (const NewNumber& number : kind.numbers) {
    const std::string unit = number.unit.empty() || number.unit == "-" ? "" : ", " + number.unit;
    const bool has_default = std::isfinite(number.otherwise);
    app.add_option("--" + number.name, texts.numbers[number.name],
                   number.help + unit +
                       (has_default ? " (default: " + results::shortest(number.otherwise) + ")" : ""))
        ->type_name("X");
  }
  for (const NewText& text : kind.texts)
    app.add_option("--" + text.name, options.new_texts[text.name], text.help)->type_name(text.value_name);
  app.add_option("--out", options.out, "file to write, which must not exist (default: standard output)")
      ->type_name("FILE");
  app.footer(std::string(exit_codes));
}

/// Returns the kind that is asked for.
CLI::App* add_new_verb(CLI::App& app, int argc, const char* const* argv, CommandOptions& options,
                       Texts& texts) {
  CLI::App* verb = app.add_subcommand(new_verb, "write a scene to begin with, with comments and studies");
  verb->group("Verbs");
  verb->require_subcommand(1);
  verb->get_formatter()->label("SUBCOMMAND", "KIND");
  verb->footer("Run arcslip new KIND --help for the numbers of a kind.");
  for (const NewKind& kind : new_kinds()) {
    CLI::App* of = verb->add_subcommand(kind.name, kind.help);
    of->group("Kinds");
    if (argc >= 3 && argv[1] == std::string(new_verb) && argv[2] == kind.name)
      add_new_options(*of, kind, options, texts);
  }
  return verb;
}

void read_new(const CLI::App& of, const Texts& texts, CommandOptions& options) {
  options.verb = new_verb;
  options.new_kind = of.get_name();
  std::erase_if(options.new_texts, [](const auto& text) { return text.second.empty(); });
  const auto& kinds = new_kinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                 [&](const NewKind& each) { return each.name == options.new_kind; });
  for (const NewNumber& number : kind->numbers) {
    if (of.get_option("--" + number.name)->count() == 0) continue;
    const std::string allowed =
        std::string("a number ") + (number.lower_open ? "above 0" : "of at least 0") +
        (std::isfinite(number.upper) ? ", at most " + results::shortest(number.upper) : "");
    const std::string& text = texts.numbers.at(number.name);
    const auto value = app::number("--" + number.name, text, allowed);
    if (!value || *value < 0 || (number.lower_open && *value == 0) || *value > number.upper)
      throw UsageError("--" + number.name + " " + text + ": must be " + allowed);
    options.new_numbers.emplace(number.name, *value);
  }
  if (of.get_option("--out")->count() > 0 && options.out.empty())
    throw UsageError("--out needs a nonempty name");
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
                                     {"--threads", &texts.threads},
                                     {"--columns", &texts.columns},
                                     {"--events", &texts.events}})
    if (given(verb, option) && text->empty()) throw UsageError(std::string(option) + ": found no value");
}

/// "a,b" as a list.
std::vector<std::string> names_in(const std::string& option, const std::string& text) {
  std::vector<std::string> names(text.empty() ? 0 : 1);
  for (const char c : text)
    if (c == ',')
      names.emplace_back();
    else
      names.back() += c;
  if (std::find(names.begin(), names.end(), "") != names.end())
    throw UsageError(option + " " + text + ": must be names with commas between them");
  return names;
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
  options.columns = names_in("--columns", texts.columns);
  options.events = names_in("--events", texts.events);
  for (const KeyOption& option : of.keys)
    if (given(verb, option.name())) options.keys.push_back(option.given());
}

[[noreturn]] void throw_kind(int argc, const char* const* argv) {
  std::vector<std::string> names;
  for (const NewKind& kind : new_kinds()) names.push_back(kind.name);
  const std::string word = argc > 2 ? argv[2] : "";
  throw UsageError(word.empty() ? "new needs a kind of scene: " + one_of(names, "")
                                : "unknown kind of scene \"" + results::visible(word) + "\", must be " +
                                      one_of(names, word));
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

  CLI::App* const fresh = add_new_verb(app, argc, argv, options, texts);
  CLI::App* const schema =
      app.add_subcommand(schema_verb, "print the JSON Schema of scene files, for editors");
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
      throw UsageError("unknown verb \"" + results::visible(first) + "\", must be " +
                       one_of(names_of(verbs), first) + "\n" + hint);
    }
    if (first == new_verb && fresh->get_subcommands().empty()) throw_kind(argc, argv);
    const CLI::App* parsed = app.get_subcommands().empty() ? &app : app.get_subcommands().front();
    if (parsed == fresh) parsed = fresh->get_subcommands().front();
    throw UsageError(results::visible(error.what() + hint_of_option(*parsed, argc, argv)) + "\n" + hint);
  }
  const CLI::App* verb = app.get_subcommands().front();
  if (verb == fresh) {
    read_new(*verb->get_subcommands().front(), texts, options);
    return options;
  }
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
