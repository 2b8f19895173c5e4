#include <arcslip/laws/contact/slip_onset.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace arcslip::elements {
namespace {

constexpr double least_step = 1e-10;  // rad
constexpr int most_steps = 10000;
constexpr int onset_newton_steps = 40;

// A lower bound of the first positive root of a polynomial that begins with positive coefficients: the root
// of the one without the positive coefficients behind a negative one, which has one root. At most `most`.
double first_root(std::array<double, 7> c, double most) {
  std::size_t changes = 0;
  while (changes < c.size() && c[changes] >= 0) ++changes;
  for (std::size_t k = changes; k < c.size(); ++k) c[k] = std::min(c[k], 0.0);
  const auto at = [&](double s) {
    double value = 0, slope = 0;
    for (std::size_t k = c.size(); k-- > 0;) {
      slope = slope * s + value;
      value = value * s + c[k];
    }
    return std::pair(value, slope);
  };
  double below = 0, above = most, s = most;
  for (int i = 0; i < onset_newton_steps; ++i) {
    const auto [value, slope] = at(s);
    if (value >= 0) {
      below = s;
      if (s == most) return most;
    } else {
      above = s;
    }
    const double newton = s - value / slope;
    // From far above it would go on in small steps, as the highest power does.
    const bool far = below == 0 && newton > 0.7 * s && newton < 0.9 * s;
    const bool good = slope < 0 && newton > below && newton < above && !far;
    const double next = good ? newton : 0.5 * (below + above);
    if (std::abs(next - s) <= 1e-15 * s) break;
    s = next;
  }
  return s;
}

}  // namespace

double slip_onset(const Disc& disc, const Eigen::Vector2d& w, bool at_edge, double begin, double end) {
  if (!(disc.motion_bound(1) > 0) && !(disc.radius_bound(1) > 0))
    return std::numeric_limits<double>::infinity();
  const double r3 = -(disc.motion_bound(3) + disc.radius_bound(3)) / 6;
  double theta = begin;
  for (int i = 0; i < most_steps && theta < end; ++i) {
    const DiscPoint p = disc.at(theta);
    const Eigen::Vector2d y = p.x - w, a = 0.5 * p.a;
    const double d = y.norm(), r2 = 0.5 * p.ddh;
    const bool edge_now = at_edge && i == 0;
    std::array<double, 7> c = {(p.h - d) * (p.h + d),
                               2 * (p.h * p.dh - y.dot(p.v)),
                               p.dh * p.dh + 2 * p.h * r2 - p.v.squaredNorm() - 2 * y.dot(a),
                               2 * (p.h * r3 + p.dh * r2 - p.v.dot(a)),
                               r2 * r2 + 2 * p.dh * r3 - a.squaredNorm(),
                               2 * r2 * r3,
                               r3 * r3};
    if (edge_now) {
      c[0] = 0;
      c[1] = std::max(c[1], 0.0);
    } else if (c[0] <= 0) {
      return theta;
    }
    const double step = first_root(c, end - theta);
    if (edge_now)
      theta += std::max(0.5 * step, least_step);
    else if (c[1] < 0 && !(step > 1e-15 * whole_turn))
      return theta;
    else
      theta += c[1] < 0 ? step : std::max(step, least_step);
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace arcslip::elements
