#pragma once
// Optima and curves of optima as results, formats "arcslip-optimum-1" and "arcslip-optimum-curves-1": tables
// of the designs that were looked at and of the cases; of the points of a curve and its events.

#include <arcslip/optimize/optimum_curve_result.hpp>
#include <arcslip/optimize/optimum_study.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/scene/scene.hpp>

#include <span>

namespace arcslip::optimize {

/// docs/results.md tells all that there is. The optima, and the curves, of one study.
results::Results results_of(const scene::Scene& scene, std::span<const OptimumResult> optima);
results::Results results_of(const scene::Scene& scene, std::span<const OptimumCurveResult> curves);

}  // namespace arcslip::optimize
