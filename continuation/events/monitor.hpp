#pragma once
// Monitors: scalar functions on a branch whose zeros are its events.

#include <arcslip/continuation/events/scratch.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/problem.hpp>

#include <cstdint>
#include <functional>
#include <string>

namespace arcslip::continuation {

/// An accepted solution with all that was computed for it. `at` and `bordered`, the factors of [J F_p; r^T],
/// stand where the last correction began: within the corrector's tolerance of (u, p). An observer finds `at`
/// at (u, p) itself. At a branch point, whose own matrix may be singular to the last bit, `bordered` is that
/// of the next point of the branch.
struct Accepted {
  In u;        // n
  In p;        // all parameters
  In tangent;  // n + 1: du/ds, dp/ds of the free parameter
  double arclength;
  Evaluator& at;
  const LinearSolver& bordered;
  double parameter;  // value of the free one
  Scratch& scratch;  // of this trace: what monitors keep between calls
};

/// Which changes of sign count, along the branch in the direction of travel.
enum class Crossing { any, falling, rising };

/// What makes an event of a monitor: its value is zero, a branch point or a kink, whose value is not looked
/// at.
enum class MonitorKind { zero, branch_point, kink };

/// Its functions are called by one trace at a time, and copies of it by several at once: what they change
/// beside their own variables is to stand in Accepted::scratch.
struct Monitor {
  std::string name;
  std::function<double(const Accepted&)> value;
  Crossing crossing = Crossing::any;

  /// Where value() is the slope dq/ds of a quantity: q, asked for after value() at the same place. Steps are
  /// then kept short enough that q between two points is told by its slopes there, so that no pair of
  /// extremes hides in one. And a zero is an event only if q departs from it, before the next zero and from
  /// the last one, by more than the rounding of q: see EventLocator.
  std::function<double(const Accepted&)> quantity = {};

  /// What is kept of an event beside its point, asked for where it is smooth. The evaluator is at the event;
  /// it may be moved.
  std::function<EventData(const Accepted&)> describe = {};

  /// The branch ends at its first event.
  bool terminal = false;

  MonitorKind kind = MonitorKind::zero;

  /// Whether a zero of value() is an event at all, asked where one was found (not of slopes of a quantity).
  /// None: every zero is.
  std::function<bool(const Accepted&)> is_event = {};

  /// Where value() is the slope of quantity(): steps are kept so short that the curve of q over the free
  /// parameter p departs from the chords between its points by no more than this share, of q or of p. 0: not
  /// asked for.
  double chord_tolerance = 0;

  /// Where value() is the slope of quantity(): steps are divided at their kinks, so that a zero there is told
  /// by the slopes on both sides. False: they are taken as they are, as where kinks are many and small.
  bool divides_at_kinks = true;

  /// Where quantity() is the largest of several smooth ones: which of them it is, asked for after value() at
  /// the same place. Steps are divided where it changes, as at kinks of F. Both are asked for beside the
  /// branch as well, where the tangent is another place's.
  std::function<std::uint64_t(const Accepted&)> part = {};

  /// Whether a zero of value() at a branch point is an event of this monitor as well. False: of dp/ds.
  bool at_branch_points = true;

  /// quantity() is the free parameter, whose scale is known: extremes that differ by less than 1e-9 of it are
  /// not looked for by shorter steps, as in a tail in which p falls to 0.
  bool quantity_is_parameter = false;
};

/// dp/ds = 0: a fold in the free parameter, described by its null vectors and its curvature; at a nonsmooth
/// fold dp/ds jumps. A branch that turns where another one crosses it, as the arms of a pitchfork do, has no
/// fold there: F_p lies in the range of J, and it is a branch point (branch_point_monitor()).
Monitor fold_monitor();
inline constexpr const char* fold_event = "fold";  // its name, and so that of its events

/// The unknown u[index] has the value: terminal, a bound of an unknown, as of the second parameter on a curve
/// of special points, which is an unknown there. (The free parameter's own bounds are Options::lower, upper
/// and Parameter::lower, upper.)
Monitor bound_monitor(std::string name, int index, double value);

/// Simple branch points, with the tangents of both branches. Nonsmooth where pieces meet at one: the first
/// tangent is then that before it, the second that beyond. Not located where it is not simple.
/// Needs a linear solver that knows the sign of its determinant and has transposed solves.
Monitor branch_point_monitor();

/// Kinks of piecewise smooth problems (Evaluator::piece): where the tangent jumps, with the tangents of both
/// sides. A change of piece that leaves the tangent as it was is none.
Monitor kink_monitor();

}  // namespace arcslip::continuation
