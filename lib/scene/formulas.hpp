#pragma once
// Formulas of the parameters of a scene.

#include <arcslip/scene/scene.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace arcslip::scene {

/// The parameter that a name stands for, "part" for "part.value"; empty: none.
std::string parameter_of(const Scene& scene, std::string_view name);

/// Reads a formula, whose names are parameters. Without any it does not follow() others. Throws
/// formula::FormulaError, also where a name is unknown.
NumberText read_formula(const Scene& scene, const std::string& text);
/// With the present values of its parameters.
double value(const Scene& scene, const NumberText& formula);
/// Why a number of a field may not have this formula: its value or its dimension. Empty: it may.
std::string objection_to(const Scene& scene, const Field& field, const NumberText& formula);
/// The parameters that a formula follows, itself or through others, and that have none.
std::vector<std::string> independent_parameters(const Scene& scene, const NumberText& formula);

/// Why a formula has not the dimension of a unit, or adds what has different ones, as the end of a message:
/// "which adds kg to N/m". Empty if it is right as far as units are known: plain numbers may have any.
std::string dimension_fault(const formula::Formula& formula, std::span<const std::string> units,
                            std::string_view wanted);

}  // namespace arcslip::scene
