#include "options.hpp"

#include <arcslip/output/units.hpp>
#include <arcslip/output/version.hpp>

#include <CLI/CLI.hpp>

#include <charconv>
#include <cmath>

namespace arcslip::app {
namespace {

constexpr std::string_view exit_codes =
    "Exit codes: 0 done, 1 usage or file, 2 invalid scene, 3 stopped early with partial results written.";

/// The whole text as a finite number, or nothing.
std::optional<double> number(const std::string& text) {
  const char* begin = text.data();
  const char* const end = begin + text.size();
  begin += begin != end && *begin == '+' ? 1 : 0;
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  return error == std::errc() && stop == end && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::pair<std::string, double> assignment(const std::string& text) {
  const auto equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0) {
    throw UsageError("--set " + text + ": give it as name.field=value, such as --set damper.normal_load=3");
  }
  const std::string value = text.substr(equals + 1);
  if (const auto parsed = number(value)) {
    return {text.substr(0, equals), *parsed};
  }
  throw UsageError("--set " + text + ": found the value \"" + value + "\", must be a finite number");
}

/// What the parser keeps as text until all of it is read.
struct Texts {
  std::vector<std::string> set;
  std::string harmonics, from, to;
};

std::optional<double> frequency(const std::string& option, const std::string& text) {
  if (text.empty()) {
    return std::nullopt;
  }
  const auto value = number(text);
  if (!value || *value <= 0) {
    throw UsageError(option + " " + text + ": must be a frequency above 0, a finite number");
  }
  return value;
}

std::optional<int> harmonics(const std::string& text) {
  if (text.empty()) {
    return std::nullopt;
  }
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size()) {
    throw UsageError("--harmonics " + text + ": must be a whole number, the highest harmonic");
  }
  return value;
}

CLI::App* add_verb(CLI::App& app, const std::string& name, const std::string& help, Options& options,
                   Texts& texts) {
  CLI::App* verb = app.add_subcommand(name, help);
  verb->add_option("SCENE", options.scene, "scene file (JSON, format arcslip-scene-1)")
      ->required()
      ->type_name("");
  verb->group("Verbs");
  verb->footer(std::string(exit_codes));
  verb->add_option(
          "--set", texts.set,
          "give a parameter a value, as damper.normal_load=3; replaces its list in for_each; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME.FIELD=VALUE");
  verb->add_option("--harmonics", texts.harmonics, "highest harmonic of the balance")->type_name("N");
  return verb;
}

void add_study_options(CLI::App& verb, Options& options, Texts& texts) {
  verb.add_option("--from", texts.from, "first frequency, in the scene's unit")->type_name("A");
  verb.add_option("--to", texts.to, "last frequency, in the scene's unit")->type_name("B");
  verb.add_option("--json", options.json, "results as JSON into a file, or - for standard output")
      ->type_name("FILE|-");
  verb.add_option("--csv", options.csv, "results as CSV into a file, or - for standard output")
      ->type_name("FILE|-");
  verb.add_flag("--coefficients", options.coefficients, "JSON with the harmonics of each response");
  verb.add_flag("--quiet", options.quiet, "no progress and no notes, only errors");
}

void check_consistent(const Options& options, bool json_given, bool csv_given, bool out_given) {
  if ((json_given && options.json.empty()) || (csv_given && options.csv.empty()) ||
      (out_given && options.out.empty())) {
    throw UsageError("--out, --json and --csv need a name that is not empty");
  }
  if (!options.json.empty() && options.json == options.csv) {
    throw UsageError("--json and --csv both go to " +
                     (options.json == "-" ? "standard output" : options.json) +
                     ": give one of them another place");
  }
  if (options.from && options.to && !(*options.from < *options.to)) {
    throw UsageError("--from must be below --to; found --from " + output::shortest(*options.from) +
                     " and --to " + output::shortest(*options.to));
  }
}

bool given(const CLI::App& verb, const std::string& option) {
  const CLI::Option* found = verb.get_option_no_throw(option);
  return found != nullptr && found->count() > 0;
}

}  // namespace

std::variant<Options, Information> parse(int argc, const char* const* argv) {
  const std::string hint = "Run arcslip --help for the verbs, arcslip VERB --help for their options.";
  Options options;
  Texts texts;
  CLI::App app("Frequency responses of vibrating structures with friction and other nonlinear elements.",
               "arcslip");
  app.require_subcommand(1);
  app.set_version_flag("--version", "arcslip " + std::string(output::version()), "print the version");
  app.set_help_flag("--help,-h", "print this help");
  app.get_formatter()->label("SUBCOMMAND", "VERB SCENE");
  app.footer(std::string(exit_codes) + "\narcslip VERB --help tells the options of a verb.");

  CLI::App* run = add_verb(app, "run", "every study of the scene: results and figures", options, texts);
  CLI::App* frf = add_verb(app, "frf", "frequency responses, with their peaks and folds", options, texts);
  CLI::App* check =
      add_verb(app, "check", "validate; print the resolved scene with every default", options, texts);
  run->add_option("--out", options.out,
                  "folder for results and figures (default: out/<name of the scene file>)")
      ->type_name("DIR");
  frf->add_option("--out", options.out, "folder for results and figures (default: none are written)")
      ->type_name("DIR");
  add_study_options(*run, options, texts);
  add_study_options(*frf, options, texts);
  check->add_flag("--quiet", options.quiet, "print nothing if the scene is valid");

  if (argc < 2) {
    throw UsageError("what shall be done? Give a verb and a scene, as in arcslip run scene.json\n" + hint);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion& version) {
    return Information{std::string(version.what()) + "\n"};
  } catch (const CLI::CallForHelp&) {
    return Information{app.help()};
  } catch (const CLI::ParseError& error) {
    const std::string first = argv[1];
    if (app.get_subcommands().empty() && !first.empty() && first.front() != '-') {
      throw UsageError("unknown verb \"" + first + "\", must be run, frf or check\n" + hint);
    }
    throw UsageError(std::string(error.what()) + "\n" + hint);
  }
  const CLI::App* verb = app.get_subcommands().front();
  options.verb = verb == run ? Verb::run : verb == frf ? Verb::frf : Verb::check;
  for (const std::string& text : texts.set) {
    options.set.push_back(assignment(text));
  }
  options.harmonics = harmonics(texts.harmonics);
  options.from = frequency("--from", texts.from);
  options.to = frequency("--to", texts.to);
  check_consistent(options, given(*verb, "--json"), given(*verb, "--csv"), given(*verb, "--out"));
  return options;
}

}  // namespace arcslip::app
