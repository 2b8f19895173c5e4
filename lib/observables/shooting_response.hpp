#pragma once
// Frequency responses by shooting: the branch of exact periodic motions over the excitation frequency.

#include <arcslip/observables/frequency_response.hpp>

namespace arcslip::observables {

/// One branch from the lower end of the range on, from the response of harmonic balance there. The period of
/// the motion is that of the scene's harmonics. A branch that ends early is reported with its reason, also
/// where the structure is not piecewise linear or has degrees of freedom without mass. Throws
/// std::invalid_argument unless from < to.
ResponseBranch shooting_response(const scene::Scene& scene, const FrequencyRange& range,
                                 const ProgressCallback& progress = {});

}  // namespace arcslip::observables
