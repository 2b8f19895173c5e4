#pragma once
// The parameters named by studies, with their values and ranges.

#include <arcslip/scene/keys/read_parts.hpp>
#include <arcslip/scene/keys/read_values.hpp>
#include <arcslip/scene/study_type.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::scene::file {

/// Lookup of the parameters of a scene by name, while it is read.
struct Parameters {
  const Scene& scene;       // its parts and constants
  bool constants_complete;  // otherwise others may exist
  const Names& names;
  /// Where the formulas of a study's numbers go, by their pointers in it; null: it may have none.
  std::vector<std::pair<std::string, NumberText>>* texts = nullptr;
};
/// Where there are none.
const Parameters& no_parameters();

/// The field of a parameter, whose bounds are those of all numbers that it sets. `parameter` becomes its full
/// name: "part.value" for "part". None after a fault, or where it may belong to what could not be read.
std::optional<Field> field_of(std::string& parameter, const std::string& pointer, const Parameters& all,
                              Faults& faults);
/// The same, unbounded where there is none.
Field bounds_of(std::string& parameter, const std::string& pointer, const Parameters& all, Faults& faults);

/// The continuation parameter of a study, and its bounds; unbounded after a fault.
Field read_parameter(const Location& place, const Parameters& all, std::string& parameter, Faults& faults);

/// A number of a study, which follows its parameters if it is a formula. study: the pointer of the study.
std::optional<double> read_followed_number(const Location& place, const Field& field,
                                           const std::string& study, const Parameters& all, Faults& faults);

/// Lists of values by parameter name, each within the bounds of its fields. A parameter that is already used
/// is a fault.
ValueLists read_value_lists(const Location& place, const Parameters& all,
                            const std::vector<ParameterUse>& taken, Faults& faults);

/// Whether "for_each" is a plan of samples, by its key "distributions".
bool are_samples(const Location& place, const Parameters& all);

/// {"distributions": {"k.value": {"normal": [30, 3]}}, "count": 2000, "seed": 1, "design": "sobol"}, with
/// distributions within the bounds of the parameters. No parameters after a fault.
sampling::Plan read_samples(const Location& place, const Parameters& all,
                            const std::vector<ParameterUse>& taken, Faults& faults);

/// A list of rows, {"k.value": 1, "m.value": 2}, all with the same parameters.
ValueLists read_rows(const Location& place, const Node::List& list, const Parameters& all,
                     const std::vector<ParameterUse>& taken, Faults& faults);

/// "labels" of the axes over parameters, and over the quantities of label_names.
std::vector<std::pair<std::string, std::string>> read_labels(const Location& place, const Parameters& all,
                                                             Faults& faults);

/// Reports a fault and returns true if the study sets this parameter elsewhere.
bool is_taken(const std::string& parameter, const std::string& pointer,
              const std::vector<ParameterUse>& taken, Faults& faults);

/// "3 N".
std::string with_unit(double value, const Field& field);

}  // namespace arcslip::scene::file
