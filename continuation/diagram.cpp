#include <arcslip/continuation/diagram.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double longest_entry = 1e-3, shortest_entry = 1e-6;  // h, relative to 1 + |u|
constexpr double entry_reduction = 0.25;
constexpr double entry_error = 0.25;  // of the distance to the nearest other half-branch
constexpr double entry_turn = 0.3;    // of the angle to it
constexpr double beside_segment = 0.05;
constexpr double same_point = 1e-2;      // of h
constexpr double same_direction = 0.95;  // cosine
constexpr double empty_step = 1e-14;
constexpr int oblique_probes = 8;  // directions in which pieces are looked for

Vector joined(const Vector& u, double parameter) {
  Vector v(u.size() + 1);
  v << u, parameter;
  return v;
}

bool simple(const Event& event) {
  return event.located && !event.nonsmooth;
}

void reverse(Point& point) {
  point.tangent = -point.tangent;
  point.arclength = -point.arclength;
}

void reverse(Event& event) {
  reverse(event.point);
  if (auto* kink = std::get_if<Kink>(&event.data)) {
    std::swap(kink->before, kink->after);
    kink->before = -kink->before;
    kink->after = -kink->after;
  }
  if (auto* crossing = std::get_if<BranchPoint>(&event.data)) {
    for (Vector& tangent : crossing->tangents) tangent = -tangent;
    if (!simple(event)) std::swap(crossing->tangents.front(), crossing->tangents.back());
  }
}

void shift(Branch& branch, double arclength) {
  for (Point& point : branch.points) point.arclength += arclength;
  for (Event& event : branch.events) event.point.arclength += arclength;
}

void reverse(Branch& branch) {
  std::reverse(branch.points.begin(), branch.points.end());
  std::reverse(branch.events.begin(), branch.events.end());
  for (Point& point : branch.points) reverse(point);
  for (Event& event : branch.events) reverse(event);
}

void append(Branch& branch, Branch&& next) {
  std::move(next.points.begin(), next.points.end(), std::back_inserter(branch.points));
  std::move(next.events.begin(), next.events.end(), std::back_inserter(branch.events));
  branch.stop = std::move(next.stop);
  branch.counts.points += next.counts.points;
  branch.counts.rejected_steps += next.counts.rejected_steps;
  branch.counts.residuals += next.counts.residuals;
  branch.counts.jacobians += next.counts.jacobians;
  branch.counts.factorizations += next.counts.factorizations;
  branch.counts.solves += next.counts.solves;
}

void number(Branch& branch) {
  for (Event& event : branch.events) {
    const auto beyond = std::upper_bound(branch.points.begin(), branch.points.end(), event.point.arclength,
                                         [](double s, const Point& point) { return s < point.arclength; });
    event.after = static_cast<std::size_t>(std::max<std::ptrdiff_t>(beyond - branch.points.begin(), 1) - 1);
  }
}

// A trace that begins at a bound, or meets it by chance, ends with a step of rounding.
void drop_empty_step(Branch& branch) {
  auto& points = branch.points;
  if (points.size() < 2) return;
  const auto last = points.end() - 1;
  if (last->arclength - (last - 1)->arclength <= empty_step * (1 + last->arclength)) points.erase(last - 1);
  number(branch);
}

// A loop from a branch point back to it: what was traced beyond is dropped.
void cut(Branch& branch, const Event& end, double miss, double reach) {
  const double s = end.point.arclength;
  while (!branch.points.empty() && branch.points.back().arclength >= s) branch.points.pop_back();
  while (!branch.events.empty() && branch.events.back().point.arclength > s) branch.events.pop_back();
  branch.points.push_back(end.point);
  branch.stop = {StopReason::closed, miss, reach, "came back to the branch point that it left: it is closed"};
}

struct Entry {
  Start start;
  double step = 0;
  std::optional<std::size_t> origin = {};  // index of the branch point that is left
};

// How a branch comes to a branch point: on a half-branch that is new, that was traced before, or that is the
// opposite of the one on which it left.
enum class Arrival { first, repeated, home };

class DiagramTracer {
 public:
  DiagramTracer(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
                const DiagramOptions& limits, std::vector<Monitor> monitors, Observer observer)
      : problem_(std::move(problem)),
        start_(start),
        options_(options),
        limits_(limits),
        monitors_(std::move(monitors)),
        observer_(std::move(observer)) {
    const bool has_monitor = std::any_of(monitors_.begin(), monitors_.end(), [](const Monitor& monitor) {
      return monitor.kind == MonitorKind::branch_point;
    });
    if (!has_monitor) monitors_.push_back(branch_point_monitor());
  }

  Diagram run();

 private:
  void first_branch();
  void leave(std::size_t junction, std::size_t half);
  Branch follow(const Entry& entry, int branch, int depth);
  Arrival pass(const Event& event, const Entry& entry, int branch, int depth);
  std::size_t meet(const Event& event, int depth);
  void look_for_others(Junction& junction, const Vector& x, const BranchPoint& known);
  std::optional<Entry> enter(std::size_t k, HalfBranch& half);
  int known_branch(const Vector& v, const Vector& tangent, double step, double angle);
  std::optional<std::size_t> nearest(const Junction& junction, const Vector& direction) const;
  std::size_t half_towards(Junction& junction, const Vector& direction);
  double angle_to_others(const Junction& junction, const HalfBranch& half) const;
  double reach(const Vector& x) const { return limits_.same_place * (1 + with_->norm_u(x)); }
  std::size_t index_of(const Vector& x) const;
  void name_events(int branch);
  void incomplete(const std::string& why);

  std::shared_ptr<const Problem> problem_;
  Start start_;
  Options options_;
  DiagramOptions limits_;
  std::vector<Monitor> monitors_;
  Observer observer_;
  Diagram diagram_;
  Counts counts_;  // of entries
  std::unique_ptr<Corrector> with_;
  bool stopped_ = false;
};

void DiagramTracer::incomplete(const std::string& why) {
  diagram_.complete = false;
  if (diagram_.message.empty()) diagram_.message = why;
}

Diagram DiagramTracer::run() {
  first_branch();
  // Branch points are met while this goes on, those of one depth before those of the next.
  for (std::size_t k = 0; k < diagram_.branch_points.size() && !stopped_; ++k) {
    if (diagram_.branch_points[k].depth >= limits_.depth) break;
    for (std::size_t h = 0; h < diagram_.branch_points[k].half_branches.size() && !stopped_; ++h) leave(k, h);
  }
  if (stopped_) incomplete("stopped by the caller");
  return std::move(diagram_);
}

void DiagramTracer::first_branch() {
  Branch forward = follow({start_}, 0, 0);
  with_ = std::make_unique<Corrector>(*problem_, start_.p, start_.free, options_.newton, counts_,
                                      options_.linear_solver);
  DiagramBranch first;
  first.begin = forward.stop;
  if (forward.points.empty()) {
    incomplete(forward.stop.message);
  } else if (forward.stop.reason != StopReason::closed && !stopped_) {
    Start start = start_;
    start.direction = -start.direction;
    start.tangent = -start.tangent;
    Branch whole = follow({start}, 0, 0);
    first.begin = whole.stop;
    reverse(whole);
    if (!whole.points.empty()) whole.points.pop_back();
    whole.linear_solver = forward.linear_solver;
    append(whole, std::move(forward));
    forward = std::move(whole);
    number(forward);
  }
  first.branch = std::move(forward);
  diagram_.branches.push_back(std::move(first));
  name_events(0);
}

// Follows a half-branch that was not traced, and its opposite.
void DiagramTracer::leave(std::size_t k, std::size_t h) {
  const auto half = [&](std::size_t i) -> HalfBranch& { return diagram_.branch_points[k].half_branches[i]; };
  if (half(h).branch >= 0) return;
  if (!half(h).untraced.empty()) return incomplete(half(h).untraced);
  if (diagram_.branch_points[k].event < 0) {  // it lay beyond a terminal event that was certain only later
    half(h).untraced = "the branch that met it ended before it";
    return incomplete(half(h).untraced);
  }
  if (static_cast<int>(diagram_.branches.size()) >= limits_.branches) {
    half(h).untraced = "reached the largest number of branches, " + std::to_string(limits_.branches);
    return incomplete(half(h).untraced);
  }
  const auto forward = enter(k, half(h));
  if (!forward) {
    if (half(h).branch < 0) incomplete(half(h).untraced);
    return;
  }
  const int index = static_cast<int>(diagram_.branches.size());
  DiagramBranch now;
  now.depth = diagram_.branch_points[k].depth + 1;
  now.origin = static_cast<int>(k);
  half(h).branch = index;
  now.branch = follow(*forward, index, now.depth);
  now.begin = now.branch.stop;
  const bool closed = now.branch.stop.reason == StopReason::closed;
  diagram_.branches.push_back(std::move(now));

  // The origin between both ways is a point of the branch, and an event as on the branch that met it.
  const Junction origin = diagram_.branch_points[k];
  const Vector x = joined(origin.u, origin.parameter);
  Branch ahead = std::move(diagram_.branches.back().branch);
  const auto way = [&](const Branch& branch) {
    return branch.points.empty()
               ? 0
               : distance(*with_, x, joined(branch.points.front().u, branch.points.front().parameter));
  };
  shift(ahead, way(ahead));
  Branch whole;
  whole.linear_solver = ahead.linear_solver;
  Event event = diagram_.branches[static_cast<std::size_t>(origin.branch)]
                    .branch.events[static_cast<std::size_t>(origin.event)];
  event.point.arclength = 0;
  event.point.tangent = half(h).direction;
  const auto opposite = simple(event) ? nearest(origin, -half(h).direction) : std::nullopt;
  if (!closed && opposite && half(*opposite).branch < 0 && !stopped_) {
    diagram_.branches.back().branch = ahead;  // the way back may lie on it
    if (const auto backward = enter(k, half(*opposite))) {
      half(*opposite).branch = index;
      whole = follow(*backward, index, diagram_.branches.back().depth);
      diagram_.branches.back().begin = whole.stop;
      shift(whole, way(whole));
      reverse(whole);
    } else if (half(*opposite).branch < 0) {
      incomplete(half(*opposite).untraced);
    }
  }
  auto& tangents = std::get<BranchPoint>(event.data).tangents;
  if (simple(event)) {
    std::swap(tangents.front(), tangents.back());
    if (with_->dot(tangents.front(), half(h).direction) < 0) tangents.front() = -tangents.front();
  }
  whole.points.push_back(event.point);
  if (!closed) whole.events.push_back(std::move(event));
  append(whole, std::move(ahead));
  number(whole);
  diagram_.branches.back().branch = std::move(whole);
  name_events(index);
}

Branch DiagramTracer::follow(const Entry& entry, int branch, int depth) {
  Options options = options_;
  if (entry.step > 0) options.step.initial = entry.step;
  Observer observer;
  if (observer_)
    observer = [&](const Accepted& now, const Event* event) {
      stopped_ = !observer_(now, event);
      return !stopped_;
    };
  Tracer tracer(problem_, entry.start, options, monitors_, observer);
  if (!with_)
    with_ = std::make_unique<Corrector>(*problem_, start_.p, start_.free, options_.newton, counts_,
                                        options_.linear_solver);
  std::size_t passed = 0;
  Arrival last = Arrival::first;
  Event at;  // of the last arrival
  const auto look = [&](const Branch& branch_so_far) {
    std::size_t met = 0;
    for (const Event& event : branch_so_far.events) {
      if (last != Arrival::first) return;
      if (!std::holds_alternative<BranchPoint>(event.data) || met++ < passed) continue;
      ++passed;
      last = pass(event, entry, branch, depth);
      at = event;
    }
  };
  while (last == Arrival::first && tracer.step()) look(tracer.branch());
  look(tracer.branch());
  Branch traced = tracer.take();
  drop_empty_step(traced);
  if (last == Arrival::repeated)
    traced.stop = {StopReason::user, 0, 0, "came to a half-branch that was traced before"};
  if (last == Arrival::home) {
    const Vector x = joined(at.point.u, at.point.parameter);
    const Junction& origin = diagram_.branch_points[*entry.origin];
    cut(traced, at, distance(*with_, x, joined(origin.u, origin.parameter)), reach(x));
  }
  return traced;
}

Arrival DiagramTracer::pass(const Event& event, const Entry& entry, int branch, int depth) {
  if (event.point.parameter < options_.lower || event.point.parameter > options_.upper) return Arrival::first;
  const BranchPoint& crossing = std::get<BranchPoint>(event.data);
  std::size_t k = index_of(joined(event.point.u, event.point.parameter));
  if (k == diagram_.branch_points.size()) k = meet(event, depth);
  Junction& junction = diagram_.branch_points[k];
  const Vector& beyond = simple(event) ? crossing.tangents.front() : crossing.tangents.back();
  const std::size_t from = half_towards(junction, -crossing.tangents.front());
  const std::size_t to = half_towards(junction, beyond);
  if (junction.half_branches[from].branch >= 0) return Arrival::repeated;
  junction.half_branches[from].branch = branch;
  if (entry.origin == k && simple(event) && with_->dot(beyond, entry.start.tangent) > same_direction)
    return Arrival::home;
  if (junction.half_branches[to].branch < 0) junction.half_branches[to].branch = branch;
  return Arrival::first;
}

std::size_t DiagramTracer::meet(const Event& event, int depth) {
  const BranchPoint& crossing = std::get<BranchPoint>(event.data);
  Junction junction;
  junction.u = event.point.u;
  junction.parameter = event.point.parameter;
  junction.depth = depth;
  if (simple(event)) {
    for (const Vector& tangent : crossing.tangents) {
      junction.half_branches.push_back({tangent, -1, {}});
      junction.half_branches.push_back({-tangent, -1, {}});
    }
  } else {
    junction.half_branches.push_back({-crossing.tangents.front(), -1, {}});
    junction.half_branches.push_back({crossing.tangents.back(), -1, {}});
    if (!event.nonsmooth && depth < limits_.depth)
      incomplete("the branch point at " + std::to_string(junction.parameter) +
                 " is not simple: other branches through it are not followed");
    if (event.nonsmooth) look_for_others(junction, joined(junction.u, junction.parameter), crossing);
  }
  diagram_.branch_points.push_back(std::move(junction));
  return diagram_.branch_points.size() - 1;
}

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
    junction.half_branches[i].untraced =
        "where pieces meet, " + std::to_string(found) + " half-branches leave: these are not switched to";
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
  Place place;
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
    entry.start.p[start_.free] = place.v[n];
    entry.start.free = start_.free;
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
      if (!(share >= -beside_segment && share <= 1 + beside_segment)) continue;
      hermite(from, points[i].tangent, to, points[i + 1].tangent, length, share, near);
      if (distance(*with_, near, v) > beside_segment * length) continue;
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

std::size_t DiagramTracer::index_of(const Vector& x) const {
  std::size_t k = 0;
  for (; k < diagram_.branch_points.size(); ++k) {
    const Junction& junction = diagram_.branch_points[k];
    if (distance(*with_, joined(junction.u, junction.parameter), x) <= reach(x)) break;
  }
  return k;
}

void DiagramTracer::name_events(int branch) {
  const auto& events = diagram_.branches[static_cast<std::size_t>(branch)].branch.events;
  for (std::size_t e = 0; e < events.size(); ++e) {
    if (!std::holds_alternative<BranchPoint>(events[e].data)) continue;
    const std::size_t k = index_of(joined(events[e].point.u, events[e].point.parameter));
    if (k == diagram_.branch_points.size() || diagram_.branch_points[k].branch >= 0) continue;
    diagram_.branch_points[k].branch = branch;
    diagram_.branch_points[k].event = static_cast<int>(e);
  }
}

}  // namespace

Diagram trace_diagram(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
                      const DiagramOptions& diagram, std::vector<Monitor> monitors, Observer observer) {
  if (!options.keep_points) throw std::invalid_argument("a diagram needs its points: keep_points is false");
  if (diagram.depth < 0)
    throw std::invalid_argument("the depth of a diagram is " + std::to_string(diagram.depth) +
                                ", less than 0");
  if (diagram.branches < 1)
    throw std::invalid_argument("a diagram of at most " + std::to_string(diagram.branches) +
                                " branches: it needs 1");
  if (!(diagram.same_place > 0)) throw std::invalid_argument("same_place must be larger than 0");
  return DiagramTracer(std::move(problem), start, options, diagram, std::move(monitors), std::move(observer))
      .run();
}

}  // namespace arcslip::continuation
