#pragma once
// Curves of optima as results of a study.

#include <arcslip/optimize/optimum_curve.hpp>

#include <string>
#include <utility>
#include <vector>

namespace arcslip::optimize {

struct OptimumCurveResult {
  std::string study, kind;                          // set by the caller
  std::vector<std::pair<std::string, double>> set;  // parameters set by for_each
  OptimumProblem problem;
  OptimumCurve curve;
};

}  // namespace arcslip::optimize
