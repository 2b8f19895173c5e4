#pragma once
// Responses by shooting: the branch of exact periodic motions over the excitation frequency, or over another
// parameter.

#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/control/run_control.hpp>

namespace arcslip::observables {

/// One branch from the beginning of the range on, from the response of harmonic balance there, or from rest
/// where there is none. The period of the motion is that of the scene's harmonics. A branch that ends early
/// is reported with its reason, also where the structure is not piecewise linear or has degrees of freedom
/// without mass. Throws std::invalid_argument unless from < to, and scene::ParameterError for a parameter as
/// parameter_response().
ResponseBranch shooting_response(const scene::Scene& scene, const FrequencyRange& range,
                                 const control::Control& control = {});
ResponseBranch shooting_response(const scene::Scene& scene, const ParameterRange& range,
                                 const control::Control& control = {});

}  // namespace arcslip::observables
