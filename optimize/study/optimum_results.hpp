#pragma once
// Optima and curves of optima as results, formats "arcslip-optimum-1" and "arcslip-optimum-curves-1": tables
// of the design evaluations and of the cases; of the points of a curve and its events.

#include <arcslip/optimize/study/optimum_study.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/presentation/result_description.hpp>

#include <string>

namespace arcslip::optimize {

/// The optima, and the curves, of one study; see docs/results.md for all fields.
studies::Described<OptimumResult> described_optima(const scene::Scene& scene, const OptimumProblem& problem);
studies::Described<OptimumCurveResult> described_curves(const scene::Scene& scene,
                                                        const OptimumProblem& problem,
                                                        const std::string& along);

}  // namespace arcslip::optimize
