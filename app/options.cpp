#include "options.hpp"

#include <arcslip/output/units.hpp>
#include <arcslip/output/version.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>

namespace arcslip::app {
namespace {

constexpr std::string_view exit_codes =
    "Exit codes: 0 done, 1 usage or file, 2 invalid scene, 3 stopped early with partial results written.";

struct VerbText {
  Verb verb;
  const char* name;
  const char* help;
};

constexpr std::array<VerbText, 8> verb_texts{{
    {Verb::run, "run", "every study of the scene: results and figures"},
    {Verb::frf, "frf", "frequency responses, with their peaks and folds"},
    {Verb::trace, "trace", "responses over a parameter at a fixed frequency, with their extremes and folds"},
    {Verb::peaks, "peaks", "resonance peaks over a parameter, with the least and the greatest"},
    {Verb::folds, "folds", "folds of the frequency response over a parameter, with their cusps"},
    {Verb::time, "time", "motions in time at one frequency: steady, or from rest, with their loops"},
    {Verb::optimize, "optimize", "the values of parameters for which the highest resonance peak is least"},
    {Verb::check, "check", "validate; print the resolved scene with every default"},
}};

std::string verb_names() {
  std::string names;
  for (const VerbText& text : verb_texts) {
    names.append(&text == &verb_texts.back() ? " or " : names.empty() ? "" : ", ").append(text.name);
  }
  return names;
}

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
  std::vector<std::string> set, frequency, design;
  std::string harmonics, from, to;
  std::string steps, periods, recorded, tolerance, method;
};

/// --from or --to of a study over a parameter.
std::optional<double> parameter_value(const std::string& option, const std::string& text) {
  const auto value = number(text);
  if (!text.empty() && !value) {
    throw UsageError(option + " " + text + ": must be a value of the parameter, a finite number");
  }
  return value;
}

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

std::optional<int> whole_number(const std::string& option, const std::string& text, const std::string& what) {
  if (text.empty()) {
    return std::nullopt;
  }
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size()) {
    throw UsageError(option + " " + text + ": must be a whole number, " + what);
  }
  return value;
}

std::optional<double> tolerance(const std::string& text) {
  const auto value = number(text);
  if (!text.empty() && !value) {
    throw UsageError("--tolerance " + text + ": must be a finite number from 0 to 1");
  }
  return value;
}

std::optional<scene::TimeMethod> method(const std::string& text) {
  const auto found = scene::method_of(text);
  if (!text.empty() && !found) {
    throw UsageError("--method " + text + ": must be shooting, newmark-shooting, newmark or event-driven");
  }
  return found;
}

CLI::App* add_verb(CLI::App& app, const VerbText& text, Options& options, Texts& texts) {
  CLI::App* verb = app.add_subcommand(text.name, text.help);
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

/// What a study over a parameter takes from the scene's first study of its kind, or from here.
void add_range_over_parameter(CLI::App& verb, Verb kind, Options& options, Texts& texts) {
  verb.add_option("--over", options.over, "the parameter that is varied, as damper.normal_load")
      ->type_name("NAME.FIELD");
  verb.add_option("--from", texts.from, "first value of the parameter, in its unit")->type_name("A");
  verb.add_option("--to", texts.to, "last value of the parameter")->type_name("B");
  verb.add_option("--frequency", texts.frequency,
                  kind == Verb::trace ? "the frequency, in the scene's unit"
                                      : "the window of frequencies, lower and upper, in the scene's unit")
      ->expected(kind == Verb::trace ? 1 : 2)
      ->allow_extra_args(false)  // what follows may be the scene
      ->type_name("F");
}

void add_time_options(CLI::App& verb, Texts& texts) {
  const scene::TimeSettings usual;
  verb.add_option("--frequency", texts.frequency, "the frequency of the excitation, in the scene's unit")
      ->expected(1)
      ->allow_extra_args(false)  // what follows may be the scene
      ->type_name("F");
  verb.add_option("--method", texts.method,
                  "shooting (the periodic motion, exact where the scene is piecewise linear; the default), "
                  "newmark-shooting, or period by period from rest: newmark, event-driven")
      ->type_name("M");
  verb.add_option("--steps", texts.steps, "steps per period (default: " + std::to_string(usual.steps) + ")")
      ->type_name("S");
  verb.add_option("--periods", texts.periods,
                  "periods of a transient at most (default: " + std::to_string(usual.periods) + ")")
      ->type_name("P");
  verb.add_option("--recorded", texts.recorded,
                  "periods with history, at the end (default: " + std::to_string(usual.recorded) + ")")
      ->type_name("R");
  verb.add_option(
          "--tolerance", texts.tolerance,
          "of the state: change over a period that is steady, or last correction of shooting (default: " +
              output::shortest(usual.tolerance) + "); 0: no transient ends before --periods")
      ->type_name("T");
}

void add_design(CLI::App& verb, Options& options, Texts& texts) {
  verb.add_option(
          "--over", texts.design,
          "a parameter that is chosen, with its bounds, as damper.normal_load=0.1:100; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME.FIELD[=A:B]");
  verb.add_option("--frequency", texts.frequency,
                  "the window of frequencies, lower and upper, in the scene's unit")
      ->expected(2)
      ->allow_extra_args(false)
      ->type_name("F");
  verb.add_option("--algorithm", options.algorithm, "an algorithm of NLopt, by its own name, as LD_SLSQP")
      ->type_name("NAME");
}

DesignRange design_range(const std::string& text) {
  const auto equals = text.find('=');
  const std::string name = text.substr(0, equals);
  if (name.empty()) {
    throw UsageError("--over " + text + ": give it as name.field or name.field=lower:upper");
  }
  if (equals == std::string::npos) {
    return {name, std::nullopt};
  }
  const std::string bounds = text.substr(equals + 1);
  const auto colon = bounds.find(':');
  const auto lower = number(bounds.substr(0, colon));
  const auto upper = colon == std::string::npos ? std::nullopt : number(bounds.substr(colon + 1));
  if (!lower || !upper) {
    throw UsageError("--over " + text + ": found the bounds \"" + bounds +
                     "\", must be two finite numbers, lower:upper");
  }
  return {name, std::pair(*lower, *upper)};
}

void add_study_options(CLI::App& verb, Verb kind, Options& options, Texts& texts) {
  if (kind == Verb::run || kind == Verb::frf) {
    const std::string of = kind == Verb::run ? " of frequency responses" : "";
    verb.add_option("--from", texts.from, "first frequency" + of + ", in the scene's unit")->type_name("A");
    verb.add_option("--to", texts.to, "last frequency" + of + ", in the scene's unit")->type_name("B");
  } else if (kind == Verb::time) {
    add_time_options(verb, texts);
  } else if (kind == Verb::optimize) {
    add_design(verb, options, texts);
  } else {
    add_range_over_parameter(verb, kind, options, texts);
  }
  verb.add_option("--out", options.out,
                  std::string("folder for results and figures (default: ") +
                      (kind == Verb::run ? "out/<name of the scene file>)" : "none are written)"))
      ->type_name("DIR");
  verb.add_option("--json", options.json, "results as JSON into a file, or - for standard output")
      ->type_name("FILE|-");
  verb.add_option("--csv", options.csv, "results as CSV into a file, or - for standard output")
      ->type_name("FILE|-");
  if (kind != Verb::time) {
    verb.add_flag("--coefficients", options.coefficients, "JSON with the harmonics of each response");
  }
  verb.add_flag("--quiet", options.quiet, "no progress and no notes, only errors");
}

std::vector<double> frequencies(const std::vector<std::string>& texts) {
  std::vector<double> values;
  for (const std::string& text : texts) {
    values.push_back(frequency("--frequency", text).value());
  }
  if (values.size() == 2 && !(values[0] < values[1])) {
    throw UsageError("--frequency " + texts[0] + " " + texts[1] +
                     ": must be a window, the lower frequency before the upper one");
  }
  return values;
}

void check_consistent(const Options& options, bool json_given, bool csv_given, bool out_given,
                      bool over_given) {
  if ((json_given && options.json.empty()) || (csv_given && options.csv.empty()) ||
      (out_given && options.out.empty())) {
    throw UsageError("--out, --json and --csv need a name that is not empty");
  }
  if (over_given && options.over.empty() && options.design.empty()) {
    throw UsageError("--over needs the name of a parameter, such as --over damper.normal_load");
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

std::string name(Verb verb) {
  const auto* const text = std::find_if(verb_texts.begin(), verb_texts.end(),
                                        [&](const VerbText& each) { return each.verb == verb; });
  return text->name;
}

std::variant<Options, Information> parse(int argc, const char* const* argv) {
  const std::string hint = "Run arcslip --help for the verbs, arcslip VERB --help for their options.";
  Options options;
  Texts texts;
  CLI::App app("Responses of vibrating structures with friction and other nonlinear elements.", "arcslip");
  app.require_subcommand(1);
  app.set_version_flag("--version", "arcslip " + std::string(output::version()), "print the version");
  app.set_help_flag("--help,-h", "print this help");
  app.get_formatter()->label("SUBCOMMAND", "VERB SCENE");
  app.footer(std::string(exit_codes) + "\narcslip VERB --help tells the options of a verb.");

  std::map<const CLI::App*, Verb> verbs;
  for (const VerbText& text : verb_texts) {
    CLI::App* verb = add_verb(app, text, options, texts);
    verbs.emplace(verb, text.verb);
    if (text.verb == Verb::check) {
      verb->add_flag("--quiet", options.quiet, "print nothing if the scene is valid");
    } else {
      add_study_options(*verb, text.verb, options, texts);
    }
  }

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
      throw UsageError("unknown verb \"" + first + "\", must be " + verb_names() + "\n" + hint);
    }
    throw UsageError(std::string(error.what()) + "\n" + hint);
  }
  const CLI::App* verb = app.get_subcommands().front();
  options.verb = verbs.at(verb);
  for (const std::string& text : texts.set) {
    options.set.push_back(assignment(text));
  }
  options.harmonics = whole_number("--harmonics", texts.harmonics, "the highest harmonic");
  options.steps = whole_number("--steps", texts.steps, "the steps per period");
  options.periods = whole_number("--periods", texts.periods, "the periods of a transient at most");
  options.recorded = whole_number("--recorded", texts.recorded, "the periods with history");
  options.tolerance = tolerance(texts.tolerance);
  options.method = method(texts.method);
  for (const std::string& text : texts.design) {
    options.design.push_back(design_range(text));
  }
  const bool of_frequency = options.verb == Verb::run || options.verb == Verb::frf;
  options.from = of_frequency ? frequency("--from", texts.from) : parameter_value("--from", texts.from);
  options.to = of_frequency ? frequency("--to", texts.to) : parameter_value("--to", texts.to);
  options.frequency = frequencies(texts.frequency);
  check_consistent(options, given(*verb, "--json"), given(*verb, "--csv"), given(*verb, "--out"),
                   given(*verb, "--over"));
  return options;
}

}  // namespace arcslip::app
