
#include "option_tree.hpp"

#include <arcslip/results/version.hpp>
#include <arcslip/scene/scene.hpp>

#include <algorithm>
#include <functional>
#include <vector>

namespace arcslip::app {
namespace {

std::vector<const CLI::App*> verbs_in(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

/// The options with names; positional arguments have none.
std::vector<const CLI::Option*> options_in(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_lnames().empty(); });
}

std::vector<const CLI::Option*> arguments_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return option->get_lnames().empty(); });
}

/// The words that an option takes: "one|all"; none for what has no fixed ones.
std::vector<std::string> words_for(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (type.find('|') == std::string::npos ||
      type.find_first_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") != std::string::npos)
    return {};
  std::vector<std::string> words(1);
  for (const char c : type)
    if (c == '|')
      words.emplace_back();
    else
      words.back() += c;
  return words;
}

bool takes_value(const CLI::Option& option) {
  return !option.get_type_name().empty() && option.get_type_size() > 0;
}

std::string joined_by(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options_in(app)) names.push_back("--" + option->get_lnames().front());
  return names;
}

std::vector<std::string> verb_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : verbs_in(app)) names.push_back(verb->get_name());
  return names;
}

/// Visits each verb, and each kind of scene of the verb new, with the words that lead there.
void visit(const CLI::App& app, const std::function<void(const std::string&, const CLI::App&)>& visitor) {
  for (const CLI::App* verb : verbs_in(app)) {
    const std::vector<const CLI::App*> kinds = verbs_in(*verb);
    if (kinds.empty()) visitor(verb->get_name(), *verb);
    for (const CLI::App* kind : kinds) visitor(verb->get_name() + " " + kind->get_name(), *kind);
  }
}

std::string bash(const CLI::App& app) {
  std::string values, options, kinds;
  visit(app, [&](const std::string& words, const CLI::App& verb) {
    options += "    '" + words + "') names='" + joined_by(option_names(verb), " ") + "' ;;\n";
    for (const CLI::Option* option : options_in(verb))
      if (const auto of = words_for(*option); !of.empty())
        values += "    '" + words + " --" + option->get_lnames().front() + "') words='" + joined_by(of, " ") +
                  "' ;;\n";
  });
  for (const CLI::App* verb : verbs_in(app))
    if (!verbs_in(*verb).empty())
      kinds += "    " + verb->get_name() + ") words='" + joined_by(verb_names(*verb), " ") + "' ;;\n";
  return "# bash completion of arcslip\n"
         "_arcslip() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} words= names=\n"
         "  local verb=${COMP_WORDS[1]}\n"
         "  COMPREPLY=()\n"
         "  if ((COMP_CWORD == 1)); then\n"
         "    words='" +
         joined_by(verb_names(app), " ") +
         " --help --version'\n"
         "    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         "    return\n"
         "  fi\n"
         "  if ((COMP_CWORD == 2)); then\n"
         "    case $verb in\n" +
         kinds +
         "    completions) words='bash zsh fish' ;;\n"
         "    esac\n"
         "    [[ -n $words ]] && COMPREPLY=($(compgen -W \"$words\" -- \"$current\")) && return\n"
         "  fi\n"
         "  [[ $verb == new ]] && verb=\"new ${COMP_WORDS[2]}\"\n"
         "  case \"$verb $previous\" in\n" +
         values +
         "  esac\n"
         "  [[ -n $words ]] && COMPREPLY=($(compgen -W \"$words\" -- \"$current\")) && return\n"
         "  if [[ $current == -* ]]; then\n"
         "    case $verb in\n" +
         options +
         "    esac\n"
         "    COMPREPLY=($(compgen -W \"$names\" -- \"$current\"))\n"
         "  else\n"
         "    COMPREPLY=($(compgen -f -- \"$current\"))\n"
         "  fi\n"
         "}\n"
         "complete -o filenames -F _arcslip arcslip\n";
}

/// With each of some characters after a backslash.
std::string escaped_with(const std::string& text, const std::string& characters) {
  std::string out;
  for (const char c : text) {
    if (characters.find(c) != std::string::npos) out += '\\';
    out += c;
  }
  return out;
}

/// Within single quotes of zsh.
std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : escaped_with(text, "[]:\\"))
    out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out;
}

std::string zsh_options(const CLI::App& verb) {
  std::string text = "_arguments";
  for (const CLI::Option* option : options_in(verb)) {
    const auto words = words_for(*option);
    text +=
        " \\\n        '--" + option->get_lnames().front() + "[" + zsh_text(option->get_description()) + "]";
    if (!words.empty())
      text += ":word:(" + joined_by(words, " ") + ")";
    else if (takes_value(*option))
      text += ":" + zsh_text(option->get_type_name()) + ":_files";
    text += "'";
  }
  return text + " \\\n        '*:file:_files'";
}

std::string zsh_list(const CLI::App& app) {
  std::string text;
  for (const CLI::App* verb : verbs_in(app))
    text += "    '" + verb->get_name() + ":" + zsh_text(verb->get_description()) + "'\n";
  return text;
}

std::string zsh(const CLI::App& app) {
  std::string text =
      "#compdef arcslip\n"
      "_arcslip() {\n"
      "  local -a verbs\n"
      "  verbs=(\n" +
      zsh_list(app) +
      "  )\n"
      "  if (( CURRENT == 2 )); then\n"
      "    _describe verb verbs\n"
      "    return\n"
      "  fi\n"
      "  local place=$words[2]\n";
  for (const CLI::App* verb : verbs_in(app))
    if (!verbs_in(*verb).empty())
      text += "  if [[ $place == " + verb->get_name() +
              " ]]; then\n    if (( CURRENT == 3 )); then\n      verbs=(\n" + zsh_list(*verb) +
              "      )\n      _describe kind verbs\n      return\n    fi\n" +
              "    place=\"$place $words[3]\"\n    shift words\n    (( CURRENT-- ))\n  fi\n";
  text +=
      "  shift words\n"
      "  (( CURRENT-- ))\n"
      "  case $place in\n";
  visit(app, [&](const std::string& words, const CLI::App& verb) {
    text += "    '" + words + "')\n      " + zsh_options(verb) + "\n      ;;\n";
  });
  return text + "  esac\n}\n_arcslip \"$@\"\n";
}

std::string fish_text(const std::string& text) {
  return "'" + escaped_with(text, "'\\") + "'";
}

std::string fish(const CLI::App& app) {
  std::string text = "# fish completion of arcslip\n";
  for (const CLI::App* verb : verbs_in(app))
    text += "complete -c arcslip -n __fish_use_subcommand -f -a " + verb->get_name() + " -d " +
            fish_text(verb->get_description()) + "\n";
  for (const CLI::App* verb : verbs_in(app))
    for (const CLI::App* kind : verbs_in(*verb))
      text += "complete -c arcslip -n '__fish_seen_subcommand_from " + verb->get_name() + "' -f -a " +
              kind->get_name() + " -d " + fish_text(kind->get_description()) + "\n";
  text += "complete -c arcslip -n '__fish_seen_subcommand_from completions' -f -a 'bash zsh fish'\n";
  visit(app, [&](const std::string& words, const CLI::App& verb) {
    const std::string last = words.substr(words.rfind(' ') + 1);
    for (const CLI::Option* option : options_in(verb)) {
      text += "complete -c arcslip -n '__fish_seen_subcommand_from " + last + "' -l " +
              option->get_lnames().front() + (takes_value(*option) ? " -r" : "");
      if (const auto of = words_for(*option); !of.empty()) text += " -f -a '" + joined_by(of, " ") + "'";
      text += " -d " + fish_text(option->get_description()) + "\n";
    }
  });
  return text;
}

/// For troff: backslashes, hyphens, and characters that begin a request.
std::string troff(const std::string& text) {
  std::string out = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

std::string manual_options(const CLI::App& verb) {
  std::string text;
  for (const CLI::Option* option : options_in(verb)) {
    const std::string type = takes_value(*option) ? " " + option->get_type_name() : "";
    text += ".TP\n.B " + troff("--" + option->get_lnames().front() + type) + "\n" +
            troff(option->get_description()) + "\n";
  }
  return text;
}

std::string manual(const CLI::App& app) {
  std::string text =
      ".TH ARCSLIP 1 \"\" \"arcslip " + std::string(results::version()) + "\" \"User Commands\"\n" +
      ".SH NAME\narcslip \\- " +
      troff(
          "vibration of structures with friction and other "
          "nonlinear elements") +
      "\n.SH SYNOPSIS\n.B arcslip\n.I VERB\n[\\fIOPTIONS\\fR]\n.I SCENE\n.SH DESCRIPTION\n" +
      troff(app.get_description()) + "\n" +
      "A scene is a JSON file; results go to standard output and to files, progress and notes to "
      "standard error.\n.SH VERBS\n";
  visit(app, [&](const std::string& words, const CLI::App& verb) {
    std::string arguments;
    for (const CLI::Option* argument : arguments_of(verb)) arguments += " " + argument->get_name(true);
    text += ".SS " + troff(words + arguments) + "\n" + troff(verb.get_description()) + "\n" +
            manual_options(verb);
  });
  text += ".SH EXIT STATUS\n";
  const std::vector<std::pair<const char*, const char*>> codes = {
      {"0", "done"},
      {"1", "usage or file"},
      {"2", "invalid scene"},
      {"3", "stopped early with partial results written"},
      {"4", "compare found differences"}};
  for (const auto& [code, meaning] : codes)
    text += std::string(".TP\n.B ") + code + "\n" + troff(meaning) + "\n";
  return text +
         ".SH EXAMPLES\n.nf\narcslip new damper \\-\\-frequency 47 \\-\\-out damper.json\narcslip check "
         "damper.json\narcslip run damper.json\n.fi\n";
}

}  // namespace

std::string shell_file(const std::string& verb, const std::string& shell, const CLI::App& all) {
  if (verb == manual_verb) return manual(all);
  if (shell == "bash") return bash(all);
  if (shell == "zsh") return zsh(all);
  if (shell == "fish") return fish(all);
  const std::vector<std::string> shells = {"bash", "zsh", "fish"};
  const std::string near = scene::nearest(shell, shells);
  throw UsageError("unknown shell \"" + shell + "\", must be bash, zsh or fish" +
                   (near.empty() ? "" : "; did you mean " + near + "?"));
}

}  // namespace arcslip::app
