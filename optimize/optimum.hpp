#pragma once
// The design of least resonance: values of named parameters, a normal load or any other, for which the
// largest amplitude in a window of the excitation frequency is least.
//
//   minimise A_max(p) over lower <= p <= upper, limits on observables of the peaks, linear limits on p
//
// Limits hold at every peak that is watched (peak_amplitude.hpp), so that they do not jump where two peaks
// are equally high. Searched is ln(A_max) over ln p (over p where a range touches zero or both signs). Where
// several peaks are watched, algorithms with gradients and constraints solve min t, ln A_k(p) <= t
// (epigraph); the others see the largest. At the end the response is traced anew: where a peak shows that was
// not watched, the search goes on from there with it.

#include <arcslip/observables/response.hpp>
#include <arcslip/optimize/certificate.hpp>
#include <arcslip/optimize/minimize.hpp>
#include <arcslip/optimize/peak_amplitude.hpp>
#include <arcslip/scene/scene.hpp>

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::optimize {

using scene::DesignVariable;
using scene::LinearLimit;
using scene::ObservableLimit;

struct OptimumProblem {
  std::vector<DesignVariable> over;
  double frequency_from = 0, frequency_to = 0;  // window, in the scene's unit
  std::vector<ObservableLimit> limits{};
  std::vector<LinearLimit> linear_limits{};
};

struct OptimumProgress {
  int evaluations = 0;
  std::span<const double> design;  // of the last one
  double omega = 0;                // of its highest peak, rad/s; 0 where there is none
  double amplitude = 0, best = 0;  // m; of the last one, and the least so far where all limits hold
};

struct OptimumOptions {
  std::string algorithm{};  // by NLopt's own name; empty: LD_SLSQP
  Tolerances tolerances{
      .x_relative = 0, .x_absolute = 1e-7, .f_relative = 0, .f_absolute = 1e-13};  // of ln p, ln A
  int evaluations = 1000;
  double seconds = 0;  // 0: no limit
  std::optional<LocalOptions> local{};
  int population = 0;
  unsigned long seed = 1;
  bool certificate = true;
  std::function<bool(const OptimumProgress&)> progress{};  // after each evaluation; false stops
};

/// A design that was tried.
struct Evaluation {
  std::vector<double> design;
  double amplitude = 0;  // m; infinity where it is unbounded
};

struct Optimum {
  observables::Status status = observables::Status::failed;
  /// reason: the name of a Reason, or "flat" (the amplitude does not depend on the design), "unbounded" (it
  /// is infinite wherever it was looked at), "no_response".
  observables::Stop stop;
  std::vector<double> design;        // best so far; empty where there is none
  double amplitude = 0;              // A_max there, m
  observables::ResponsePoint point;  // at the highest peak
  bool feasible = false;             // all limits hold there
  std::string algorithm;
  bool epigraph = false;  // several peaks, each a constraint
  std::vector<Evaluation> evaluations;
  PeakWork work;
  double seconds = 0;              // of the search and its certificate
  std::vector<std::string> notes;  // what was changed or seen: a start that was moved, peaks that came up
  std::optional<Certificate> certificate;
};

/// From the scene's own values of the parameters. Throws OptionsError for bad input: no, reversed or equal
/// bounds, bounds that the parameters may not take, a name twice, an unknown algorithm or observable;
/// scene::ParameterError for an unknown parameter.
Optimum optimum(const scene::Scene& scene, const OptimumProblem& problem, const OptimumOptions& options = {});

/// The direct way, over one parameter: the least minimum of A_max on the curves of resonance peaks.
struct DirectOptimum {
  bool found = false;
  observables::ResponsePoint point;                 // `over` is the parameter
  std::vector<observables::ResponseBranch> curves;  // of peaks over the bounds
  std::string message;                              // where there is none
};
DirectOptimum direct_optimum(const scene::Scene& scene, const OptimumProblem& problem);

}  // namespace arcslip::optimize
