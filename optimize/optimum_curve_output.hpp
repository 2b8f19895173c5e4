#pragma once
// Curves of optima as a study gives them, and their figures.

#include <arcslip/optimize/optimum_curve.hpp>
#include <arcslip/output/figures.hpp>

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::optimize {

struct OptimumCurveResult {
  std::string study, kind;                          // told by who runs the study
  std::vector<std::pair<std::string, double>> set;  // what for_each gave
  OptimumProblem problem;
  OptimumCurve curve;
};

/// Over s, with a line for each result: each parameter of the design (NAME_PARAMETER), the amplitude
/// (NAME_amplitude) and the stick share of each friction element (NAME_stick).
output::Figures write_figures(const scene::Scene& scene, std::span<const OptimumCurveResult> results,
                              const std::string& folder, const std::string& name,
                              const scene::StopRequest& stop = {});

}  // namespace arcslip::optimize
