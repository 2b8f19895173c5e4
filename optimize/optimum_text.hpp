#pragma once
// Optima for people.

#include <arcslip/optimize/optimum_curve_result.hpp>
#include <arcslip/optimize/optimum_study.hpp>
#include <arcslip/scene/scene.hpp>

#include <string>

namespace arcslip::optimize {

/// What was set, the design with its amplitude, its cases and limits, the work, and what the certificate
/// says; of a curve, its ends and its events. Lines.
std::string text_of(const scene::Scene& scene, const OptimumResult& result);
std::string text_of(const scene::Scene& scene, const OptimumCurveResult& result);

}  // namespace arcslip::optimize
