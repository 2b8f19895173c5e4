#include "verbs.hpp"

#include "command_line/key_options.hpp"
#include "interrupt.hpp"

#include <arcslip/results/text.hpp>
#include <arcslip/scene/format/scene_file.hpp>
#include <arcslip/scene/keys/write_values.hpp>
#include <arcslip/studies/presentation/units.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::app {
namespace {

void apply(scene::Scene& scene, const CommandOptions& options) {
  for (const auto& [parameter, text, value] : options.set) {
    try {
      if (value)
        scene::set(scene, parameter, *value);
      else
        scene::set_text(scene, parameter, text);
    } catch (const scene::ParameterError& error) {
      throw UsageError("--set " + parameter + "=" + text + ": " + error.what());
    }
  }
  if (options.harmonics || options.accuracy) {
    scene.harmonics.accuracy = options.accuracy.value_or(0);
    scene.harmonics.order = options.harmonics.value_or(scene::largest_chosen_order);
  }
  if (options.set.empty() && !options.harmonics && !options.accuracy) return;
  try {
    scene::check(scene);
  } catch (const scene::SceneError& error) {
    std::string message = "the options make the scene invalid:";
    for (const scene::Fault& fault : error.faults())
      message += "\n  " + results::visible(fault.pointer) + ": " + fault.message;
    throw UsageError(message);
  }
}

using scene::Key;
using scene::KeyType;
using scene::file::Member;
using scene::file::Node;

/// The keys of a study's settings, as in the scene file.
Node::Object own_keys(const scene::Scene& scene, const scene::Study& study) {
  Node::Object keys;
  study.type->settings().write(study.settings, scene, keys);
  return keys;
}

const Node* find(const std::vector<Member>& keys, const std::string& name) {
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const Member& member) { return member.key == name; });
  return found != keys.end() ? &found->value : nullptr;
}

/// The name of a parameter under a key, or "".
std::string parameter_at(const std::vector<Member>& keys, const std::string& name) {
  const Node* node = find(keys, name);
  const auto* text = node != nullptr ? node->get<std::string>() : nullptr;
  return text != nullptr ? *text : "";
}

const GivenKey* find(const CommandOptions& options, const std::string& name) {
  const auto found = std::find_if(options.keys.begin(), options.keys.end(),
                                  [&](const GivenKey& given) { return given.key.name == name; });
  return found != options.keys.end() ? &*found : nullptr;
}

/// The parameter given by an option for a key of type parameter, or "".
std::string parameter_of(const GivenKey& given) {
  const auto* node = std::get_if<Node>(&given.value);
  const auto* text = node != nullptr ? node->get<std::string>() : nullptr;
  return given.key.type == KeyType::parameter && text != nullptr ? *text : "";
}

/// Throws if an option names no parameter at all; other faults are reported when the option is read.
void check_parameter(const scene::Scene& scene, const std::string& option, const std::string& parameter) {
  if (parameter.empty() || parameter == "frequency") return;
  try {
    scene::parameter_field(scene, parameter);
  } catch (const scene::ParameterError& error) {
    throw UsageError(option + " " + parameter + ": " + error.what());
  }
}

void check_parameters(const scene::Scene& scene, const CommandOptions& options) {
  for (const GivenKey& given : options.keys) {
    const std::string option = option_of(given.key.name);
    check_parameter(scene, option, parameter_of(given));
    if (const auto* ranges = std::get_if<std::vector<RangeOption>>(&given.value))
      for (const RangeOption& each : *ranges) check_parameter(scene, option, each.parameter);
  }
}

/// "--from, --to and --frequency"
std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text.append(i == 0 ? "" : i + 1 == words.size() ? " and " : ", ").append(words[i]);
  return text;
}

Node pair_of(const std::pair<double, double>& range) {
  return {Node::List{{range.first}, {range.second}}};
}

/// Lists of parameters and of their bounds; bounds not given by an option are those of the study.
void add_parameters(const GivenKey& given, const Node::Object& own, std::vector<Member>& keys) {
  const Node* names = find(own, given.key.name);
  const Node* bounds = find(own, "bounds");
  Node::List all_names, all_bounds;
  for (const RangeOption& each : std::get<std::vector<RangeOption>>(given.value)) {
    const Node* known = nullptr;
    const auto& own_names = *names->get<Node::List>();
    for (std::size_t i = 0; i < own_names.size(); ++i)
      if (*own_names[i].get<std::string>() == each.parameter) known = &(*bounds->get<Node::List>())[i];
    if (!each.range && known == nullptr) {
      const std::string option = option_of(given.key.name) + " " + each.parameter;
      throw UsageError(option + ": no bounds given; give them as " + option + "=lower:upper");
    }
    all_names.push_back({each.parameter});
    all_bounds.push_back(each.range ? pair_of(*each.range) : *known);
  }
  keys.push_back({given.key.name, {std::move(all_names)}});
  keys.push_back({"bounds", {std::move(all_bounds)}});
}

void add_followed(const GivenKey& given, std::vector<Member>& keys) {
  const RangeOption& one = std::get<std::vector<RangeOption>>(given.value).front();
  if (!one.range) {
    const std::string option = option_of(given.key.name) + " " + one.parameter;
    throw UsageError(option + ": no range given; give it as " + option + "=from:to");
  }
  keys.push_back({given.key.name, {one.parameter}});
  keys.push_back({"from", {one.range->first}});
  keys.push_back({"to", {one.range->second}});
}

/// The keys given by the options, in addition to the study's own.
std::vector<Member> keys_of(const CommandOptions& options, const Node::Object& own) {
  std::vector<Member> keys;
  for (const GivenKey& given : options.keys)
    if (const auto* node = std::get_if<Node>(&given.value))
      keys.push_back({given.key.name, *node});
    else if (given.key.type == KeyType::parameters)
      add_parameters(given, own, keys);
    else
      add_followed(given, keys);
  return keys;
}

/// The parameters named by the options, which are then dropped from the lists of the study.
std::vector<std::string> named_parameters(const CommandOptions& options) {
  std::vector<std::string> names;
  for (const GivenKey& given : options.keys) {
    if (const auto* ranges = std::get_if<std::vector<RangeOption>>(&given.value))
      for (const RangeOption& each : *ranges) names.push_back(each.parameter);
    else if (const std::string parameter = parameter_of(given); !parameter.empty())
      names.push_back(parameter);
  }
  return names;
}

/// Throws if --set sets a parameter that the study itself varies.
void check_set(const std::vector<Key>& known, const std::vector<Member>& keys,
               const CommandOptions& options) {
  for (const Key& key : known) {
    if (key.type != KeyType::parameter && key.type != KeyType::followed) continue;
    for (const auto& [parameter, text, value] : options.set) {
      if (parameter == parameter_at(keys, key.name)) {
        throw UsageError(
            "--set " + parameter + "=" + text + ": the study " +
            (key.type == KeyType::followed
                 ? "continues the optimum over this parameter; give " + option_of(key.name) + " for its range"
                 : "varies this parameter; give --from and --to for its range"));
      }
    }
  }
}

/// Throws if the range between --from and --to is empty.
void check_range(const scene::Scene& scene, const scene::Study& study, const std::vector<Member>& keys,
                 const CommandOptions& options) {
  const GivenKey* from_given = find(options, "from");
  const GivenKey* to_given = find(options, "to");
  const Node *from_node = find(keys, "from"), *to_node = find(keys, "to");
  if ((from_given == nullptr && to_given == nullptr) || from_node == nullptr || to_node == nullptr) return;
  const double from = *from_node->get<double>(), to = *to_node->get<double>();
  if (from < to) return;
  const GivenKey& given = from_given != nullptr ? *from_given : *to_given;
  const std::string over = parameter_at(keys, "over");
  const std::string unit = given.key.type == KeyType::frequency
                               ? std::string(scene::unit_name(scene.frequency_unit))
                           : over == "frequency" ? ""
                                                 : studies::parameter_unit(scene, over);
  throw UsageError(from_given != nullptr
                       ? "--from must be below " + results::quantity(to, unit) + ", where the study \"" +
                             study.name + "\" ends; found " + results::quantity(from, unit)
                       : "--to must be above " + results::quantity(from, unit) + ", where the study \"" +
                             study.name + "\" begins; found " + results::quantity(to, unit));
}

/// The option that gave the key at this location within a study, or "".
std::string option_at(const std::string& place, const CommandOptions& options) {
  const std::string key = place.substr(0, place.find('/'));
  for (const GivenKey& given : options.keys) {
    const std::vector<std::string> nearby = scene::keys_next_to(given.key.type);
    if (key != given.key.name && std::find(nearby.begin(), nearby.end(), key) == nearby.end()) continue;
    const auto* ranges = std::get_if<std::vector<RangeOption>>(&given.value);
    if (ranges == nullptr) {
      const auto* number = std::get<Node>(given.value).get<double>();
      return number != nullptr ? option_of(given.key.name) + " " + results::shortest(*number) : given.text;
    }
    const std::string index = place.find('/') == std::string::npos ? "0" : place.substr(place.find('/') + 1);
    const std::size_t i = std::min<std::size_t>(std::strtoul(index.c_str(), nullptr, 10), ranges->size() - 1);
    return option_of(given.key.name) + " " + (*ranges)[i].parameter;
  }
  return "";
}

/// The index of the study that provides what the command line leaves out, if the scene has one.
std::optional<std::size_t> study_to_follow(const scene::Scene& scene, const CommandOptions& options) {
  const GivenKey* over = find(options, "over");
  const std::string parameter = over != nullptr ? parameter_of(*over) : "";
  std::optional<std::size_t> found;
  for (std::size_t i = scene.studies.size(); i-- > 0;)
    if (scene.studies[i].type == options.type) found = i;
  for (std::size_t i = scene.studies.size(); i-- > 0 && !parameter.empty();) {
    const scene::Study& study = scene.studies[i];
    if (study.type == options.type && parameter_at(own_keys(scene, study), "over") == parameter) found = i;
  }
  return found;
}

/// A study with defaults and a unique name.
scene::Study new_study(const scene::Scene& scene, const CommandOptions& options) {
  std::string name = options.verb;
  while (std::any_of(scene.studies.begin(), scene.studies.end(),
                     [&](const scene::Study& other) { return other.name == name; }))
    name += "_2";
  return {name, options.type, options.type->settings().defaults(), {}};
}

/// Throws if scene and options together do not define the study. is_new: the scene has no study of this kind;
/// otherwise it has none over this parameter, and ranges are required.
void check_complete(const CommandOptions& options, bool is_new, const std::string& over) {
  std::vector<std::string> missing;
  for (const Key& key : options.type->keys()) {
    const bool is_wanted = is_new ? key.required && key.type != KeyType::other : key.type == KeyType::value;
    if (is_wanted && find(options, key.name) == nullptr)
      missing.push_back(option_of(key.name) + (key.type == KeyType::parameters ? " with bounds" : ""));
  }
  if (!missing.empty()) {
    throw UsageError("the scene has no study of kind " + std::string(options.type->name()) +
                     (is_new ? "" : " over " + over) + ": give " + listed(missing) +
                     ", or add such a study to the scene");
  }
}

}  // namespace

scene::Scene resolve(const CommandOptions& options, const scene::Catalogue& catalogue) {
  scene::Scene scene = scene::read_file(options.scene, catalogue, by_signal());
  apply(scene, options);
  return scene;
}

bool takes_keys(const scene::Study& study, const CommandOptions& options) {
  const std::vector<Key> keys = study.type->keys();
  return std::all_of(options.keys.begin(), options.keys.end(), [&](const GivenKey& given) {
    return std::any_of(keys.begin(), keys.end(), [&](const Key& key) {
      return key.name == given.key.name && key.type == given.key.type;
    });
  });
}

scene::Scene with_options(const scene::Scene& scene, std::size_t index, const CommandOptions& options) {
  scene::Scene dropped = scene;
  scene::Study& study = dropped.studies[index];
  const std::vector<std::string> named = named_parameters(options);
  for (const std::string& parameter : named) scene::drop(study, parameter);
  const Node::Object own = own_keys(scene, study);
  std::vector<Member> keys = keys_of(options, own);
  for (const Key& key : study.type->keys()) {  // a parameter both in "along" and in "over"
    const std::string along = parameter_at(own, key.name);
    if (key.type == KeyType::followed && find(keys, key.name) == nullptr && !along.empty() &&
        std::find(named.begin(), named.end(), along) != named.end()) {
      keys.push_back({key.name, {nullptr}});
      for (const std::string& gone : scene::keys_next_to(key.type)) keys.push_back({gone, {nullptr}});
    }
  }
  std::vector<Member> all = keys;
  all.insert(all.end(), own.begin(), own.end());  // the first of a name counts
  check_set(study.type->keys(), all, options);
  check_range(scene, study, all, options);
  try {
    return scene::with_keys(dropped, index, keys);
  } catch (const scene::SceneError& error) {
    const std::string place = "/studies/" + std::to_string(index) + "/";
    std::string message;
    for (const scene::Fault& fault : error.faults()) {
      const std::string option =
          fault.pointer.starts_with(place) ? option_at(fault.pointer.substr(place.size()), options) : "";
      message += (message.empty() ? "" : "\n  ") +
                 (option.empty() ? "with the options, " + results::visible(fault.pointer) : option) + ": " +
                 fault.message;
    }
    throw UsageError(message);
  }
}

std::size_t study_of_verb(scene::Scene& scene, const CommandOptions& options) {
  check_parameters(scene, options);
  const GivenKey* over_given = find(options, "over");
  const std::string over = over_given != nullptr ? parameter_of(*over_given) : "";
  const std::optional<std::size_t> found = study_to_follow(scene, options);
  if (!found) {
    check_complete(options, true, over);
    scene.studies.push_back(new_study(scene, options));
  } else if (!over.empty() && parameter_at(own_keys(scene, scene.studies[*found]), "over") != over) {
    check_complete(options, false, over);
  }
  const std::size_t index = found.value_or(scene.studies.size() - 1);
  scene = with_options(scene, index, options);
  return index;
}

}  // namespace arcslip::app
