#pragma once
// A place on a branch: a solution with its tangent, oriented, and what the monitors say there. The tracer
// keeps the last two; events are located between two of them.

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/tracing/corrector.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace arcslip::continuation {

struct Place {
  Vector v, tangent;  // n + 1: (u, p) and d(u, p)/ds
  double arclength = 0;
  int orientation = 1;  // sign of det [J F_p; t^T]: the same on both sides of a kink
  std::uint64_t piece = 0;
  std::vector<double> monitors, quantities;  // as many as monitors
  std::uint64_t part = 0;                    // which of several smooth ones the quantities are

  void reverse() {
    tangent = -tangent;
    orientation = -orientation;
  }
};

/// A kink, as it is seen from both sides of it: where the piece before it ends, and where that beyond begins.
struct Corner {
  Place before, beyond;
};

/// Tangent, orientation and piece at the solution place.v of the last correction, on the side of its border
/// row: row . t > 0. False where the tangent is not finite, or the piece not told.
bool settle(Corrector& at, Place& place);

/// Whether the corrector's place, v, is still in the smooth piece, or part, that is followed.
using Inside = std::function<bool(const Vector& v)>;

/// Where the smooth piece of `from` ends along its tangent, within [0, length]: the kink, seen from this
/// side. The end of the piece is bisected on the tangent, which costs residuals alone, and corrected onto the
/// branch, again from there: what is left of the way shrinks with its square. `last` is the correction that
/// led there. False where there is no tangent on the way. is_inside: none, or what ends in place of the
/// piece.
bool locate_kink(Corrector& with, const Place& from, double length, Place& kink, Correction& last,
                 const Inside& is_inside = {});

/// What monitors and observers see of a place. The corrector's factors are those of its last linearization.
Accepted accepted(Corrector& at, const Place& place);

/// Fills place.monitors, place.quantities and place.part.
void evaluate(const std::vector<Monitor>& monitors, Corrector& at, Place& place);

/// What the branch keeps of a place.
Point point(const Place& place, const Correction& correction);

/// |b - a| in scales.
double distance(const Corrector& in, const Vector& a, const Vector& b);

/// Of two unit vectors with this product, rad.
inline double angle_between(double cosine) {
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

}  // namespace arcslip::continuation
