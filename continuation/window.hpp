#pragma once
// The window of the free parameter: where a step leaves it.

#include <arcslip/continuation/place.hpp>

#include <optional>

namespace arcslip::continuation {

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

/// From `place`, beyond the window, back to the bound, with its tangent. False where there is no such
/// solution on this branch: none, one farther away than the step is long, or, with `orientation` the sign of
/// the determinant on the branch there, one of the other sign. 0: not known. row: work space, n + 1; on
/// return, that of the factors.
bool draw_back(Corrector& with, const Place& from, const Exit& exit, int orientation, Place& place,
               Vector& row);

}  // namespace arcslip::continuation
