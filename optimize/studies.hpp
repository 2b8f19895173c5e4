#pragma once
// The study kind "optimum", for a catalogue.
//
//   scene::Catalogue catalogue = studies::catalogue();
//   optimize::add_studies(catalogue);

#include <arcslip/studies/study_kind.hpp>

namespace arcslip::optimize {

const studies::StudyKind& optimum_type();  // settings: OptimumSettings

/// Adds them to a catalogue.
void add_studies(scene::Catalogue& catalogue);

}  // namespace arcslip::optimize
