#include <arcslip/studies/presentation/units.hpp>

#include <arcslip/results/result.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>

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

bool has_label(const scene::Scene& scene, std::string_view name) {
  return std::any_of(scene.labels.begin(), scene.labels.end(),
                     [&](const auto& label) { return label.first == name; });
}

double in_scene_unit(const scene::Scene& scene, double omega) {
  return omega / scene::to_rad_per_s(scene.frequency_unit);
}

}  // namespace arcslip::studies
