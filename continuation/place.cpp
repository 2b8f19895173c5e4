#include <arcslip/continuation/place.hpp>

#include <cmath>

namespace arcslip::continuation {
namespace {

constexpr int kink_bisections = 40;

}  // namespace

bool settle(Corrector& at, Place& place) {
  if (!at.tangent(place.tangent)) return false;
  place.orientation = at.factors().determinant_sign().value_or(0);
  place.piece = at.evaluator().piece();
  return true;
}

bool locate_kink(Corrector& with, const Place& from, double length, Place& kink, Correction& last) {
  const Vector row = with.border_row(from.tangent);
  double lower = 0, upper = length;
  kink = from;
  Vector v = from.v;
  for (int k = 0; k < kink_bisections; ++k) {
    const double middle = 0.5 * (lower + upper);
    v = from.v + middle * from.tangent;
    const Correction at = with.correct(v, row, false);
    if (!at.converged || with.evaluator().piece() != from.piece) {
      upper = middle;
      continue;
    }
    lower = middle;
    kink.v = v;
    kink.arclength = from.arclength + middle;
    last = at;
    if (!settle(with, kink)) return false;
  }
  return true;
}

Accepted accepted(Corrector& at, const Place& place) {
  const Eigen::Index n = place.v.size() - 1;
  return {place.v.head(n), at.parameters(), place.tangent, place.arclength,
          at.evaluator(),  at.factors(),    place.v[n]};
}

void evaluate(const std::vector<Monitor>& monitors, Corrector& at, Place& place) {
  const Accepted now = accepted(at, place);
  place.monitors.resize(monitors.size());
  place.quantities.resize(monitors.size());
  for (std::size_t m = 0; m < monitors.size(); ++m) {
    place.monitors[m] = monitors[m].value(now);
    place.quantities[m] = monitors[m].quantity ? monitors[m].quantity(now) : 0;
  }
}

Point point(const Place& place, const Correction& correction) {
  const Eigen::Index n = place.v.size() - 1;
  return {place.v.head(n),       place.v[n],     place.tangent, place.arclength,
          correction.iterations, correction.last};
}

double distance(const Corrector& in, const Vector& a, const Vector& b) {
  const Vector d = b - a;
  return std::sqrt(in.dot(d, d));
}

void hermite(const Vector& v0, const Vector& t0, const Vector& v1, const Vector& t1, double length, double s,
             Vector& v) {
  const double s2 = s * s, s3 = s2 * s;
  v = (2 * s3 - 3 * s2 + 1) * v0 + (3 * s2 - 2 * s3) * v1 +
      length * ((s3 - 2 * s2 + s) * t0 + (s3 - s2) * t1);
}

}  // namespace arcslip::continuation
