#include <arcslip/continuation/closing.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::continuation {
namespace {

constexpr int bisections = 30;
constexpr double beside = 0.05;        // of a step: a start so near to it may lie on it
constexpr double rounding_share = 10;  // of the corrector's: two solutions nearer than that are one

}  // namespace

bool may_come_home(const Corrector& in, const Place& start, const Place& from, const Place& to, double length,
                   double largest_angle, Vector& v) {
  if (from.arclength == 0) return false;
  const auto ahead = [&](const Vector& place) { return in.dot(start.v - place, start.tangent); };
  double lower = 0, upper = 1, a = ahead(from.v), b = ahead(to.v);
  if (!(a > 0 && b <= beside * length) || distance(in, from.v, start.v) > (1 + beside) * length) return false;
  if (in.dot(start.tangent, to.tangent) < std::cos(largest_angle)) return false;
  v = to.v;
  for (int k = 0; k < bisections && b < 0; ++k) {
    const double middle = lower + (upper - lower) * std::clamp(a / (a - b), 0.1, 0.9);
    hermite(from.v, from.tangent, to.v, to.tangent, length, middle, v);
    const double at = ahead(v);
    (at > 0 ? lower : upper) = middle;
    (at > 0 ? a : b) = at;
  }
  return distance(in, v, start.v) <= beside * length;
}

double rounding_of_home(const Corrector& in, const Place& start, double rounding_level) {
  const double p = std::abs(start.v[start.v.size() - 1]) / in.parameter_scale();
  return rounding_share * rounding_level * (1 + in.norm_u(start.v) + p);
}

}  // namespace arcslip::continuation
