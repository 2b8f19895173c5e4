#pragma once
// End conditions of a trace: the window, the limits of its options, a closed loop. Not installed.

#include <arcslip/continuation/correction/curve_point.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/continuation/tracing/trial_step.hpp>

#include <optional>

namespace arcslip::continuation {

// The window of the free parameter.

struct Window {
  double lower, upper;
};

/// The share of a step at which it leaves the window, and the bound it crosses.
struct Exit {
  double share, bound;
};

/// Where the cubic between two points, `length` apart, first leaves the window. straight: the chord instead,
/// as for a step with a kink. Nothing if it stays inside.
std::optional<Exit> leaves(const Window& window, const CurvePoint& from, const CurvePoint& to, double length,
                           bool straight);

/// The same of a step from `here`, section by section: trial.end becomes the end of the section in which it
/// leaves, and later corners are dropped.
std::optional<Exit> cut_at_exit(const Window& window, const CurvePoint& here, TrialStep& trial);

/// Moves `place` from beyond the window back to the bound, with its tangent. False if this branch has no such
/// solution: none is found, it is farther away than the length of the step, or its determinant has another
/// sign than `orientation` (0: unknown). row: work space, n + 1; on return the border row of the factors.
bool correct_to_bound(Corrector& with, const CurvePoint& from, const Exit& exit, int orientation,
                      CurvePoint& place, Vector& row);

/// Whether a branch with these last two points approaches a bound of the window asymptotically: with the
/// distance x = |p - bound|, x |du/dp| is the change of u while x decreases by the factor e. Towards a point
/// at the bound it decreases like a power of x, 1/2 at a fold; if u goes to infinity it does not.
bool approaches_asymptotically(const Corrector& in, const CurvePoint& before, const CurvePoint& here,
                               double bound);

// The limits of a trace: state, points, time and memory.

/// The limit reached, if any. timed: Options::control with Options::seconds. size: |u| in scales, at the
/// parameter.
std::optional<BranchStop> limit_reached(const Options& options, const control::Control& timed,
                                        const Branch& branch, int unknowns, double size, double parameter);

// Closed branches: the return to the start.

/// Whether the start may lie on the step between two points, `length` apart. v: set to the point where
/// their cubic intersects the plane through the start normal to its tangent. largest_angle: between the
/// tangents there.
bool may_close(const Corrector& in, const CurvePoint& start, const CurvePoint& from, const CurvePoint& to,
               double length, double largest_angle, Vector& v);

/// The distance below which two solutions near the start are the same. rounding_level: of the corrector.
double closing_tolerance(const Corrector& in, const CurvePoint& start, double rounding_level);

}  // namespace arcslip::continuation
