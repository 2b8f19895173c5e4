#pragma once
// Figures of optima.

#include <arcslip/optimize/optimum_study.hpp>
#include <arcslip/output/figures.hpp>

#include <span>
#include <string>

namespace arcslip::optimize {

/// Of one parameter: the resonance peaks over its bounds with the least one marked, and the ranges in
/// which the amplitude is within 1 % and 5 % of it shaded (NAME_amplitude, NAME_frequency; unshaded
/// NAME_amplitude_over_stick). Of any: the frequency responses at half, once and twice the
/// optimum, or only once where there are several results (NAME_responses_amplitude, NAME_responses_stick).
/// With cases, of each result by itself (NAME_1, NAME_2 ... where there are several): the highest peak of
/// each case, times its weight, and the criterion over the bounds, with the optimum and its ranges
/// (NAME_amplitude), and the responses of the cases at the optimum.
output::Figures write_figures(const scene::Scene& scene, scene::StudyKind kind,
                              std::span<const OptimumResult> results, const std::string& folder,
                              const std::string& name, const scene::StopRequest& stop = {});

}  // namespace arcslip::optimize
