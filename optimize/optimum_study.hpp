#pragma once
// Studies of kind "optimum": the search, the direct way beside it, and the responses around the optimum.

#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/optimize/optimum.hpp>
#include <arcslip/optimize/optimum_curve_result.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::optimize {

/// What figures show of a case.
struct CaseCurves {
  std::size_t of = 0;                                    // of Optimum::cases
  std::vector<observables::ResponseBranch> peaks{};      // over the bounds, where the design is one parameter
  std::vector<observables::ResponseBranch> responses{};  // over the frequency, at the optimum
};

struct OptimumResult {
  std::string study, kind;  // told by who runs the study
  observables::Status status = observables::Status::failed;
  observables::Stop stop;
  std::vector<std::pair<std::string, double>> set;  // what for_each gave
  OptimumProblem problem;
  Optimum optimum;
  DirectOptimum direct;  // over one parameter, where there is no limit and one case
  /// Over the frequency, where there is one case: at half, once and twice the optimum, or only once where
  /// there are several results.
  std::vector<observables::ResponseBranch> responses{};
  std::vector<CaseCurves> curves{};  // of the highest dozen of several cases, in their order

  /// Whether the problem says so, by cases or by what scatters.
  bool has_cases() const { return !problem.cases.empty() || !problem.scatter.empty(); }

  /// Relative difference of the two ways in parameter and amplitude; NaN where there is only one.
  double difference_of_design() const;
  double difference_of_amplitude() const;
};

/// The scene in a case of a problem, with what scatters in it.
scene::Scene scene_of(scene::Scene scene, const OptimumProblem& problem, const CaseResult& of);

/// One for each combination of the study's for_each lists, each as if it stood alone. progress:
/// asked all the time, in all phases (`phase`), with the number of evaluations (`points`) and the least
/// amplitude (`best`) so far; false stops. Throws as optimum() does.
std::vector<OptimumResult> optimum_study(const scene::Scene& scene, const scene::Study& study,
                                         const observables::ProgressCallback& progress = {});

/// The same of a study with "along": the optimum as a curve. Throws as optimum_curve() does.
std::vector<OptimumCurveResult> optimum_curve_study(const scene::Scene& scene, const scene::Study& study,
                                                    const observables::ProgressCallback& progress = {});

}  // namespace arcslip::optimize
