#pragma once
// Studies of kind "optimum": the search, the direct way beside it, and the responses around the optimum.

#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/optimize/optimum.hpp>
#include <arcslip/scene/scene.hpp>

#include <string>
#include <utility>
#include <vector>

namespace arcslip::optimize {

struct OptimumResult {
  std::string study, kind;  // told by who runs the study
  observables::Status status = observables::Status::failed;
  observables::Stop stop;
  std::vector<std::pair<std::string, double>> set;  // what for_each gave
  OptimumProblem problem;
  Optimum optimum;
  DirectOptimum direct;  // over one parameter, where no limit is set
  std::vector<observables::ResponseBranch>
      responses{};  // over the frequency, at half, once and twice the optimum

  /// Relative difference of the two ways in parameter and amplitude; NaN where there is only one.
  double difference_of_design() const;
  double difference_of_amplitude() const;
};

/// One for each combination of the study's for_each lists, each from the optimum of the one before. progress:
/// after each evaluation, `points` is their number; false stops. Throws as optimum() does.
std::vector<OptimumResult> optimum_study(const scene::Scene& scene, const scene::Study& study,
                                         const observables::ProgressCallback& progress = {});

}  // namespace arcslip::optimize
