#include <arcslip/studies/presentation/units.hpp>

#include <arcslip/results/result.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::studies {

std::string parameter_unit(const scene::Scene& scene, std::string_view parameter) {
  const std::string_view unit = scene::parameter_field(scene, parameter).unit;
  return unit.empty() ? "-" : std::string(unit);
}

results::Object named(const scene::Scene& scene, const NamedValues& values) {
  results::Object all;
  for (const auto& [name, value] : values) all.push_back({name, value, parameter_unit(scene, name)});
  return all;
}

std::string assignment(const scene::Scene& scene, const NamedValues& set) {
  return results::assignment(named(scene, set));
}

std::string set_label(const scene::Scene& scene, const NamedValues& set) {
  std::string text;
  for (const auto& [name, value] : set)
    text.append(text.empty() ? "" : ", ").append(results::quantity(value, parameter_unit(scene, name)));
  return text;
}

std::string label_of(const scene::Scene& scene, const std::string& name) {
  for (const auto& [axis, text] : scene.labels)
    if (axis == name) return text;
  return name;
}

std::string words_of(const scene::Scene& scene, const std::string& parameter) {
  if (has_label(scene, parameter)) return label_of(scene, parameter);
  std::string words = parameter;
  if (words.ends_with(".value")) words.resize(words.rfind('.'));
  std::replace_if(words.begin(), words.end(), [](char c) { return c == '.' || c == '_'; }, ' ');
  return words;
}

std::string axis_unit(const scene::Scene& scene, std::string_view parameter) {
  const std::string unit = parameter_unit(scene, parameter);
  return unit == "-" ? "" : unit;
}

double force_amplitude(const scene::Scene& scene, const NamedValues& set) {
  if (scene.excitation.size() != 1) return std::nan("");
  scene::Scene with_set = scene;
  for (const auto& [name, value] : set) scene::set(with_set, name, value);
  const scene::Part& part = with_set.excitation.front();
  if (part.type != &scene::force_type() || part.harmonic != 1) return std::nan("");
  return std::hypot(part.values[0], part.values[1]);
}

bool has_label(const scene::Scene& scene, std::string_view name) {
  return std::any_of(scene.labels.begin(), scene.labels.end(),
                     [&](const auto& label) { return label.first == name; });
}

double in_scene_unit(const scene::Scene& scene, double omega) {
  return omega / scene::to_rad_per_s(scene.frequency_unit);
}

}  // namespace arcslip::studies
