#pragma once
// Figures of optima and of curves of optima, as data.

#include <arcslip/optimize/study/optimum_study.hpp>
#include <arcslip/results/figure_data.hpp>

#include <span>
#include <vector>

namespace arcslip::optimize {

/// With one parameter: the resonance peaks over its bounds with the minimum marked, and the ranges in which
/// the amplitude is within 1 % and 5 % of it shaded (not over the stick share). With any number: the
/// frequency responses at half, once and twice the optimum, or only once for several results (data named
/// "responses"). With cases, for each result separately (data named "1", "1_responses" and so on if for_each
/// gives several): the highest peak of each case, times its weight, and the criterion over the bounds, with
/// the optimum and its ranges, and the responses of the cases at the optimum, each as a labelled line.
std::vector<results::FigureData> figures_of(const scene::Scene& scene,
                                            std::span<const OptimumResult> results);

/// Over s, with a line for each result: the amplitude ("amplitude"), the stick share of each friction element
/// ("stick") and each design parameter, by its name.
results::FigureData figures_of(const scene::Scene& scene, std::span<const OptimumCurveResult> results);

}  // namespace arcslip::optimize
