#pragma once
// Reading what refers to parameters by their names: ties and studies.

#include <arcslip/scene/study_parameters.hpp>

#include <map>
#include <string>
#include <vector>

namespace arcslip::scene::file {

/// Reads "ties". Whether the tied fields have one common value is left to check_ties().
std::vector<Tie> read_ties(const Place& place, Names& names, Faults& faults);
/// Reads "studies", of the kinds of the catalogue. all: the ties that were read, and the names of parts.
std::vector<Study> read_studies(const Place& place, FrequencyUnit unit, const Parameters& all,
                                const Dofs& dofs, const FileSource& source, const Catalogue& catalogue,
                                Faults& faults);

}  // namespace arcslip::scene::file
