#pragma once
// The design of least resonance: values of named parameters, a normal load or any other, for which the
// largest amplitude in a window of the excitation frequency is least, in one case or in several.
//
//   worst   minimise over p  max_c w_c A_c(p)
//   mean    minimise over p  sum_c w_c A_c(p) / sum_c w_c
//
//   A_c(p): the largest amplitude over the window in case c; lower <= p <= upper, limits on observables of
//   the peaks, linear limits on p. No case: one of weight 1, the scene as it is, and A_1 is minimised.
//
// Limits hold at every peak that is watched (peak_amplitude.hpp) in every case, so that they do not jump
// where two peaks are equally high. Searched is the logarithm of the criterion over ln p (over p where a
// range touches zero or both signs). Where what is to be least has a kink, algorithms with gradients and
// constraints bound each peak k by a level instead (epigraph): min t, ln w_c A_ck(p) <= t, or for the mean
// with a level for each case; the others see the criterion itself. At the end the responses are traced anew:
// where a peak shows that was not watched, the search goes on from there with it; and where a damper sticks,
// with it slipping (release.hpp).
//
// What scatters (worst): q_lower <= q <= q_upper of parameters that are not the design's, and the largest
// amplitude over all of them counts. Some q make cases; the worst q at the design found makes another, until
// local searches and corners have none that is higher (Mutapcic & Boyd 2009). Limits hold at the q that are
// cases.

#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/observables/response.hpp>
#include <arcslip/optimize/nlopt/minimize.hpp>
#include <arcslip/optimize/peaks/peak_amplitude.hpp>
#include <arcslip/optimize/search/certificate.hpp>
#include <arcslip/optimize/search/design.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::optimize {

struct OptimumProblem {
  std::vector<DesignVariable> over;
  double frequency_from = 0, frequency_to = 0;  // window, in the scene's unit
  std::vector<ObservableLimit> limits{};
  std::vector<LinearLimit> linear_limits{};
  std::vector<DesignCase> cases{};  // none: one, the scene as it is
  Criterion criterion = Criterion::worst;
  std::vector<DesignVariable> scatter{};  // each case counts with its highest amplitude between these bounds
  friend bool operator==(const OptimumProblem&, const OptimumProblem&) = default;
};

/// Several circumstances, by cases or by what scatters.
inline bool has_cases(const OptimumProblem& problem) {
  return !problem.cases.empty() || !problem.scatter.empty();
}

struct OptimumProgress {
  int evaluations = 0;
  std::span<const double> design;  // of the last one
  double omega = 0;                // of the highest peak of the highest case, rad/s; 0 where there is none
  double amplitude = 0, best = 0;  // m, of the criterion: there, and the least so far where all limits hold
  const char* phase = "";          // what is done, in words: "the search", "the certificate"
};

struct OptimumOptions {
  std::string algorithm{};  // by NLopt's own name; empty: default_algorithm
  Tolerances tolerances{.x_relative = 0,
                        .x_absolute = 1e-7,
                        .f_relative = 0,
                        .f_absolute = 1e-13};  // of ln p, ln A; global algorithms do not look at f
  int evaluations = 1000;
  int scatter_rounds = 30;  // searches for the worst of what scatters, >= 1
  double seconds = 0;       // 0: no limit
  std::optional<LocalOptions> local{};
  int population = 0;
  unsigned long seed = 1;
  bool certificate = true;
  bool elsewhere = true;  // with limits: searches from the lowest of designs over all the bounds, too, by the
                          // algorithm and LN_COBYLA, and by that and LD_MMA from the start, each of as many
                          // evaluations
  std::function<bool(const OptimumProgress&)> progress{};  // after each evaluation, and where another phase
                                                           // begins; false stops
  /// Asked all the time, in every phase, at each step of each response; false stops with reason user, as soon
  /// as what is under way has ended, or in half a second. So does the limit of time.
  std::function<bool()> go_on{};
};

/// A design that was tried.
struct Evaluation {
  std::vector<double> design;
  double amplitude = 0;  // m, of the criterion over the cases of that time; infinity where one is unbounded
};

/// A case at the optimum; where parameters scatter, a case with values that they take.
struct CaseResult {
  std::size_t of = 0;                                   // of OptimumProblem::cases; 0 where there are none
  std::vector<std::pair<std::string, double>> set;      // what that case sets
  std::vector<std::pair<std::string, double>> scatter;  // what scatters, here
  double weight = 1;
  double amplitude = 0;              // A_c, m, without the weight
  observables::ResponsePoint point;  // at its highest peak
  bool active = false;    // worst: w_c A_c is the highest, within 1e-6, relative; mean: every case is
  double multiplier = 0;  // its share in the balance of gradients at the optimum; all add up to 1
};

struct Optimum {
  observables::Status status = observables::Status::failed;
  /// reason: of reasons::of_optima; scatter_limit: after OptimumOptions::scatter_rounds; not_stationary:
  /// most_stationarity, most_complementarity. Complete: the certificate holds, and all of it was made.
  observables::Stop stop;
  std::vector<double> design;        // best so far; empty where there is none
  double amplitude = 0;              // of the criterion there, m: A_max where there is one case of weight 1
  std::vector<CaseResult> cases;     // of the problem, each with some of what scatters; then those added
  observables::ResponsePoint point;  // at the highest peak of the case of highest w_c A_c
  bool feasible = false;             // all limits hold there
  std::string algorithm;
  bool epigraph = false;   // several peaks, each a constraint
  int scatter_rounds = 0;  // searches for the worst of what scatters
  std::vector<Evaluation> evaluations;
  PeakWork work;                   // of all cases
  double seconds = 0;              // of the search and its certificate
  std::vector<std::string> notes;  // what was changed or seen: a start that was moved, peaks that came up
  std::optional<Certificate> certificate;
};

/// From the scene's own values of the parameters. Throws OptionsError for bad input: no, reversed or equal
/// bounds, bounds that the parameters may not take, a name twice, an unknown algorithm or observable, a
/// weight that is not above 0, a case or scatter in a parameter of the design, a response of a case that is
/// none, scatter beside the mean; scene::ParameterError for an unknown parameter.
Optimum optimum(const scene::Scene& scene, const OptimumProblem& problem, const OptimumOptions& options = {});

/// The direct way, over one parameter and without cases: the least minimum of the amplitude on the curves of
/// resonance peaks at which no other peak is higher. None: A_max is least where two peaks are equally high,
/// or at a bound. Throws as optimum(), and OptionsError where there are several parameters, cases, or
/// scatter.
struct DirectOptimum {
  bool found = false;
  observables::ResponsePoint point;                 // `over` is the parameter
  std::vector<observables::ResponseBranch> curves;  // of peaks over the bounds
  std::string message;                              // where there is none
};
/// progress: of the curves; false ends it, with what was found.
DirectOptimum direct_optimum(const scene::Scene& scene, const OptimumProblem& problem,
                             const observables::ProgressCallback& progress = {});

}  // namespace arcslip::optimize
