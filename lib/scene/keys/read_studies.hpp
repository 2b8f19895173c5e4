#pragma once
// Reading of studies, which refer to parameters by name.

#include <arcslip/scene/keys/study_parameters.hpp>

#include <map>
#include <string>
#include <vector>

namespace arcslip::scene::file {

/// Bounds of a frequency in the scene's unit.
Field frequency_field(FrequencyUnit unit);
/// Reads "studies", of the kinds of the catalogue.
std::vector<Study> read_studies(const Location& place, FrequencyUnit unit, const Parameters& all,
                                const Dofs& dofs, const FileSource& source, const Catalogue& catalogue,
                                Faults& faults);

}  // namespace arcslip::scene::file
