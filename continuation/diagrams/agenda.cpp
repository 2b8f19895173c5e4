#include <arcslip/continuation/diagrams/agenda.hpp>

#include <arcslip/continuation/correction/curve_point.hpp>
#include <arcslip/continuation/diagrams/branch_parts.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::continuation {

Start start_at(const Entry& entry, Vector p, int free) {
  const Eigen::Index n = entry.v.size() - 1;
  p[free] = entry.v[n];
  return {entry.v.head(n), std::move(p), free, 1, entry.tangent};
}

Agenda::Agenda(const DiagramOptions& options, Alike alike) : options_(options), alike_(std::move(alike)) {}

Junction Agenda::met(const std::shared_ptr<const Problem>& problem, const Event& event) {
  Junction junction{problem, event.point.u, event.point.parameter};
  for (const Vector& tangent : std::get<BranchPoint>(event.data).tangents) {
    junction.half_branches.push_back({tangent, -1, {}});
    junction.half_branches.push_back({-tangent, -1, {}});
  }
  return junction;
}

bool Agenda::is_at(const Junction& junction, const std::shared_ptr<const Problem>& problem, const Vector& x,
                   const Corrector& in) const {
  if (junction.problem != problem && !(alike_ && alike_(*junction.problem, *problem))) return false;
  return distance(in, joined(junction.u, junction.parameter), x) <= options_.same_place * (1 + in.norm_u(x));
}

std::size_t Agenda::index_of(const std::shared_ptr<const Problem>& problem, const Event& event,
                             const Corrector& in) const {
  const Vector x = joined(event.point.u, event.point.parameter);
  const std::vector<Vector>& tangents = std::get<BranchPoint>(event.data).tangents;
  std::size_t k = 0;
  for (; k < points.size(); ++k) {
    if (!is_at(points[k], problem, x, in)) continue;
    if (!simple(event) || std::all_of(tangents.begin(), tangents.end(), [&](const Vector& t) {
          return nearest(points[k], t, in) || nearest(points[k], -t, in);
        }))
      break;
  }
  return k;
}

std::optional<Agenda::Place> Agenda::arrival(const std::shared_ptr<const Problem>& problem,
                                             const Event& event, const Corrector& in) const {
  const Vector x = joined(event.point.u, event.point.parameter);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!is_at(points[k], problem, x, in)) continue;
    if (points[k].images) return Place{k, 0};
    if (const auto half = nearest(points[k], -std::get<BranchPoint>(event.data).tangents.front(), in))
      return Place{k, *half};
  }
  return {};
}

std::optional<std::size_t> Agenda::nearest(const Junction& junction, const Vector& direction,
                                           const Corrector& in) const {
  std::optional<std::size_t> found;
  double best = options_.same_direction;
  for (std::size_t i = 0; i < junction.half_branches.size(); ++i) {
    const double cosine = in.dot(junction.half_branches[i].direction, direction);
    if (cosine <= best) continue;
    best = cosine;
    found = i;
  }
  return found;
}

double Agenda::angle_to_others(const Junction& junction, const HalfBranch& half, const Corrector& in) {
  double largest = 0;
  for (const HalfBranch& other : junction.half_branches)
    if (&other != &half) largest = std::max(largest, in.dot(other.direction, half.direction));
  return std::acos(largest);
}

std::optional<Entry> Agenda::enter(const Place& place, Corrector& with, double lower, double upper) {
  const Junction& junction = points[place.point];
  HalfBranch& half = at(place);
  const EntryOptions& of = options_.entry;
  const Vector x = joined(junction.u, junction.parameter);
  const double angle = angle_to_others(junction, half, with), size = 1 + with.norm_u(x);
  const Vector row = with.border_row(half.direction);
  const Eigen::Index n = x.size() - 1;
  bool inside = false;
  CurvePoint first;
  first.tangent.resize(n + 1);
  for (double step = of.longest * size; step >= of.shortest * size; step *= of.reduction) {
    const Vector predicted = x + step * half.direction;
    first.v = predicted;
    if (!with.correct(first.v, row, false).converged || !settle(with, first)) {
      inside = true;
      continue;
    }
    if (first.v[n] < lower || first.v[n] > upper) continue;
    inside = true;
    if (distance(with, first.v, predicted) <= of.error * std::sin(std::min(angle, 1.5)) * step &&
        with.dot(first.tangent, half.direction) >= std::cos(of.turn * angle))
      return Entry{first.v, first.tangent, step};
  }
  half.untraced = inside ? "no solution was found on the half-branch, apart from the other branch"
                         : "the half-branch leaves the window";
  return {};
}

std::optional<Agenda::Place> Agenda::next() {
  for (; next_.point < points.size(); next_ = {next_.point + 1, 0})
    while (next_.half < points[next_.point].half_branches.size()) {
      const Place place = next_;
      ++next_.half;
      if (at(place).branch < 0) return place;
    }
  return {};
}

Branch trace_until(const std::shared_ptr<const Problem>& problem, const Start& start, const Options& options,
                   std::vector<Monitor> monitors, Observer observer,
                   const std::function<bool(const Event&)>& arrives) {
  Tracer tracer(problem, start, options, std::move(monitors), std::move(observer));
  std::size_t asked = 0;
  bool has_arrived = false;
  const auto ask = [&] {
    std::size_t met = 0;
    for (const Event& event : tracer.branch().events) {
      if (has_arrived) return;
      if (!std::holds_alternative<BranchPoint>(event.data) || met++ < asked) continue;
      ++asked;
      has_arrived = arrives(event);
    }
  };
  while (!has_arrived && tracer.step()) ask();
  ask();
  return tracer.take();
}

}  // namespace arcslip::continuation
