// The half-branches of a branch point: their directions, entry points, and which are already traced.

#include <arcslip/continuation/diagrams/branch_parts.hpp>
#include <arcslip/continuation/diagrams/diagram_tracer.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::continuation {

// Where pieces meet: the tangents of the linearizations around, as far as the solutions along them exist.
void DiagramTracer::look_for_others(Junction& junction, const Vector& x, const BranchPoint& known) {
  const Eigen::Index n = junction.u.size();
  const double way = limits_.entry.longest * (1 + with_->norm_u(x));
  std::vector<Vector> probes{known.tangents.front(), known.tangents.back(), Vector::Unit(n + 1, n)};
  for (int k = 0; k < limits_.oblique_probes; ++k) {
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
        if (agenda_.nearest(junction, direction, *with_)) continue;
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

// Where a half-branch begins. Nothing where there is no solution on it, or where it lies on a branch that is
// known, which it then belongs to.
std::optional<DiagramTracer::Beginning> DiagramTracer::enter(const Agenda::Place& place) {
  HalfBranch& half = agenda_.at(place);
  const auto entry = agenda_.enter(place, *with_, options_.lower, options_.upper);
  if (!entry) return {};
  half.branch = known_branch(*entry, Agenda::angle_to_others(agenda_.points[place.point], half, *with_));
  if (half.branch >= 0) return {};
  return Beginning{start_at(*entry, start_.p, free_), entry->step, place.point};
}

// The branch that the entry lies on, or -1: there is a solution of it in the plane through the entry.
int DiagramTracer::known_branch(const Entry& entry, double angle) {
  const NearbyOptions& of = limits_.nearby;
  const auto& [v, tangent, step] = entry;
  Vector near(v.size());
  for (std::size_t b = 0; b < diagram_.branches.size(); ++b) {
    const auto& points = diagram_.branches[b].branch.points;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Vector from = joined(points[i].u, points[i].parameter);
      const Vector to = joined(points[i + 1].u, points[i + 1].parameter), chord = to - from;
      const double length = std::sqrt(with_->dot(chord, chord));
      if (!(length > 0)) continue;
      const double share = with_->dot(v - from, chord) / (length * length);
      if (!(share >= -of.segment && share <= 1 + of.segment)) continue;
      hermite(from, points[i].tangent, to, points[i + 1].tangent, length, share, near);
      if (distance(*with_, near, v) > of.segment * length) continue;
      const Vector slope = 6 * share * (1 - share) * chord / length +
                           (1 - share) * (1 - 3 * share) * points[i].tangent +
                           share * (3 * share - 2) * points[i + 1].tangent;
      const double cosine = with_->dot(slope, tangent) / std::sqrt(with_->dot(slope, slope));
      if (std::abs(cosine) < std::cos(limits_.entry.turn * angle)) continue;
      near += with_->dot(v - near, tangent) * tangent;
      if (with_->correct(near, with_->border_row(tangent), false).converged &&
          distance(*with_, near, v) < of.same_point * step)
        return static_cast<int>(b);
    }
  }
  return -1;
}

std::size_t DiagramTracer::half_towards(Junction& junction, const Vector& direction) {
  if (const auto found = agenda_.nearest(junction, direction, *with_)) return *found;
  junction.half_branches.push_back({direction, -1, {}});
  return junction.half_branches.size() - 1;
}

}  // namespace arcslip::continuation
