#pragma once
// The parameters that studies name, and the values and ranges that they give them.

#include <arcslip/scene/read_parts.hpp>
#include <arcslip/scene/read_values.hpp>
#include <arcslip/scene/study_type.hpp>

#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace arcslip::scene::file {

/// Where the parameters of a scene are looked up by name.
struct Parameters {
  /// Where the ties are not complete, others may exist.
  Parameters(const std::vector<Tie>& ties, bool ties_complete, const Names& names);

  const std::vector<Tie>& ties;
  bool ties_complete;
  const Names& names;
  std::unordered_map<std::string_view, const Tie*> tie_by_name, tie_of_field;
};

/// The fields that a value for this parameter must suit; empty where a fault is told.
std::vector<const Field*> fields_of(const std::string& parameter, const std::string& pointer,
                                    const Parameters& all, Faults& faults);

/// A parameter that the study is over, and what bounds it; any number where a fault is told.
Field read_parameter(const Place& place, const Parameters& all, std::string& parameter, Faults& faults);

/// A pair [lower, upper] of values of a field, lower < upper; zeros where a fault is told. what: it is a
/// lower and an upper ... of.
std::pair<double, double> read_pair(const Place& place, const std::string& wanted, const Field& field,
                                    std::string_view what, Faults& faults);

/// Lists of values by the names of parameters, of which their fields allow each. A name that is taken is a
/// fault.
ValueLists read_value_lists(const Place& place, const Parameters& all, const std::vector<Taken>& taken,
                            Faults& faults);

/// Tells a fault where the study gives values to this parameter elsewhere. Then true.
bool is_taken(const std::string& parameter, const std::string& pointer, const std::vector<Taken>& taken,
              Faults& faults);

/// The bounds of all fields that a parameter sets; any number where a fault is told.
Field bounds_of(const std::string& parameter, const std::string& pointer, const Parameters& all,
                Faults& faults);

/// "3 N".
std::string with_unit(double value, const Field& field);

}  // namespace arcslip::scene::file
