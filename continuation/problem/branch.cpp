#include <arcslip/continuation/problem/branch.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace arcslip::continuation {

const char* name(Criticality criticality) {
  switch (criticality) {
    case Criticality::supercritical:
      return "supercritical";
    case Criticality::subcritical:
      return "subcritical";
    case Criticality::unknown:
      break;
  }
  return "unknown";
}

std::vector<StabilityRange> stability_ranges(const Branch& branch) {
  std::vector<StabilityRange> ranges;
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    const auto& spectrum = branch.points[i].spectrum;
    if (!spectrum) {
      if (!ranges.empty()) ranges.back().last = i;
    } else if (!ranges.empty() && ranges.back().unstable == spectrum->unstable) {
      ranges.back().last = i;
      ranges.back().complete = ranges.back().complete && spectrum->complete;
    } else {
      ranges.push_back({ranges.empty() ? 0 : i, i, spectrum->unstable, spectrum->complete});
    }
  }
  return ranges;
}

const char* name(StopReason reason) {
  switch (reason) {
    case StopReason::boundary:
      return "boundary";
    case StopReason::closed:
      return "closed";
    case StopReason::event:
      return "event";
    case StopReason::start_failed:
      return "start_failed";
    case StopReason::step_too_small:
      return "step_too_small";
    case StopReason::state_too_large:
      return "state_too_large";
    case StopReason::point_limit:
      return "point_limit";
    case StopReason::time_limit:
      return "time_limit";
    case StopReason::memory_limit:
      return "memory_limit";
    case StopReason::user:
      return "user";
    case StopReason::not_evaluated:
      return "not_evaluated";
    case StopReason::monitor_failed:
      return "monitor_failed";
    case StopReason::wrong_jacobian:
      return "wrong_jacobian";
    case StopReason::known_branch:
      return "known_branch";
  }
  return "unknown";
}

void hermite(const Vector& v0, const Vector& t0, const Vector& v1, const Vector& t1, double length, double s,
             Vector& v) {
  const double s2 = s * s, s3 = s2 * s;
  v = (2 * s3 - 3 * s2 + 1) * v0 + (3 * s2 - 2 * s3) * v1 +
      length * ((s3 - 2 * s2 + s) * t0 + (s3 - s2) * t1);
}

Point interpolate(const Branch& branch, double arclength) {
  constexpr double rounding = 1e-14;
  const auto& points = branch.points;
  const double first = points.empty() ? 0 : points[0].arclength,
               last = points.empty() ? 0 : points.back().arclength;
  const double beyond = rounding * std::max(std::abs(first), std::abs(last));
  if (points.empty() || !(arclength >= first - beyond && arclength <= last + beyond) ||
      points[0].u.size() == 0)
    throw std::out_of_range("the branch has no points around arclength " + std::to_string(arclength));
  arclength = std::clamp(arclength, first, last);
  const auto above = std::upper_bound(points.begin() + 1, points.end(), arclength,
                                      [](double s, const Point& x) { return s < x.arclength; });
  const Point& b = above == points.end() ? points.back() : *above;
  const Point& a = points.size() == 1 ? b : *(above == points.end() ? above - 2 : above - 1);
  const Eigen::Index n = a.u.size();
  Vector va(n + 1), vb(n + 1), v(n + 1);
  va << a.u, a.parameter;
  vb << b.u, b.parameter;
  const double length = b.arclength - a.arclength,
               share = length > 0 ? (arclength - a.arclength) / length : 0;
  hermite(va, a.tangent, vb, b.tangent, length, share, v);
  Point point;
  point.u = v.head(n);
  point.parameter = v[n];
  point.tangent = (1 - share) * a.tangent + share * b.tangent;
  point.arclength = arclength;
  return point;
}

}  // namespace arcslip::continuation
