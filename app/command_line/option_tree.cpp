#include "option_tree.hpp"

#include "../ensembles.hpp"
#include "../new_scene.hpp"

#include <arcslip/results/text.hpp>
#include <arcslip/results/version.hpp>
#include <arcslip/scene/combinations.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <cmath>

namespace arcslip::app {
namespace {

constexpr std::string_view exit_codes =
    "Exit codes: 0 done, 1 usage or file, 2 invalid scene, 3 stopped early with partial results written, "
    "4 compare found differences.";

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
    key.help.insert(key.help.find(','), " of frequency responses");
    verbs.front().keys.push_back({key});
  }
  verbs.push_back({ensemble_verb, "compute many samples of a study into one file, and go on where it ended"});
  verbs.push_back({merge_verb, "join the files of parts of an ensemble"});
  verbs.push_back({reduce_verb, "write the reduced structure of the scene, and the scene with it"});
  verbs.push_back({check_verb, "validate the scene and print it with every default"});
  return verbs;
}

/// The options of every verb that takes a scene.
void add_scene_options(CLI::App& verb, CommandOptions& options, Texts& texts) {
  verb.add_option("SCENE", options.scene, "scene file (JSON, format arcslip-scene-2)")
      ->required()
      ->type_name("");
  verb.footer(std::string(exit_codes));
  verb.add_option(
          "--set", texts.set,
          "set a parameter, e.g. damper.normal_load=3, \"m=800 g\" or \"damper.stiffness=0.12*k\"; overrides "
          "its values in for_each, cases and scatter; may be repeated")
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

void add_columns_and_events(CLI::App& verb, Texts& texts) {
  verb.add_option(
          "--columns", texts.columns,
          "columns of the table on standard output and of --csv, as frequency,amplitude (default: a few "
          "on standard output, all in --csv)")
      ->type_name("NAME,NAME...");
  verb.add_option("--events", texts.events,
                  "kinds of events in these tables, as peak,fold, or none (default: all)")
      ->type_name("KIND,KIND...");
}

void add_figure_options(CLI::App& verb, Texts& texts) {
  verb.add_option("--figures", texts.figures,
                  "formats of figures: svg, png, pdf, or none, which leaves their data and gnuplot scripts "
                  "(default: svg,png)")
      ->type_name("FORMAT,FORMAT...");
  verb.add_option("--figure-size", texts.figure_size,
                  "width and height of figures in pixels of 1/96 inch (default: 800x500)")
      ->type_name("WxH");
  verb.add_option("--figure-style", texts.figure_style,
                  "colour, or grey for print without colours (default: colour)")
      ->type_name("STYLE");
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
  add_columns_and_events(verb, texts);
  add_figure_options(verb, texts);
  verb.add_flag("--receptance", options.receptance,
                "draw amplitudes over the amplitude of the force, too, where the scene has one force");
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

CLI::App* add_new_verb(OptionTree& tree, const std::string& kind) {
  CLI::App* verb =
      tree.app.add_subcommand(new_verb, "write a scene to begin with, with comments and studies");
  verb->group("Verbs");
  verb->require_subcommand(1);
  verb->formatter(std::make_shared<CLI::Formatter>());  // that of the program is shared by all verbs
  verb->get_formatter()->label("SUBCOMMAND", "KIND");
  verb->footer("Run arcslip new KIND --help for the numbers of a kind.");
  for (const NewKind& each : new_kinds()) {
    CLI::App* of = verb->add_subcommand(each.name, each.help);
    of->group("Kinds");
    if (kind.empty() || kind == each.name) add_new_options(*of, each, tree.options, tree.texts);
  }
  return verb;
}

void add_tolerance(CLI::App& verb, Texts& texts) {
  verb.add_option("--tolerance", texts.tolerance,
                  "relative difference up to which two values are the same (default: 1e-06)")
      ->type_name("E");
}

/// The verbs for files of results.
void add_result_verbs(OptionTree& tree) {
  CommandOptions& options = tree.options;
  CLI::App* show = tree.app.add_subcommand(show_verb, "print the results of a JSON file as tables");
  CLI::App* plot = tree.app.add_subcommand(
      plot_verb, "draw the results of a JSON file, or the histograms of an ensemble, as figures");
  CLI::App* compare = tree.app.add_subcommand(
      compare_verb,
      "print what differs in the results of two JSON files, and end with exit code 4 if any does");
  show->add_option("FILE", options.files[0], "results as JSON")->required()->type_name("");
  plot->add_option("FILE", options.files[0], "results as JSON, or the file of an ensemble")
      ->required()
      ->type_name("");
  compare->add_option("A", options.files[0], "results as JSON")->required()->type_name("");
  compare->add_option("B", options.files[1], "results as JSON")->required()->type_name("");
  add_columns_and_events(*show, tree.texts);
  plot->add_option("--out", options.out, "folder for the figures (default: that of the file)")
      ->type_name("DIR");
  add_figure_options(*plot, tree.texts);
  plot->add_option("--x", options.x, "column along x (default: the frequency, or the parameter that varies)")
      ->type_name("NAME");
  plot->add_option("--y", options.y, "column along y (default: amplitude)")->type_name("NAME");
  add_tolerance(*compare, tree.texts);
  for (CLI::App* verb : {show, plot, compare}) {
    verb->group("Verbs");
    verb->footer(std::string(exit_codes));
  }
}

}  // namespace

OptionTree::OptionTree(const scene::Catalogue& catalogue, const std::string& verb, const std::string& kind)
    : verbs(verbs_of(catalogue)) {
  app.require_subcommand(1);
  app.set_version_flag("--version", "arcslip " + std::string(results::version()), "print the version");
  app.add_flag("--verbose")->description("with --version: libraries with their versions and licences, too");
  app.set_help_flag("--help,-h", "print this help");
  app.get_formatter()->label("SUBCOMMAND", "VERB SCENE");
  app.footer(std::string(exit_codes) + "\nRun arcslip VERB --help for the options of a verb.");
  for (Verb& each : verbs) {
    CLI::App* of = app.add_subcommand(each.name, each.help);
    of->group("Verbs");
    verb_of.emplace(of, &each);
    if (verb.empty() || each.name == verb) add_options(*of, each, options, texts);  // no others are needed
  }
  new_scene = add_new_verb(*this, kind);
  add_result_verbs(*this);
  app.add_subcommand(schema_verb, "print the JSON Schema of scene files, for editors")->group("Verbs");
  app.add_subcommand(manual_verb, "print the manual page, for man -l")->group("Verbs");
  CLI::App* completions =
      app.add_subcommand(completions_verb, "print the completions of a shell: bash, zsh or fish");
  completions->group("Verbs");
  completions->add_option("SHELL", texts.shell, "bash, zsh or fish")->required()->type_name("");
}

std::vector<std::string> OptionTree::names() const {
  std::vector<std::string> all;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    all.push_back(verb->get_name());
  return all;
}

}  // namespace arcslip::app
