#pragma once
// The parameters named by studies, with their values and ranges.

#include <arcslip/scene/keys/read_parts.hpp>
#include <arcslip/scene/keys/read_values.hpp>
#include <arcslip/scene/study_type.hpp>

#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace arcslip::scene::file {

/// Lookup of the parameters of a scene by name.
struct Parameters {
  /// Where the ties are not complete, others may exist.
  Parameters(const std::vector<Tie>& ties, bool ties_complete, const Names& names);

  const std::vector<Tie>& ties;
  bool ties_complete;
  const Names& names;
  std::unordered_map<std::string_view, const Tie*> tie_by_name, tie_of_field;
};

/// The fields whose bounds apply to this parameter; empty after a fault.
std::vector<const Field*> fields_of(const std::string& parameter, const std::string& pointer,
                                    const Parameters& all, Faults& faults);

/// The continuation parameter of a study, and its bounds; unbounded after a fault.
Field read_parameter(const Location& place, const Parameters& all, std::string& parameter, Faults& faults);

/// A pair [lower, upper] of values of a field, lower < upper; zeros after a fault. what: the noun in
/// messages, "bound".
std::pair<double, double> read_pair(const Location& place, const std::string& wanted, const Field& field,
                                    std::string_view what, Faults& faults);

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

/// "for_each": such lists, a list of rows, {"k.value": 1, "m.value": 2}, all with the same parameters, or
/// samples.
void read_for_each(const Location& place, const Parameters& all, const std::vector<ParameterUse>& taken,
                   Study& study, Faults& faults);

/// "labels" of the axes over parameters, and over the quantities of label_names.
std::vector<std::pair<std::string, std::string>> read_labels(const Location& place, const Parameters& all,
                                                             Faults& faults);

/// Reports a fault and returns true if the study sets this parameter elsewhere.
bool is_taken(const std::string& parameter, const std::string& pointer,
              const std::vector<ParameterUse>& taken, Faults& faults);

/// The common bounds of all fields set by a parameter; unbounded after a fault.
Field bounds_of(const std::string& parameter, const std::string& pointer, const Parameters& all,
                Faults& faults);

/// "3 N".
std::string with_unit(double value, const Field& field);

}  // namespace arcslip::scene::file
