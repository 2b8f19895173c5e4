#pragma once
// Monitors: scalar functions along a branch, whose zeros are its events.

#include <arcslip/continuation/events/scratch.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace arcslip::continuation {

/// An accepted solution with everything computed for it. `at` and `bordered`, the factors of [J F_p; r^T],
/// belong to the start of the last correction, within the corrector's tolerance of (u, p), or within 1e-7
/// where a smooth problem allows that (NewtonOptions::tolerance); at an event to (u, p). For an observer,
/// `at` is at (u, p) itself. At a branch point, whose own matrix may be singular to the last bit, `bordered`
/// belongs to the next point of the branch.
struct Accepted {
  In u;        // n
  In p;        // all parameters
  In tangent;  // n + 1: du/ds, dp/ds of the free parameter
  double arclength;
  Evaluator& at;
  const LinearSolver& bordered;
  double parameter;                  // value of the free one
  Scratch& scratch;                  // of this trace: data that monitors keep between calls
  int free = 0;                      // index of the free parameter
  const Problem* problem = nullptr;  // of this trace
};

/// An event by equations of its own, more accurate than as a zero along the branch.
struct RefinedEvent {
  Vector v;  // (u, p), n + 1
  EventData data;
};

/// The sign changes that count, in the direction of travel along the branch.
enum class Crossing { any, falling, rising };

/// The events of a monitor: zeros of its value, or branch points or kinks, for which the value is ignored.
enum class MonitorKind { zero, branch_point, kink };

/// A monitor is called by one trace at a time, and copies of it by several traces at once: shared mutable
/// data belongs in Accepted::scratch.
struct Monitor {
  std::string name;
  std::function<double(const Accepted&)> value;
  Crossing crossing = Crossing::any;

  /// If value() is the slope dq/ds of a quantity: q, called after value() at the same point. Steps are then
  /// kept short enough that the slopes at both ends determine q in between, so that no pair of extrema is
  /// missed within a step. A zero is an event only if q changes between it and the neighbouring zeros by more
  /// than the rounding error of q: see EventLocator.
  std::function<double(const Accepted&)> quantity = {};

  /// The data of a smooth event, in addition to its point. The evaluator is at the event, and may be moved.
  std::function<EventData(const Accepted&)> describe = {};

  /// Whether the branch ends at the first event.
  bool terminal = false;

  MonitorKind kind = MonitorKind::zero;

  /// Whether a zero of value() is an event, called at each zero found (not for slopes of a quantity). None:
  /// every zero is an event.
  std::function<bool(const Accepted&)> is_event = {};

  /// If value() is the slope of quantity(): steps are limited so that the curve of q over the free parameter
  /// p deviates from the chords between its points by no more than this relative tolerance, of q or of p. 0:
  /// no limit.
  double chord_tolerance = 0;

  /// If value() is the slope of quantity(): steps are divided at their kinks, so that the slopes on both
  /// sides decide about a zero there, but at those across which the step is resolved to the curve tolerance
  /// and no slope changes its sign. False: steps are not divided, as for many small kinks.
  bool divides_at_kinks = true;

  /// If quantity() is the maximum of several smooth quantities: the index of the largest, called after
  /// value() at the same point. Steps are divided where it changes, as at kinks of F. Both functions are also
  /// called next to the branch, with the tangent of another point.
  std::function<std::uint64_t(const Accepted&)> part = {};

  /// Whether a zero of value() at a branch point is an event of this monitor as well. False for dp/ds.
  bool at_branch_points = true;

  /// quantity() is the free parameter, whose scale is known: steps are not shortened to find extrema that
  /// differ by less than 1e-9 of it, as in a tail in which p decays to 0.
  bool quantity_is_parameter = false;

  /// A smooth event to rounding, from the place where it was found. Nothing: that place stays, and is
  /// described.
  std::function<std::optional<RefinedEvent>(const Accepted&)> refine = {};
};

/// dp/ds = 0: folds in the free parameter, with their null vectors and curvature; at a nonsmooth fold dp/ds
/// jumps. A branch that turns at a crossing, such as the arms of a pitchfork, has no fold there: F_p lies in
/// the range of J, and the point is a branch point (branch_point_monitor()).
Monitor fold_monitor();
inline constexpr const char* fold_event = "fold";  // name of the monitor and its events

/// A bound of an unknown: terminal, with an event where u[index] = value. On a curve of special points the
/// second parameter is such an unknown. (For the bounds of the free parameter see Options::lower, upper and
/// Parameter::lower, upper.)
Monitor bound_monitor(std::string name, int index, double value);

/// Simple branch points, with the tangents of both branches. Nonsmooth if pieces meet there: the first
/// tangent is then the one before, the second the one beyond. A linear solver without the sign of the
/// determinant finds those on smooth pieces only.
Monitor branch_point_monitor();

/// Kinks of piecewise smooth problems (Evaluator::piece): jumps of the tangent, with the tangents of both
/// sides. A change of piece with a continuous tangent is no event.
Monitor kink_monitor();

}  // namespace arcslip::continuation
