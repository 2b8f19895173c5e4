#include <arcslip/studies/units.hpp>

#include <arcslip/results/text.hpp>

namespace arcslip::studies {

std::string parameter_unit(const scene::Scene& scene, std::string_view parameter) {
  return std::string(scene::parameter_fields(scene, parameter).front()->unit);
}

std::string with_unit(std::string_view quantity, std::string_view unit) {
  std::string text = results::visible(quantity);
  if (!unit.empty()) {
    text.append(" (").append(unit).append(")");
  }
  return text;
}

std::string assignment(const scene::Scene& scene, const std::vector<std::pair<std::string, double>>& set) {
  std::string text;
  for (const auto& [name, value] : set) {
    text.append(text.empty() ? "" : ", ").append(results::visible(name)).append(" = ");
    text += results::quantity(value, parameter_unit(scene, name));
  }
  return text;
}

std::string set_label(const scene::Scene& scene, const std::vector<std::pair<std::string, double>>& set) {
  std::string text;
  for (const auto& [name, value] : set) {
    text.append(text.empty() ? "" : ", ").append(results::quantity(value, parameter_unit(scene, name)));
  }
  return text;
}

double in_scene_unit(const scene::Scene& scene, double omega) {
  return omega / scene::to_rad_per_s(scene.frequency_unit);
}

}  // namespace arcslip::studies
