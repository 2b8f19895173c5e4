#pragma once
// One design for several cases: levels of the excitation, or samples of parameters that scatter.
//
//   worst   minimise over p  max_c w_c A_max(p; case c)
//   mean    minimise over p  sum_c w_c A_max(p; case c) / sum_c w_c
//
// Each case follows its own peaks. `worst` is searched with a constraint for each case (epigraph).

#include <arcslip/optimize/optimum.hpp>

#include <string>
#include <utility>
#include <vector>

namespace arcslip::optimize {

struct RobustCase {
  std::vector<std::pair<std::string, double>> set;  // parameters and their values in this case
  double weight = 1;                                // > 0
};

enum class Robust { worst, mean };

struct RobustOptimum {
  observables::Status status = observables::Status::failed;
  observables::Stop stop;            // reason: the name of a Reason, or "unbounded"
  std::vector<double> design;        // empty where there is none
  double value = 0;                  // of the criterion, m
  std::vector<double> amplitudes;    // A_max of each case there, m
  int evaluations = 0;               // designs, each for all cases
  PeakWork work;                     // of all cases
  std::vector<std::string> notes{};  // what was changed: a start that was moved
};

/// From the scene's own values, which must not be unbounded in any case. Limits on observables are not taken.
/// Throws as optimum() does, and OptionsError for no case, a weight that is not above 0, a case that sets a
/// parameter of the design, or limits.
RobustOptimum robust_optimum(const scene::Scene& scene, const OptimumProblem& problem,
                             const std::vector<RobustCase>& cases, Robust criterion,
                             const OptimumOptions& options = {});

}  // namespace arcslip::optimize
