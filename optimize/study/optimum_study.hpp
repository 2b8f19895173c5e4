#pragma once
// Studies of kind "optimum": the search, the direct method for comparison, and the responses near
// the optimum.

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/curve/optimum_curve.hpp>
#include <arcslip/optimize/search/optimum.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::optimize {

/// Settings of the search. Algorithms have their NLopt names.
struct SearchSettings {
  std::string algorithm{};      // empty: default_algorithm
  std::string local{};          // local algorithm of AUGLAG and MLSL; empty: none
  int evaluations = 1000;       // maximum number of design evaluations
  double seconds = 0;           // 0: no limit
  int population = 0;           // of stochastic algorithms; 0: their default
  int seed = 1;                 // of stochastic algorithms: the same seed gives the same run
  int starts = default_starts;  // of local searches with several parameters or limits
  friend bool operator==(const SearchSettings&, const SearchSettings&) = default;
};

/// Settings of a study.
struct OptimumSettings {
  OptimumProblem problem{};
  SearchSettings search{};
  std::optional<DesignVariable> along{};  // the optimum is continued over this parameter, from lower to upper
  friend bool operator==(const OptimumSettings&, const OptimumSettings&) = default;
};

/// A curve of optima as a result of a study.
struct OptimumCurveResult {
  std::string study, kind;                          // set by the caller
  std::vector<std::pair<std::string, double>> set;  // parameters set by for_each
  OptimumProblem problem;
  OptimumCurve curve;
};

/// Curves of a case for figures.
struct CaseCurves {
  std::size_t of = 0;                                // of Optimum::cases
  bool all_places = false;                           // where the response is the largest of several places:
                                                     // of all, and `of` is the case of the highest
  std::vector<observables::ResponseBranch> peaks{};  // over the bounds, with one design parameter
  std::vector<observables::ResponseBranch> responses{};  // over the frequency, at the optimum
};

struct OptimumResult {
  std::string study, kind;  // set by the caller
  observables::Status status = observables::Status::failed;
  observables::Stop stop;
  std::vector<std::pair<std::string, double>> set;  // parameters set by for_each
  OptimumProblem problem;
  Optimum optimum;
  DirectOptimum direct;  // with one parameter, one case and no limits
  /// Over the frequency, for a single case: at half, once and twice the optimum, or only once for
  /// several results.
  std::vector<observables::ResponseBranch> responses{};
  std::vector<CaseCurves> curves{};  // of the twelve highest of several cases

  /// Whether the problem has cases or scatter.
  bool has_cases() const { return optimize::has_cases(problem); }

  /// Relative difference between both methods in parameter and amplitude; NaN with only one method.
  double difference_of_design() const;
  double difference_of_amplitude() const;
};

/// The scene in a case of a problem, with the values of its uncertain parameters.
scene::Scene scene_of(scene::Scene scene, const OptimumProblem& problem, const LoadCaseResult& of);

/// Merges identical cases, as after an option has overridden the parameter in which they differ, with the
/// largest of their weights (worst) or their sum (mean).
OptimumProblem with_distinct_cases(OptimumProblem problem);

/// Where the response is the largest of several places, a case without a response of its own becomes one case
/// for each of them, of which the worst counts. Throws OptionsError for the criterion mean and with "along".
OptimumSettings with_places(const scene::Scene& scene, OptimumSettings settings);

/// Throws OptionsError for a limit on an unknown observable, and as optimum() does for an invalid design.
void check_limits(const scene::Scene& scene, const OptimumProblem& problem);

/// What a study does next to its search.
struct OptimumExtent {
  bool curves = true;  // of the cases, for figures
  bool alone = true;   // the only result: with responses at half and twice the optimum
  int threads = 1;     // OptimumOptions::threads
};

/// The search, over distinct cases. progress: called throughout, in all phases (`phase`), with the number of
/// evaluations (`points`) and the lowest amplitude (`best`) so far; false stops. Throws as optimum() does.
OptimumResult optimum_study(const scene::Scene& scene, const OptimumSettings& settings,
                            const control::Control& control = {}, const OptimumExtent& extent = {});

/// The same for settings with "along": the curve of optima. Throws as optimum_curve() does.
OptimumCurveResult optimum_curve_study(const scene::Scene& scene, const OptimumSettings& settings,
                                       const control::Control& control = {});

}  // namespace arcslip::optimize
