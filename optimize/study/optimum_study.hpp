#pragma once
// Studies of kind "optimum": the search, the direct way beside it, and the responses around the optimum.

#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/optimize/curve/optimum_curve.hpp>
#include <arcslip/optimize/search/optimum.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::optimize {

/// Of the search. Algorithms are called by NLopt's own names.
struct SearchSettings {
  std::string algorithm{};  // empty: default_algorithm
  std::string local{};      // what AUGLAG and MLSL search with; empty: none
  int evaluations = 1000;   // designs that are looked at, at most
  double seconds = 0;       // 0: no limit
  int population = 0;       // of the stochastic algorithms; 0: their own choice
  int seed = 1;             // of the stochastic algorithms: the same seed gives the same run
  friend bool operator==(const SearchSettings&, const SearchSettings&) = default;
};

/// Of a study.
struct OptimumSettings {
  OptimumProblem problem{};
  SearchSettings search{};
  std::optional<DesignVariable> along{};  // the optimum is followed over this one, from lower to upper
  friend bool operator==(const OptimumSettings&, const OptimumSettings&) = default;
};

/// A curve of optima as a study gives it.
struct OptimumCurveResult {
  std::string study, kind;                          // told by who runs the study
  std::vector<std::pair<std::string, double>> set;  // what for_each gave
  OptimumProblem problem;
  OptimumCurve curve;
};

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
  bool has_cases() const { return optimize::has_cases(problem); }

  /// Relative difference of the two ways in parameter and amplitude; NaN where there is only one.
  double difference_of_design() const;
  double difference_of_amplitude() const;
};

/// The scene in a case of a problem, with what scatters in it.
scene::Scene scene_of(scene::Scene scene, const OptimumProblem& problem, const CaseResult& of);

/// Cases that are the same, as where an option has taken from them what told them apart, become one: with the
/// largest of their weights (worst) or the sum of them (mean).
OptimumProblem with_distinct_cases(OptimumProblem problem);

/// The search, over distinct cases, and what is shown beside it, of a scene as it is. alone: with responses
/// at half and twice the optimum. progress: asked all the time, in all phases (`phase`), with the number of
/// evaluations (`points`) and the least amplitude (`best`) so far; false stops. Throws as optimum() does.
OptimumResult optimum_study(const scene::Scene& scene, const OptimumSettings& settings,
                            const observables::ProgressCallback& progress = {}, bool alone = true);

/// The same of settings with "along": the optimum as a curve. Throws as optimum_curve() does.
OptimumCurveResult optimum_curve_study(const scene::Scene& scene, const OptimumSettings& settings,
                                       const observables::ProgressCallback& progress = {});

}  // namespace arcslip::optimize
