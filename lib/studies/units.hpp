#pragma once
// Numbers and their units as people read them.

#include <arcslip/scene/scene.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::studies {

/// Unit of a parameter of the scene: "N", "N s/m", "-" for a pure number. Throws scene::ParameterError.
std::string parameter_unit(const scene::Scene& scene, std::string_view parameter);

/// "damper.normal_load (N)", as a column or an axis is headed, with what is not to be shown escaped
/// (results/text.hpp).
std::string with_unit(std::string_view quantity, std::string_view unit);

/// "damper.normal_load = 3 N, c.value = 0.1 N s/m"; "" for no parameter. Escaped as with_unit() does.
std::string assignment(const scene::Scene& scene, const std::vector<std::pair<std::string, double>>& set);

/// The same without names: "3 N, 0.1 N s/m".
std::string set_label(const scene::Scene& scene, const std::vector<std::pair<std::string, double>>& set);

/// omega (rad/s) in the scene's frequency unit.
double in_scene_unit(const scene::Scene& scene, double omega);

}  // namespace arcslip::studies
