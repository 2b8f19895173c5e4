#pragma once
// Where a trace ends: at its window, at a limit of its options, back at its start. Not installed.

#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/continuation/tracing/place.hpp>
#include <arcslip/continuation/tracing/trial.hpp>

#include <optional>

namespace arcslip::continuation {

// The window of the free parameter: where a step leaves it.

struct Window {
  double lower, upper;
};

/// The share of a step at which it leaves the window, and the bound that it passes.
struct Exit {
  double share, bound;
};

/// Where the cubic between two places at a distance first leaves the window. straight: the line instead, as
/// for a step with a kink. Nothing where it does not.
std::optional<Exit> leaves(const Window& window, const Place& from, const Place& to, double length,
                           bool straight);

/// The same of a step from `here`, section by section: trial.end becomes the end of the section in which it
/// leaves, and no corners beyond it are left.
std::optional<Exit> leaves(const Window& window, const Place& here, Trial& trial);

/// From `place`, beyond the window, back to the bound, with its tangent. False where there is no such
/// solution on this branch: none, one farther away than the step is long, or, with `orientation` the sign of
/// the determinant on the branch there, one of the other sign. 0: not known. row: work space, n + 1; on
/// return, that of the factors.
bool draw_back(Corrector& with, const Place& from, const Exit& exit, int orientation, Place& place,
               Vector& row);

/// Whether a branch with these last two points comes nearer to a bound of the window for ever: with the
/// distance x = |p - bound|, x |du/dp| is how much u changes until x is 1/e of what it is. Towards a point at
/// the bound it falls as a power of x, 1/2 at a fold; where u goes to infinity it does not.
bool runs_along(const Corrector& in, const Place& before, const Place& here, double bound);

// The limits of a trace: state, points, time, memory.

/// The limit that is reached, if any. size: |u| in scales, at the parameter; seconds: since the trace began.
std::optional<Stop> limit_reached(const Options& options, const Branch& branch, int unknowns, double size,
                                  double parameter, double seconds);

// Closed branches: whether a step comes back to the start.

/// Whether the start may lie on the step between two places at a distance. v becomes the place where their
/// cubic meets the plane through the start across its tangent. largest_angle: between the tangents there.
bool may_come_home(const Corrector& in, const Place& start, const Place& from, const Place& to, double length,
                   double largest_angle, Vector& v);

/// The distance within which two solutions beside the start are one. rounding_level: of the corrector.
double rounding_of_home(const Corrector& in, const Place& start, double rounding_level);

}  // namespace arcslip::continuation
