#pragma once
// Closed branches: whether a step comes back to the start.

#include <arcslip/continuation/place.hpp>

namespace arcslip::continuation {

/// Whether the start may lie on the step between two places at a distance. v becomes the place where their
/// cubic meets the plane through the start across its tangent. largest_angle: between the tangents there.
bool may_come_home(const Corrector& in, const Place& start, const Place& from, const Place& to, double length,
                   double largest_angle, Vector& v);

/// The distance within which two solutions beside the start are one. rounding_level: of the corrector.
double rounding_of_home(const Corrector& in, const Place& start, double rounding_level);

}  // namespace arcslip::continuation
