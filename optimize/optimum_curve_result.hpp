#pragma once
// Curves of optima as a study gives them.

#include <arcslip/optimize/optimum_curve.hpp>

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

}  // namespace arcslip::optimize
