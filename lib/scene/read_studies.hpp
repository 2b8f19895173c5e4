#pragma once
// Reading what refers to parameters by their names: ties and studies.

#include <arcslip/scene/read_parts.hpp>

#include <map>
#include <string>
#include <vector>

namespace arcslip::scene::detail {

/// Reads "ties". Whether the tied fields have one common value is left to check_ties().
std::vector<Tie> read_ties(const Place& place, Names& names, Faults& faults);
/// Reads "studies". `ties` are those that were read; where `ties_complete` is false others may exist.
std::vector<Study> read_studies(const Place& place, FrequencyUnit unit, const std::vector<Tie>& ties,
                                bool ties_complete, const Names& names, Faults& faults);

}  // namespace arcslip::scene::detail
