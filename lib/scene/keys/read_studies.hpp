#pragma once
// Reading of ties and studies, which refer to parameters by name.

#include <arcslip/scene/keys/study_parameters.hpp>

#include <map>
#include <string>
#include <vector>

namespace arcslip::scene::file {

/// Bounds of a frequency in the scene's unit.
Field frequency_field(FrequencyUnit unit);
/// Reads "ties". check_ties() checks that tied fields have the same value.
std::vector<Tie> read_ties(const Location& place, Names& names, Faults& faults);
/// Reads "studies", of the kinds of the catalogue. all: the ties that were read, and the names of parts.
std::vector<Study> read_studies(const Location& place, FrequencyUnit unit, const Parameters& all,
                                const Dofs& dofs, const FileSource& source, const Catalogue& catalogue,
                                Faults& faults);

}  // namespace arcslip::scene::file
