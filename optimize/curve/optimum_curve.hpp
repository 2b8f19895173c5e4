#pragma once
// The optimum as a function of another parameter s, such as the excitation level: the design that minimizes
// the highest resonance peak for every s in a range, by continuation of the optimality conditions
// (optimality.hpp) from the optimum at the lower end.
//
//   const OptimumProblem problem{{{"damper.normal_load", 0.5, 60}}, 15, 60};
//   const auto curve = optimum_curve(scene, problem, {"force.cosine", 1, 8});
//   for (const OptimumPoint& at : curve.points) use(at.along, at.design[0], at.amplitude);
//
// A piece of the curve has a fixed active set: the peaks that are equally high and highest, and the active
// bounds. It ends where that set changes, which is an event, and the next piece starts there: a parameter
// reaches its bound, or leaves it as the multiplier of the bound vanishes; another peak becomes as high; the
// weight of a peak vanishes. If an active peak changes its kind (a resonance reaches a corner, at which an
// element starts to slip) the next piece starts slightly beyond, with the peak from a new response. The curve
// passes turning points in s, beyond which its points are saddles instead of minima, and marked as such.
//
// At intervals, and at the end, the response at the last point is traced: if a new peak has appeared that was
// not tracked, the section since the last response is repeated with more responses. If these do not show the
// origin of the peak, the curve ends there with a message: it never jumps.

#include <arcslip/optimize/search/optimum.hpp>
#include <arcslip/results/event_kinds.hpp>

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace arcslip::optimize {

struct OptimumPeak {
  PeakKind kind = PeakKind::resonance;
  double omega = 0;   // rad/s
  double weight = 1;  // Lagrange multiplier; those of the active peaks add up to 1
};

struct OptimumPoint {
  double along = 0;            // s
  std::vector<double> design;  // of the optimum there
  double amplitude = 0;        // A_max, m
  std::vector<OptimumPeak> peaks;
  observables::ResponsePoint response;  // at the active peak of the largest weight
  std::vector<int> at_bound;  // of each parameter: -1 fixed at the lower bound, 1 at the upper, 0 free
  bool minimum = true;        // false: a saddle; the second-order condition does not hold
};

/// Kinds of events of a curve of optima, listed in docs/results.md.
namespace event_kinds {

using observables::event_kinds::maximum;
using observables::event_kinds::minimum;  // of the amplitude over s
using results::EventKind;
inline constexpr std::string_view of_optima = "curves of optima";
inline constexpr EventKind turning_point{"turning_point", "turning point",
                                         observables::event_kinds::turn.mark,
                                         "the curve turns in its parameter", of_optima};
inline constexpr EventKind bound_reached{
    "bound_reached", "bound reached", {}, "a `parameter` reaches a bound", of_optima};
inline constexpr EventKind bound_left{
    "bound_left", "bound left", {}, "a `parameter` leaves a bound", of_optima};
inline constexpr EventKind peak_joins{
    "peak_joins", "peak joins", {}, "a further peak, at a `frequency`, becomes as high", of_optima};
inline constexpr EventKind peak_leaves{
    "peak_leaves", "peak leaves", {}, "a peak, at a `frequency`, is no longer as high", of_optima};
inline constexpr EventKind peak_changes{
    "peak_changes",
    "peak changes",
    {},
    "a peak, at a `frequency`, changes its kind, as where a resonance reaches a corner",
    of_optima};

/// Those that no other results have.
inline constexpr std::array of_curves = {turning_point, bound_reached, bound_left,
                                         peak_joins,    peak_leaves,   peak_changes};

}  // namespace event_kinds

struct OptimumEvent {
  std::string kind;        // of event_kinds
  std::string parameter;   // of a bound
  double omega = 0;        // of the peak that joins, leaves or changes, rad/s
  bool nonsmooth = false;  // of a turning point: at another event, where the active set changes
  OptimumPoint point;
  std::size_t after = 0;  // index of the preceding point
};

struct OptimumCurveWork {
  int pieces = 0;
  long points = 0;       // accepted by the continuation
  long evaluations = 0;  // of the equations: designs at which the active peaks were evaluated
  long hessians = 0;     // those with second derivatives
  PeakWork peaks;        // of the curve, without the search for its first point
  double seconds = 0;    // total
};

struct OptimumCurve {
  /// complete: up to the upper end of the range. stopped: correct up to where it ends.
  observables::Status status = observables::Status::failed;
  /// Stop::reason: of reasons::of_optimum_curves, of the search if there is no first optimum, or of the
  /// continuation. objective_failed: an exception, also of the progress callback.
  observables::Stop stop;
  std::string along;
  Optimum start;  // the first optimum
  std::vector<OptimumPoint> points;
  std::vector<OptimumEvent> events;  // in the order of the curve
  std::vector<std::string> notes;    // changes: a parameter without influence that was moved
  OptimumCurveWork work;
};

struct OptimumCurveOptions {
  OptimumOptions
      search{};  // of the first optimum, without its certificate; its control also applies along the curve
  int points = 1000;   // maximum
  double seconds = 0;  // 0: no limit
  double step = 0.02;  // maximum, as a share of the range of ln s (of s if the range includes zero)
  std::function<void(const OptimumPoint&)> progress{};  // after each point
};

/// Continues the optimum from s = along.lower to along.upper; the search for the first optimum starts from
/// the scene's own values. Throws as optimum() does, and OptionsError for invalid options, if s is a design
/// parameter, or for limits, cases or scatter, which are not supported.
OptimumCurve optimum_curve(const scene::Scene& scene, const OptimumProblem& problem,
                           const DesignVariable& along, const OptimumCurveOptions& options = {});

}  // namespace arcslip::optimize
