#pragma once
// A point of a branch during tracing: a solution with its oriented tangent and the values of the monitors.
// The tracer keeps the last two; events are located between them.

#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/problem/branch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace arcslip::continuation {

constexpr double visible_corner = 0.05;  // rad: smaller kinks are invisible in a plotted curve

struct CurvePoint {
  Vector v, tangent;  // n + 1: (u, p) and d(u, p)/ds
  double arclength = 0;
  int orientation = 1;  // sign of det [J F_p; t^T]: the same on both sides of a kink; 0: not known
  std::uint64_t piece = 0;
  std::vector<double> monitors, quantities;  // as many as monitors
  std::uint64_t part = 0;                    // combined Monitor::part of the quantities

  void reverse();
};

/// A kink, seen from both sides: the end of the piece before it, and the start of the piece beyond.
struct PassedKink {
  CurvePoint before, beyond;
};

/// Sets tangent, orientation and piece at the solution place.v of the last correction, with row . t > 0 for
/// its border row. False if the tangent is not finite or the piece cannot be determined.
bool settle(Corrector& at, CurvePoint& place);

/// A place as passed to monitors and observers. The factors are those of the corrector's last linearization.
Accepted accepted(Corrector& at, const CurvePoint& place);

/// Sets place.monitors, place.quantities and place.part.
void evaluate(const std::vector<Monitor>& monitors, Corrector& at, CurvePoint& place);

/// A place as stored in the branch.
Point point(const CurvePoint& place, const Correction& correction);

/// |b - a| in scales.
double distance(const Corrector& in, const Vector& a, const Vector& b);

/// The angle between two unit vectors with this inner product, rad.
inline double angle_between(double cosine) {
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

}  // namespace arcslip::continuation
