#include "options.hpp"

#include "option_values.hpp"

#include <arcslip/results/text.hpp>
#include <arcslip/results/version.hpp>
#include <arcslip/scene/combinations.hpp>
#include <arcslip/studies/units.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
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

/// What the parser keeps as text until all of it is read.
struct Texts {
  std::vector<std::string> set, frequency, design;
  std::string harmonics, from, to, combinations;
  std::string steps, periods, recorded, tolerance, method;
  std::string along, criterion, evaluations, seconds;
};

CLI::App* add_verb(CLI::App& app, const VerbText& text, Options& options, Texts& texts) {
  CLI::App* verb = app.add_subcommand(text.name, text.help);
  verb->add_option("SCENE", options.scene, "scene file (JSON, format arcslip-scene-1)")
      ->required()
      ->type_name("");
  verb->group("Verbs");
  verb->footer(std::string(exit_codes));
  verb->add_option("--set", texts.set,
                   "give a parameter a value, as damper.normal_load=3; replaces its values in for_each, "
                   "cases and scatter; may "
                   "be repeated")
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
              results::shortest(usual.tolerance) + "); 0: no transient ends before --periods")
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
  verb.add_option("--along", texts.along,
                  "a parameter over which the optimum is followed, with its range, as force.cosine=1:8")
      ->type_name("NAME.FIELD=A:B");
  verb.add_option(
          "--criterion", texts.criterion,
          "what is to be least of the study's cases: the worst of their amplitudes (the default), or their "
          "mean")
      ->type_name("C");
  verb.add_option("--algorithm", options.algorithm,
                  "an algorithm of NLopt, by its own name (default: LD_SLSQP)")
      ->type_name("NAME");
  verb.add_option("--local", options.local, "the algorithm inside MLSL and AUGLAG, as LN_BOBYQA")
      ->type_name("NAME");
  const scene::SearchSettings usual;
  verb.add_option("--evaluations", texts.evaluations,
                  "designs to be looked at, at most (default: " + std::to_string(usual.evaluations) + ")")
      ->type_name("N");
  verb.add_option("--seconds", texts.seconds, "time for the search, at most; 0, the default: no limit")
      ->type_name("S");
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
  verb.add_option(
          "--csv", options.csv,
          "results as CSV into a file, with events and a summary beside it (a.events.csv, a.summary.csv), or "
          "- for standard output")
      ->type_name("FILE|-");
  if (kind != Verb::time) {
    verb.add_flag("--coefficients", options.coefficients, "JSON with the harmonics of each response");
  }
  verb.add_option("--combinations", texts.combinations,
                  "combinations of the values in for_each, at most (default: " +
                      std::to_string(scene::usual_combinations) + ")")
      ->type_name("N");
  verb.add_flag("--quiet", options.quiet, "no progress and no notes, only errors");
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
    throw UsageError("--from must be below --to; found --from " + results::shortest(*options.from) +
                     " and --to " + results::shortest(*options.to));
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
  app.set_version_flag("--version", "arcslip " + std::string(results::version()), "print the version");
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
      throw UsageError("unknown verb \"" + results::visible(first) + "\", must be " + verb_names() + "\n" +
                       hint);
    }
    throw UsageError(results::visible(error.what()) + "\n" + hint);
  }
  const CLI::App* verb = app.get_subcommands().front();
  options.verb = verbs.at(verb);
  for (const std::string& text : texts.set) {
    options.set.push_back(assignment(text));
  }
  options.harmonics = whole_number("--harmonics", texts.harmonics, "the highest harmonic");
  options.combinations = whole_number("--combinations", texts.combinations, "the combinations at most");
  options.steps = whole_number("--steps", texts.steps, "the steps per period");
  options.periods = whole_number("--periods", texts.periods, "the periods of a transient at most");
  options.recorded = whole_number("--recorded", texts.recorded, "the periods with history");
  options.tolerance = number("--tolerance", texts.tolerance, "a finite number from 0 to 1");
  options.method = method(texts.method);
  for (const std::string& text : texts.design) {
    options.design.push_back(design_range("--over", text));
  }
  if (given(*verb, "--along")) {
    options.along = design_range("--along", texts.along);
  }
  options.criterion = criterion(texts.criterion);
  options.evaluations = whole_number("--evaluations", texts.evaluations, "the designs to be looked at");
  options.seconds = number("--seconds", texts.seconds, "a finite number of seconds");
  const bool of_frequency = options.verb == Verb::run || options.verb == Verb::frf;
  const std::string value = "a value of the parameter, a finite number";
  options.from = of_frequency ? frequency("--from", texts.from) : number("--from", texts.from, value);
  options.to = of_frequency ? frequency("--to", texts.to) : number("--to", texts.to, value);
  options.frequency = frequencies(texts.frequency);
  check_consistent(options, given(*verb, "--json"), given(*verb, "--csv"), given(*verb, "--out"),
                   given(*verb, "--over"));
  return options;
}

}  // namespace arcslip::app
