#pragma once
// The optimum as a function of another parameter s, such as the level of the excitation: the design of least
// resonance for every s in a range, by continuation of its own equations (optimality.hpp) from the optimum at
// the lower end.
//
//   const auto curve = optimum_curve(scene, {{{"damper.normal_load", 0.5, 60}}, 15, 60}, {"force.cosine", 1,
//   8}); for (const OptimumPoint& at : curve.points) use(at.along, at.design[0], at.amplitude);
//
// A piece of the curve has one set of active peaks, those that are equally high and highest, and of bounds
// that hold parameters. It ends where that set changes, which is an event, and the next piece begins there:
// a parameter comes to its bound, or leaves it since the multiplier of the bound vanishes; another peak
// becomes as high; the weight of a peak vanishes. Where an active peak ceases to be of its kind (a resonance
// comes to a corner, at which an element begins to slip) the next piece begins a little beyond, with the peak
// as it is in a new response. The curve passes turning points in s; beyond one its points are saddles, no
// minima, and say so.
//
// Every so often, and at the end, the response at the last point is traced: where a peak has come up that was
// not followed, the way since the last response is gone again with more of them. If that does not tell whence
// the peak came, the curve ends there and says so: it never jumps.

#include <arcslip/observables/event_kinds.hpp>
#include <arcslip/optimize/search/optimum.hpp>

#include <functional>
#include <string>
#include <vector>

namespace arcslip::optimize {

struct OptimumPeak {
  PeakKind kind = PeakKind::resonance;
  double omega = 0;   // rad/s
  double weight = 1;  // its multiplier: those of the active peaks add up to 1
};

struct OptimumPoint {
  double along = 0;            // s
  std::vector<double> design;  // of the optimum there
  double amplitude = 0;        // A_max, m
  std::vector<OptimumPeak> peaks;
  observables::ResponsePoint response;  // at the active peak of the largest weight
  std::vector<int> at_bound;  // of each parameter: -1 held at the lower bound, 1 at the upper, 0 free
  bool minimum = true;        // false: a saddle; the second-order condition does not hold
};

/// Kinds of events of a curve of optima.
namespace event_kinds {

using observables::event_kinds::maximum;
using observables::event_kinds::minimum;                       // of the amplitude over s
inline constexpr const char* turning_point = "turning_point";  // in s
inline constexpr const char* bound_reached = "bound_reached";  // the active set changes
inline constexpr const char* bound_left = "bound_left";
inline constexpr const char* peak_joins = "peak_joins";
inline constexpr const char* peak_leaves = "peak_leaves";
inline constexpr const char* peak_changes = "peak_changes";  // an active peak becomes one of another kind

}  // namespace event_kinds

struct OptimumEvent {
  std::string kind;        // of event_kinds
  std::string parameter;   // of a bound
  double omega = 0;        // of the peak that joins, leaves or changes, rad/s
  bool nonsmooth = false;  // of a turning point: at another event, where the active set changes
  OptimumPoint point;
  std::size_t after = 0;  // index of the point before it
};

struct OptimumCurveWork {
  int pieces = 0;
  long points = 0;       // accepted by the continuation
  long evaluations = 0;  // of the equations: designs at which the active peaks were asked for
  long hessians = 0;     // those with second derivatives
  PeakWork peaks;        // of the curve, without the search for its first point
  double seconds = 0;    // of all
};

struct OptimumCurve {
  /// complete: up to the upper end of the range. stopped: right as far as it goes.
  observables::Status status = observables::Status::failed;
  /// reason: of reasons::of_optimum_curves, that of the first optimum where it is none, or that of the
  /// continuation. objective_failed: something threw (the progress callback, too).
  observables::Stop stop;
  std::string along;
  Optimum start;  // the first optimum
  std::vector<OptimumPoint> points;
  std::vector<OptimumEvent> events;  // in the order of the curve
  std::vector<std::string> notes;    // what was changed: a parameter without influence that was moved
  OptimumCurveWork work;
};

struct OptimumCurveOptions {
  OptimumOptions
      search{};        // of the first optimum, without its certificate; go_on is asked along the curve, too
  int points = 1000;   // at most
  double seconds = 0;  // 0: no limit
  double step = 0.02;  // largest, as a share of the range of ln s (of s where the range touches zero)
  std::function<bool(const OptimumPoint&)> progress{};  // after each point; false stops
};

/// From the scene's own values of the design's parameters, with s at along.lower, to along.upper. Throws as
/// optimum() does, and OptionsError for options out of bounds, where the design is over s as well, or where
/// there are limits, cases or scatter: such optima are not followed.
OptimumCurve optimum_curve(const scene::Scene& scene, const OptimumProblem& problem,
                           const DesignVariable& along, const OptimumCurveOptions& options = {});

}  // namespace arcslip::optimize
