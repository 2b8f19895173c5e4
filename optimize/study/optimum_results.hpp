#pragma once
// Optima and curves of optima as results, formats "arcslip-optimum-1" and "arcslip-optimum-curves-1": tables
// of the design evaluations and of the cases; of the points of a curve and its events. And their figures.

#include <arcslip/optimize/study/optimum_study.hpp>
#include <arcslip/results/figure_data.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/presentation/result_description.hpp>

#include <span>
#include <string>
#include <vector>

namespace arcslip::optimize {

/// The optima, and the curves, of one study; see docs/results.md for all fields.
studies::Described<OptimumResult> described_optima(const scene::Scene& scene, const OptimumProblem& problem);
studies::Described<OptimumCurveResult> described_curves(const scene::Scene& scene,
                                                        const OptimumProblem& problem,
                                                        const std::string& along);

/// Figures of optima. With one parameter: the resonance peaks over its bounds with the minimum marked, and
/// the ranges in which the amplitude is within 1 % and 5 % of it shaded (not over the stick share). With any
/// number: the frequency responses at half, once and twice the optimum, or only once for several results
/// (data named "responses"). With cases, for each result separately (data named "1", "1_responses" and so on
/// if for_each gives several): the highest peak of each case, times its weight, and the criterion over the
/// bounds, with the optimum and its ranges, and the responses of the cases at the optimum, each as a labelled
/// line.
std::vector<results::FigureData> figures_of(const scene::Scene& scene,
                                            std::span<const OptimumResult> results);

/// Figures of curves. Over s, with a line for each result: the amplitude ("amplitude"), the stick share of
/// each friction element
/// ("stick") and each design parameter, by its name.
results::FigureData figures_of(const scene::Scene& scene, std::span<const OptimumCurveResult> results);

}  // namespace arcslip::optimize
