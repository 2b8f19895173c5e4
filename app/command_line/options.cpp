#include "options.hpp"

#include "../new_scene.hpp"
#include "option_tree.hpp"
#include "option_values.hpp"

#include <arcslip/results/text.hpp>
#include <arcslip/scene/format/json_schema.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::app {
namespace {

constexpr const char* hint = "Run arcslip --help for the verbs, arcslip VERB --help for their options.";
constexpr int most_threads = 1024;
constexpr double usual_tolerance = 1e-6;  // of compare

/// "a, b or c; did you mean b?"
std::string one_of(const std::vector<std::string>& names, const std::string& word) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text.append(i == 0 ? "" : i + 1 == names.size() ? " or " : ", ").append(names[i]);
  const std::string near = scene::nearest(word, names);
  return text + (near.empty() ? "" : "; did you mean " + near + "?");
}

/// The first option that the verb does not have, and the nearest one that it has.
struct UnknownOption {
  std::string name, near;
};
std::optional<UnknownOption> unknown_option(const CLI::App& verb, int argc, const char* const* argv) {
  std::vector<std::string> known;
  for (const CLI::Option* option : verb.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (int i = 2; i < argc; ++i) {
    std::string word = argv[i];
    word = word.substr(0, word.find('='));
    if (!word.starts_with("--") || std::find(known.begin(), known.end(), word) != known.end()) continue;
    return UnknownOption{word, scene::nearest(word, known)};
  }
  return {};
}

void read_new(const CLI::App& of, const Texts& texts, CommandOptions& options) {
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
                                     {"--events", &texts.events},
                                     {"--figures", &texts.figures},
                                     {"--figure-size", &texts.figure_size},
                                     {"--figure-style", &texts.figure_style}})
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

/// --figures, --figure-size and --figure-style.
output::FigureOptions figure_options(const CLI::App& verb, const Texts& texts) {
  constexpr int least = 200, most = 10'000;
  output::FigureOptions options;
  if (given(verb, "--figures")) options.formats = names_in("--figures", texts.figures);
  if (options.formats == std::vector<std::string>{"none"}) options.formats.clear();
  for (const std::string& format : options.formats)
    if (std::find(output::figure_formats.begin(), output::figure_formats.end(), format) ==
            output::figure_formats.end() ||
        std::count(options.formats.begin(), options.formats.end(), format) > 1)
      throw UsageError("--figures " + texts.figures +
                       ": must be none, or svg, png and pdf, each once at most");
  if (given(verb, "--figure-size")) {
    const auto by = texts.figure_size.find('x');
    const std::string allowed = "WIDTHxHEIGHT, from 200 to 10000 each, as 800x500";
    const auto side = [&](const std::string& text) {
      const int pixels = whole_number("--figure-size", text, allowed).value_or(0);
      if (pixels < least || pixels > most)
        throw UsageError("--figure-size " + texts.figure_size + ": must be " + allowed);
      return pixels;
    };
    options.style.width = side(texts.figure_size.substr(0, by));
    options.style.height = side(by == std::string::npos ? "" : texts.figure_size.substr(by + 1));
  }
  if (given(verb, "--figure-style")) {
    if (texts.figure_style != "colour" && texts.figure_style != "grey")
      throw UsageError("--figure-style " + texts.figure_style + ": must be colour or grey");
    options.style.is_grey = texts.figure_style == "grey";
  }
  return options;
}

double tolerance(const std::string& text) {
  const std::string allowed = "a number of at least 0";
  const double value = number("--tolerance", text, allowed).value_or(usual_tolerance);
  if (value < 0) throw UsageError("--tolerance " + text + ": must be " + allowed);
  return value;
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
  options.tolerance = tolerance(texts.tolerance);
  options.columns = names_in("--columns", texts.columns);
  options.events = names_in("--events", texts.events);
  options.figures = figure_options(verb, texts);
  for (const KeyOption& option : of.keys)
    if (given(verb, option.name())) options.keys.push_back(option.given());
}

/// Reads the options of a verb that takes a scene or results.
void read_verb(const CLI::App& verb, OptionTree& tree) {
  check_values_given(verb, tree.texts);
  const auto of = tree.verb_of.find(&verb);
  tree.options.type = of != tree.verb_of.end() ? of->second->type : nullptr;
  const Verb none;
  read_texts(verb, of != tree.verb_of.end() ? *of->second : none, tree.texts, tree.options);
  check_consistent(tree.options, verb);
}

[[noreturn]] void throw_kind(int argc, const char* const* argv) {
  std::vector<std::string> names;
  for (const NewKind& kind : new_kinds()) names.push_back(kind.name);
  const std::string word = argc > 2 ? argv[2] : "";
  throw UsageError(word.empty() ? "new needs a kind of scene: " + one_of(names, "")
                                : "unknown kind of scene \"" + results::visible(word) + "\", must be " +
                                      one_of(names, word));
}

/// Throws what the user may do about arguments that CLI11 refuses.
[[noreturn]] void refuse(const CLI::ParseError& error, const OptionTree& tree, int argc,
                         const char* const* argv) {
  const std::string first = argv[1];
  const std::vector<CLI::App*> verbs = tree.app.get_subcommands();
  if (verbs.empty() && !first.empty() && first.front() != '-') {
    throw UsageError("unknown verb \"" + results::visible(first) + "\", must be " +
                     one_of(tree.names(), first) + "\n" + hint);
  }
  if (first == new_verb && tree.new_scene->get_subcommands().empty()) throw_kind(argc, argv);
  const CLI::App* parsed = verbs.empty() ? &tree.app : verbs.front();
  if (parsed == tree.new_scene) parsed = parsed->get_subcommands().front();
  const auto unknown = unknown_option(*parsed, argc, argv);
  const std::string what = unknown && dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr
                               ? "unknown option " + unknown->name
                               : error.what();
  const std::string near = unknown ? unknown->near : "";
  throw UsageError(results::visible(what + (near.empty() ? "" : "; did you mean " + near + "?")) + "\n" +
                   hint);
}

}  // namespace

std::variant<CommandOptions, Information> parse(int argc, const char* const* argv,
                                                const scene::Catalogue& catalogue) {
  const std::string first = argc > 1 ? argv[1] : "", second = argc > 2 ? argv[2] : "";
  OptionTree tree(catalogue, first.empty() ? "none" : first, second.empty() ? "none" : second);
  if (argc < 2)
    throw UsageError("no verb given. Give a verb and a scene, as in arcslip run scene.json\n" +
                     std::string(hint));
  try {
    tree.app.parse(argc, argv);
  } catch (const CLI::CallForVersion& version) {
    const bool verbose = std::find(argv, argv + argc, std::string("--verbose")) != argv + argc;
    return Information{std::string(version.what()) + "\n" + (verbose ? build_details() : "")};
  } catch (const CLI::CallForHelp&) {
    return Information{tree.app.help()};
  } catch (const CLI::ParseError& error) {
    refuse(error, tree, argc, argv);
  }
  const CLI::App& verb = *tree.app.get_subcommands().front();
  tree.options.verb = verb.get_name();
  if (&verb == tree.new_scene)
    read_new(*verb.get_subcommands().front(), tree.texts, tree.options);
  else if (verb.get_name() == schema_verb)
    return Information{scene::json_schema(catalogue)};
  else if (verb.get_name() == manual_verb || verb.get_name() == completions_verb)
    return Information{shell_file(verb.get_name(), tree.texts.shell, OptionTree(catalogue, "", "").app)};
  else
    read_verb(verb, tree);
  return tree.options;
}

}  // namespace arcslip::app
