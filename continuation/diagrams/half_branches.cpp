// The half-branches of a branch point: their directions, entry points, and which are already traced.

#include <arcslip/continuation/diagrams/branch_parts.hpp>
#include <arcslip/continuation/diagrams/diagram_tracer.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::continuation {
namespace {

constexpr double longest_entry = 1e-3, shortest_entry = 1e-6;  // h, relative to 1 + |u|
constexpr double entry_reduction = 0.25;                       // of the step, until it is on the half-branch
constexpr double entry_error = 0.25;   // of the distance to the nearest other half-branch
constexpr double entry_turn = 0.3;     // of the angle to it
constexpr double near_segment = 0.05;  // of a segment, beyond its ends: still next to it
constexpr double same_point = 1e-2;    // of h
constexpr int oblique_probes = 8;      // directions in which pieces are searched for

}  // namespace

// Where pieces meet: the tangents of the linearizations around, as far as the solutions along them exist.
void DiagramTracer::look_for_others(Junction& junction, const Vector& x, const BranchPoint& known) {
  const Eigen::Index n = junction.u.size();
  const double way = longest_entry * (1 + with_->norm_u(x));
  std::vector<Vector> probes{known.tangents.front(), known.tangents.back(), Vector::Unit(n + 1, n)};
  for (int k = 0; k < oblique_probes; ++k) {
    Vector oblique(n + 1);
    for (Eigen::Index i = 0; i <= n; ++i)
      oblique[i] = std::sin(1.0 + static_cast<double>((i + 1) * (2 * k + 3)));
    probes.push_back(oblique / std::sqrt(with_->dot(oblique, oblique)));
  }
  const std::size_t traced = junction.half_branches.size();
  for (const Vector& probe : probes)
    for (const double side : {1.0, -1.0}) {
      Vector tangent(n + 1);
      if (!with_->linearize(x + side * way * probe, with_->border_row(probe)) || !with_->tangent(tangent))
        continue;
      for (const double sign : {1.0, -1.0}) {
        const Vector direction = sign * tangent;
        if (nearest(junction, direction)) continue;
        Vector v = x + way * direction;
        const Vector predicted = v;
        if (!with_->correct(v, with_->border_row(direction), false).converged ||
            distance(*with_, v, predicted) > 0.1 * way)
          continue;
        junction.half_branches.push_back({(v - x) / distance(*with_, v, x), -1, {}});
      }
    }
  const std::size_t found = junction.half_branches.size();
  if (found == traced + 2) return;
  for (std::size_t i = traced; i < found; ++i)
    junction.half_branches[i].untraced = "where pieces meet, " + std::to_string(found) +
                                         " half-branches leave: branch switching is not supported there";
}

// The first solution on a half-branch, so near that no other is meant. Nothing where there is none, or where
// it lies on a branch that is known.
std::optional<Entry> DiagramTracer::enter(std::size_t k, HalfBranch& half) {
  const Junction& junction = diagram_.branch_points[k];
  const Vector x = joined(junction.u, junction.parameter);
  const double angle = angle_to_others(junction, half);
  const double size = 1 + with_->norm_u(x);
  const Vector row = with_->border_row(half.direction);
  const Eigen::Index n = x.size() - 1;
  bool inside = false;
  CurvePoint place;
  place.tangent.resize(n + 1);
  for (double step = longest_entry * size; step >= shortest_entry * size; step *= entry_reduction) {
    const Vector predicted = x + step * half.direction;
    place.v = predicted;
    if (!with_->correct(place.v, row, false).converged || !settle(*with_, place)) {
      inside = true;
      continue;
    }
    if (place.v[n] < options_.lower || place.v[n] > options_.upper) continue;
    inside = true;
    if (distance(*with_, place.v, predicted) > entry_error * std::sin(std::min(angle, 1.5)) * step ||
        with_->dot(place.tangent, half.direction) < std::cos(entry_turn * angle))
      continue;
    half.branch = known_branch(place.v, place.tangent, step, angle);
    if (half.branch >= 0) return {};
    Entry entry;
    entry.start.u = place.v.head(n);
    entry.start.p = start_.p;
    entry.start.p[free_] = place.v[n];
    entry.start.free = free_;
    entry.start.tangent = place.tangent;
    entry.step = step;
    entry.origin = k;
    return entry;
  }
  half.untraced = inside ? "no solution was found on the half-branch, apart from the other branch"
                         : "the half-branch leaves the window";
  return {};
}

// The branch that v, entered with `step`, lies on, or -1: there is a solution of it in the plane through v.
int DiagramTracer::known_branch(const Vector& v, const Vector& tangent, double step, double angle) {
  Vector near(v.size());
  for (std::size_t b = 0; b < diagram_.branches.size(); ++b) {
    const auto& points = diagram_.branches[b].branch.points;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Vector from = joined(points[i].u, points[i].parameter);
      const Vector to = joined(points[i + 1].u, points[i + 1].parameter), chord = to - from;
      const double length = std::sqrt(with_->dot(chord, chord));
      if (!(length > 0)) continue;
      const double share = with_->dot(v - from, chord) / (length * length);
      if (!(share >= -near_segment && share <= 1 + near_segment)) continue;
      hermite(from, points[i].tangent, to, points[i + 1].tangent, length, share, near);
      if (distance(*with_, near, v) > near_segment * length) continue;
      const Vector slope = 6 * share * (1 - share) * chord / length +
                           (1 - share) * (1 - 3 * share) * points[i].tangent +
                           share * (3 * share - 2) * points[i + 1].tangent;
      const double cosine = with_->dot(slope, tangent) / std::sqrt(with_->dot(slope, slope));
      if (std::abs(cosine) < std::cos(entry_turn * angle)) continue;
      near += with_->dot(v - near, tangent) * tangent;
      if (with_->correct(near, with_->border_row(tangent), false).converged &&
          distance(*with_, near, v) < same_point * step)
        return static_cast<int>(b);
    }
  }
  return -1;
}

double DiagramTracer::angle_to_others(const Junction& junction, const HalfBranch& half) const {
  double largest = 0;
  for (const HalfBranch& other : junction.half_branches)
    if (&other != &half) largest = std::max(largest, with_->dot(other.direction, half.direction));
  return std::acos(largest);
}

std::optional<std::size_t> DiagramTracer::nearest(const Junction& junction, const Vector& direction) const {
  std::optional<std::size_t> found;
  double best = same_direction;
  for (std::size_t i = 0; i < junction.half_branches.size(); ++i) {
    const double cosine = with_->dot(junction.half_branches[i].direction, direction);
    if (cosine <= best) continue;
    best = cosine;
    found = i;
  }
  return found;
}

std::size_t DiagramTracer::half_towards(Junction& junction, const Vector& direction) {
  if (const auto found = nearest(junction, direction)) return *found;
  junction.half_branches.push_back({direction, -1, {}});
  return junction.half_branches.size() - 1;
}

}  // namespace arcslip::continuation
