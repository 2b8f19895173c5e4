#include <arcslip/studies/windows.hpp>

#include <arcslip/analyses/branches/proposed_window.hpp>
#include <arcslip/scene/keys/json_tree.hpp>
#include <arcslip/scene/study_type.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace arcslip::studies {
namespace {

using observables::ValuesTaken;
using scene::KeyType;
using scene::file::Node;

const Node* value_of(const Node::Object& keys, const std::string& name) {
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const auto& key) { return key.key == name; });
  return found == keys.end() ? nullptr : &found->value;
}

void add_range(const Node* name, const Node* lower, const Node* upper, std::vector<ValuesTaken>& ranges) {
  const auto* parameter = name != nullptr ? name->get<std::string>() : nullptr;
  const auto* from = lower != nullptr ? lower->get<double>() : nullptr;
  const auto* to = upper != nullptr ? upper->get<double>() : nullptr;
  if (parameter != nullptr && from != nullptr && to != nullptr) ranges.push_back({*parameter, *from, *to});
}

void add_bounds(const Node* names, const Node* bounds, std::vector<ValuesTaken>& ranges) {
  const auto* all = names != nullptr ? names->get<Node::List>() : nullptr;
  const auto* pairs = bounds != nullptr ? bounds->get<Node::List>() : nullptr;
  if (all == nullptr || pairs == nullptr) return;
  for (std::size_t i = 0; i < std::min(all->size(), pairs->size()); ++i)
    if (const auto* pair = (*pairs)[i].get<Node::List>(); pair != nullptr && pair->size() == 2)
      add_range(&(*all)[i], &pair->front(), &pair->back(), ranges);
}

/// The values that a study gives to parameters: by its own keys, and for each of a list.
std::vector<ValuesTaken> ranges_of(const scene::Scene& scene, const scene::Study& study) {
  Node::Object keys;
  study.type->settings().write(study.settings, scene, keys);
  std::vector<ValuesTaken> ranges;
  for (const scene::Key& key : study.type->keys()) {
    if (key.type == KeyType::parameter || key.type == KeyType::followed)
      add_range(value_of(keys, key.name), value_of(keys, "from"), value_of(keys, "to"), ranges);
    if (key.type == KeyType::parameters)
      add_bounds(value_of(keys, key.name), value_of(keys, "bounds"), ranges);
  }
  for (const auto& [parameter, values] : study.for_each)
    if (const auto [least, most] = std::minmax_element(values.begin(), values.end()); least != values.end())
      ranges.push_back({parameter, *least, *most});
  return ranges;
}

std::optional<scene::WindowEnds> window_of(scene::Study& study) {
  if (study.settings.empty()) study.settings = study.type->settings().defaults();
  return study.type->settings().window(study.settings);
}

}  // namespace

bool lacks_window(const scene::Study& study) {
  scene::Study copy = study;
  const auto window = window_of(copy);
  return window && *window->upper == 0;
}

std::vector<observables::WindowOfStudy> windows_of(const scene::Scene& scene) {
  const double unit = scene::to_rad_per_s(scene.frequency_unit);
  std::vector<observables::WindowOfStudy> all;
  for (scene::Study study : scene.studies)
    if (const auto window = window_of(study); window && *window->upper > 0)
      all.push_back({study.name, {unit * *window->lower, unit * *window->upper}});
  return all;
}

namespace {

/// Why no natural frequencies are computed, in parentheses; "" where they are.
std::string why_unknown(const scene::Scene& scene) {
  constexpr std::size_t most_dofs = 1000;
  if (!scene.rotation.empty()) return " (of a rotor none are computed)";
  if (scene.dofs.size() > most_dofs) return " (above 1000 degrees of freedom none are computed)";
  return scene.elements.empty() ? "" : " (elements count by their stiffness at rest)";
}

}  // namespace

std::string propose_window(scene::Scene& scene, std::size_t index, const control::Control& control) {
  scene::Study& study = scene.studies.at(index);
  if (!lacks_window(study)) return "";
  const auto proposed = observables::proposed_window(scene, ranges_of(scene, study), control);
  if (!proposed)
    throw scene::SceneError(
        {{"/studies/" + std::to_string(index),
          "found no window of frequencies, and none can be proposed, since no natural frequency is known "
          "that the excitation drives and in which the response moves" +
              why_unknown(scene) + ": give the window"}});
  const auto window = window_of(study);
  *window->lower = proposed->lower;
  *window->upper = proposed->upper;
  return "the window of the study \"" + study.name + "\" was proposed: " + proposed->reason;
}

}  // namespace arcslip::studies
