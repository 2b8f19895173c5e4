#include <arcslip/continuation/correction/curve_point.hpp>

#include <arcslip/continuation/events/monitor_calls.hpp>

#include <cmath>

namespace arcslip::continuation {

void CurvePoint::reverse() {
  tangent = -tangent;
  orientation = -orientation;
}

bool settle(Corrector& at, CurvePoint& place) {
  if (!at.tangent(place.tangent)) return false;
  place.orientation = at.factors().determinant_sign().value_or(0);
  return at.piece(place.piece);
}

Accepted accepted(Corrector& at, const CurvePoint& place) {
  const Eigen::Index n = place.v.size() - 1;
  return {place.v.head(n), at.parameters(), place.tangent, place.arclength, at.evaluator(),
          at.factors(),    place.v[n],      at.scratch(),  at.free(),       &at.problem()};
}

void evaluate(const std::vector<Monitor>& monitors, Corrector& at, CurvePoint& place) {
  const Accepted now = accepted(at, place);
  place.monitors.resize(monitors.size());
  place.quantities.resize(monitors.size());
  place.part = 0;
  for (std::size_t m = 0; m < monitors.size(); ++m) {
    place.monitors[m] = value_of(monitors[m], now);
    place.quantities[m] = quantity_of(monitors[m], now);
    place.part = with_part(place.part, monitors[m], now);
  }
}

Point point(const CurvePoint& place, const Correction& correction) {
  const Eigen::Index n = place.v.size() - 1;
  return {place.v.head(n),       place.v[n],     place.tangent, place.arclength,
          correction.iterations, correction.last};
}

double distance(const Corrector& in, const Vector& a, const Vector& b) {
  const Vector d = b - a;
  return std::sqrt(in.dot(d, d));
}

}  // namespace arcslip::continuation
