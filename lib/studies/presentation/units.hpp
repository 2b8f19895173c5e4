#pragma once
// Numbers with their units in text output.

#include <arcslip/results/value.hpp>
#include <arcslip/scene/scene.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::studies {

/// Unit of a parameter of the scene: "N", "N s/m", "-" for a pure number. Throws scene::ParameterError.
std::string parameter_unit(const scene::Scene& scene, std::string_view parameter);

using NamedValues = std::vector<std::pair<std::string, double>>;

/// Values of parameters of the scene by their names.
results::Object named(const scene::Scene& scene, const NamedValues& values);

/// "damper.normal_load = 3 N, c.value = 0.1 N s/m"; "" for no parameter. Escaped (results/text.hpp).
std::string assignment(const scene::Scene& scene, const NamedValues& set);

/// The same without names: "3 N, 0.1 N s/m".
std::string set_label(const scene::Scene& scene, const NamedValues& set);

/// The label of a parameter or quantity in figures, as the scene has it, or its name.
std::string label_of(const scene::Scene& scene, const std::string& name);
/// The same of a parameter, in words: "damper normal load", "k" for "k.value".
std::string words_of(const scene::Scene& scene, const std::string& parameter);

/// The unit of a parameter; "" for a pure number.
std::string axis_unit(const scene::Scene& scene, std::string_view parameter);

/// The amplitude (N) of the only force of the scene, where these parameters are set; NaN where there are
/// several, or where it is constant or of a higher harmonic.
double force_amplitude(const scene::Scene& scene, const NamedValues& set);

bool has_label(const scene::Scene& scene, std::string_view name);

/// omega (rad/s) in the scene's frequency unit.
double in_scene_unit(const scene::Scene& scene, double omega);

}  // namespace arcslip::studies
