#pragma once
// The study kind "optimum", for a catalogue.
//
//   scene::Catalogue catalogue = studies::catalogue();
//   optimize::add_studies(catalogue);

#include <arcslip/scene/study_type.hpp>

namespace arcslip::optimize {

const scene::StudyType& optimum_type();  // settings: OptimumSettings

/// Adds them to a catalogue. They outlive all scenes.
void add_studies(scene::Catalogue& catalogue);

}  // namespace arcslip::optimize
