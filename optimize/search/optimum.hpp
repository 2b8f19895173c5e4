#pragma once
// Minimization of the highest resonance peak: named parameters, such as normal loads, that minimize the
// largest amplitude in a window of the excitation frequency, in one or several load cases.
//
//   worst   minimize over p  max_c w_c A_c(p)
//   mean    minimize over p  sum_c w_c A_c(p) / sum_c w_c
//
//   A_c(p): the largest amplitude over the window in case c; lower <= p <= upper, limits on observables of
//   the peaks, linear limits on p. Without cases: one case of weight 1, the scene itself, and A_1 is
//   minimized.
//
// Limits apply to every watched peak (peak_amplitude.hpp) in every case, so that they do not jump where
// two peaks are equally high. The search minimizes the logarithm of the criterion over ln p (over p if a
// range includes zero). If the criterion has a kink, algorithms with gradients and constraints use the
// epigraph form, which bounds each peak k by a level: min t, ln w_c A_ck(p) <= t, or for the mean with a
// level for each case; other algorithms see the criterion itself. At the end the responses are traced
// anew: if an unwatched peak appears, the search continues from there with it; if a damper sticks, with it
// slipping (start.hpp).
//
// Scatter (criterion worst): uncertain parameters q, q_lower <= q <= q_upper, other than the design
// parameters; the largest amplitude over all q counts. Some q are cases; the worst q at the design found is
// added as another case, until local searches and corners find no higher amplitude (Mutapcic & Boyd 2009).
// Limits apply at the q that are cases.

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/certificate/certificate.hpp>
#include <arcslip/optimize/evaluation/evaluation.hpp>
#include <arcslip/optimize/evaluation/optimum_problem.hpp>
#include <arcslip/optimize/nlopt/minimize.hpp>
#include <arcslip/optimize/peaks/peak_amplitude.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::optimize {

inline constexpr int default_starts = 9;

struct OptimumOptions {
  std::string algorithm{};  // NLopt name; empty: default_algorithm
  Tolerances tolerances{.x_relative = 0,
                        .x_absolute = 1e-7,
                        .f_relative = 0,
                        .f_absolute = 1e-13};  // of ln p, ln A; global algorithms ignore those of f
  int evaluations = 1000;
  int scatter_rounds = 30;  // searches for the worst case of the scatter, >= 1
  double seconds = 0;       // 0: no limit
  std::optional<LocalOptions> local{};
  int population = 0;
  unsigned long seed = 1;
  int threads = 1;  // load cases evaluated at the same time, with the results of one
  bool certificate = true;
  /// With several parameters or with limits: how many designs local searches start from at most, the scene's
  /// own and the lowest of designs sampled over the bounds, each with as many evaluations. 1: only its own.
  /// With limits also by LN_COBYLA from those, and by LN_COBYLA and LD_MMA from the scene's own.
  int starts = default_starts;
  std::function<void(const OptimumProgress&)> progress{};  // called after each evaluation and at the start of
                                                           // each phase
  /// Asked in every phase at each step of each response; at its end the search stops with reason user, or
  /// time_limit, as soon as the current evaluation has ended, or within half a second.
  control::Control control{};
};

/// Where the local searches of one optimum led. A search that comes near a minimum found before it is ended,
/// and counts as one that led there.
struct Starts {
  int count = 1;       // of local searches
  int to_optimum = 1;  // led to as low an amplitude as the optimum's, within same_minimum
  int to_none = 0;     // ended at no minimum, as at a limit of evaluations
  double highest = 0;  // m, the highest minimum that one of them led to
};

inline constexpr double same_minimum = 1e-6;  // of amplitudes, relative

struct Optimum {
  observables::Status status = observables::Status::failed;
  /// Stop::reason: of reasons::of_optima; scatter_limit: after OptimumOptions::scatter_rounds;
  /// not_stationary: most_stationarity, most_complementarity. Complete: the certificate is complete and its
  /// conditions hold.
  observables::Stop stop;
  std::vector<double> design;  // best so far; empty if there is none
  double amplitude = 0;        // criterion there, m: A_max for one case of weight 1
  std::vector<LoadCaseResult>
      cases;                         // of the problem, each with some values of the scatter; then those added
  observables::ResponsePoint point;  // at the highest peak of the case of highest w_c A_c
  bool feasible = false;             // all limits hold at `design`
  std::string algorithm;
  bool epigraph = false;         // epigraph form: several peaks, each a constraint
  int scatter_rounds = 0;        // searches for the worst case of the scatter
  std::optional<Starts> starts;  // of a search from several designs
  std::vector<Evaluation> evaluations;
  PeakWork work;                   // of all cases
  double seconds = 0;              // of the search and its certificate
  std::vector<std::string> notes;  // changes and observations: a start that was moved, new peaks
  std::optional<Certificate> certificate;
};

/// Starts from the scene's own values of the parameters. Throws OptionsError for invalid input: missing,
/// reversed or equal bounds, bounds beyond those of the parameter, a duplicate name, an unknown algorithm or
/// observable, a weight that is not positive, a case or scatter in a design parameter, an invalid response of
/// a case, scatter with the mean; scene::ParameterError for an unknown parameter.
Optimum optimum(const scene::Scene& scene, const OptimumProblem& problem, const OptimumOptions& options = {});

/// The direct method, for one parameter and without cases: the lowest minimum of the amplitude on the
/// curves of resonance peaks at which no other peak is higher. None if A_max has its minimum where two
/// peaks are equally high, or at a bound. Throws as optimum(), and OptionsError for several parameters,
/// cases, or scatter.
struct DirectOptimum {
  bool found = false;
  observables::ResponsePoint point;                 // `over` is the parameter
  std::vector<observables::ResponseBranch> curves;  // of peaks over the bounds
  std::string message;                              // why there is none
};
/// control: at its end the curves so far are the result.
DirectOptimum direct_optimum(const scene::Scene& scene, const OptimumProblem& problem,
                             const control::Control& control = {});

/// Its curves: of the resonance peaks over the only parameter, without those below 0.3 of the highest peak
/// wherever they are looked for; none with sampled friction. The cases and limits of the problem do not
/// count.
std::vector<observables::ResponseBranch> curves_of_peaks(const scene::Scene& scene,
                                                         const OptimumProblem& problem,
                                                         const control::Control& control = {});

}  // namespace arcslip::optimize
