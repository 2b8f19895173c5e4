#pragma once
// Laws of a scene's own: an element of type "formula".
//
//   {"name": "pot", "type": "formula", "at": "x", "force": "k*sin(q) + c*v^3",
//    "parameters": {"k": {"value": 4, "unit": "N"}, "c": 0.1}}
//
// Over several displacements "forces" is a list of a formula for each of q1, q2 ..., whose places are keys of
// the element, or degrees of freedom of these names. The parameters are its fields.

#include <arcslip/laws/law_type.hpp>

#include <string>
#include <vector>

namespace arcslip::elements {

/// "formula".
const LawType& formula_type();

/// A parameter of a formula; no unit: it is a pure number.
struct FormulaParameter {
  std::string name, unit = "-";
  friend bool operator==(const FormulaParameter&, const FormulaParameter&) = default;
};
/// The options of an element with these forces, one for each displacement. Throws formula::FormulaError, and
/// std::invalid_argument for a name that no parameter may have.
scene::Settings formula_options(std::vector<std::string> forces, std::vector<FormulaParameter> parameters);

}  // namespace arcslip::elements
