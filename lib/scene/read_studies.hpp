#pragma once
// Reading what refers to parameters by their names: ties and studies.

#include <arcslip/scene/study_parameters.hpp>

#include <map>
#include <string>
#include <vector>

namespace arcslip::scene::detail {

/// Reads "ties". Whether the tied fields have one common value is left to check_ties().
std::vector<Tie> read_ties(const Place& place, Names& names, Faults& faults);
/// Reads "studies". all: the ties that were read, and the names of parts.
std::vector<Study> read_studies(const Place& place, FrequencyUnit unit, const Parameters& all,
                                const Dofs& dofs, Faults& faults);

}  // namespace arcslip::scene::detail
