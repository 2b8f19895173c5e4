#include <arcslip/continuation/diagrams/diagram.hpp>

#include <arcslip/continuation/diagrams/branch_parts.hpp>
#include <arcslip/continuation/diagrams/diagram_tracer.hpp>
#include <arcslip/continuation/special_points/augmented_problem.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace arcslip::continuation {

void DiagramTracer::incomplete(const std::string& why) {
  diagram_.complete = false;
  if (diagram_.message.empty()) diagram_.message = why;
}

Diagram DiagramTracer::run() {
  first_branch();
  // Branch points are added meanwhile, those of one depth before those of the next.
  for (std::size_t k = 0; k < diagram_.branch_points.size() && !stopped_; ++k) {
    if (diagram_.branch_points[k].depth >= limits_.depth) break;
    for (std::size_t h = 0; h < diagram_.branch_points[k].half_branches.size() && !stopped_; ++h) leave(k, h);
  }
  if (stopped_) incomplete("stopped by the caller");
  return std::move(diagram_);
}

void DiagramTracer::first_branch() {
  Branch forward = follow({start_}, 0, 0);
  with_ = std::make_unique<Corrector>(*problem_, start_.p, free_, options_.newton, counts_,
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

// Whether a half-branch is still to be traced and can be; otherwise notes why the diagram is incomplete.
bool DiagramTracer::may_trace(const Junction& junction, HalfBranch& half) {
  if (half.branch >= 0) return false;
  if (half.untraced.empty() && junction.event < 0)  // beyond a terminal event that became certain only later
    half.untraced = "the branch that met it ended before reaching it";
  if (half.untraced.empty() && static_cast<int>(diagram_.branches.size()) >= limits_.branches)
    half.untraced = "reached the maximum number of branches, " + std::to_string(limits_.branches);
  if (!half.untraced.empty()) incomplete(half.untraced);
  return half.untraced.empty();
}

// The length from a branch point to the first point of a branch that leaves it.
double DiagramTracer::way_from(const Junction& origin, const Branch& branch) const {
  if (branch.points.empty()) return 0;
  const Point& first = branch.points.front();
  return distance(*with_, joined(origin.u, origin.parameter), joined(first.u, first.parameter));
}

// The branch point where a branch starts, as an event of that branch: its tangent there comes first.
Event DiagramTracer::as_event_of(const Junction& origin, const Vector& direction) const {
  Event event = diagram_.branches[static_cast<std::size_t>(origin.branch)]
                    .branch.events[static_cast<std::size_t>(origin.event)];
  event.point.arclength = 0;
  event.point.tangent = direction;
  if (!simple(event)) return event;
  auto& tangents = std::get<BranchPoint>(event.data).tangents;
  const auto along = [&](const Vector& t) { return std::abs(with_->dot(t, direction)); };
  std::iter_swap(tangents.begin(),
                 std::max_element(tangents.begin(), tangents.end(),
                                  [&](const Vector& a, const Vector& b) { return along(a) < along(b); }));
  if (with_->dot(tangents.front(), direction) < 0) tangents.front() = -tangents.front();
  return event;
}

// Traces a half-branch, unless it is known, and its opposite.
void DiagramTracer::leave(std::size_t k, std::size_t h) {
  const auto half = [&](std::size_t i) -> HalfBranch& { return diagram_.branch_points[k].half_branches[i]; };
  if (!may_trace(diagram_.branch_points[k], half(h))) return;
  const auto forward = enter(k, half(h));
  if (!forward) {
    if (half(h).branch < 0) incomplete(half(h).untraced);
    return;
  }
  const int index = static_cast<int>(diagram_.branches.size());
  const int depth = diagram_.branch_points[k].depth + 1;
  half(h).branch = index;
  Branch ahead = follow(*forward, index, depth);
  DiagramBranch now;
  now.depth = depth;
  now.origin = static_cast<int>(k);
  now.begin = ahead.stop;
  diagram_.branches.push_back(std::move(now));

  const bool closed = ahead.stop.reason == StopReason::closed;
  const Junction origin = diagram_.branch_points[k];
  Event event = as_event_of(origin, half(h).direction);
  shift(ahead, way_from(origin, ahead));
  Branch whole;
  whole.linear_solver = ahead.linear_solver;
  const auto opposite = simple(event) ? nearest(origin, -half(h).direction) : std::nullopt;
  if (!closed && opposite && half(*opposite).branch < 0 && !stopped_) {
    diagram_.branches.back().branch = ahead;  // the backward trace may reach it
    if (const auto backward = enter(k, half(*opposite))) {
      half(*opposite).branch = index;
      whole = follow(*backward, index, depth);
      diagram_.branches.back().begin = whole.stop;
      shift(whole, way_from(origin, whole));
      reverse(whole);
    } else if (half(*opposite).branch < 0) {
      incomplete(half(*opposite).untraced);
    }
  }
  // The origin between both ways is a point of the branch, and an event as on the branch that met it.
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
    with_ = std::make_unique<Corrector>(*problem_, start_.p, free_, options_.newton, counts_,
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
    traced.stop = {StopReason::user, 0, 0, "reached a half-branch that was already traced"};
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
  std::size_t k = index_of(event);
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
                 " is not simple: other branches through it are not traced");
    if (event.nonsmooth) look_for_others(junction, joined(junction.u, junction.parameter), crossing);
  }
  diagram_.branch_points.push_back(std::move(junction));
  return diagram_.branch_points.size() - 1;
}

// The branch point that an event is: there, and with the same branches, as two may lie closely together.
std::size_t DiagramTracer::index_of(const Event& event) const {
  const Vector x = joined(event.point.u, event.point.parameter);
  const std::vector<Vector>& tangents = std::get<BranchPoint>(event.data).tangents;
  std::size_t k = 0;
  for (; k < diagram_.branch_points.size(); ++k) {
    const Junction& junction = diagram_.branch_points[k];
    if (distance(*with_, joined(junction.u, junction.parameter), x) > reach(x)) continue;
    if (!simple(event) || std::all_of(tangents.begin(), tangents.end(), [&](const Vector& t) {
          return nearest(junction, t) || nearest(junction, -t);
        }))
      break;
  }
  return k;
}

void DiagramTracer::name_events(int branch) {
  const auto& events = diagram_.branches[static_cast<std::size_t>(branch)].branch.events;
  for (std::size_t e = 0; e < events.size(); ++e) {
    if (!std::holds_alternative<BranchPoint>(events[e].data)) continue;
    const std::size_t k = index_of(events[e]);
    if (k == diagram_.branch_points.size() || diagram_.branch_points[k].branch >= 0) continue;
    diagram_.branch_points[k].branch = branch;
    diagram_.branch_points[k].event = static_cast<int>(e);
  }
}

Diagram trace_diagram(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
                      const DiagramOptions& diagram, std::vector<Monitor> monitors, Observer observer) {
  if (!options.keep_points) throw std::invalid_argument("a diagram needs its points: keep_points is false");
  if (given(problem)->initial_state().size() != 0)
    throw std::invalid_argument(
        "a diagram is of a problem without a state: branches that meet have left different ones");
  if (diagram.depth < 0)
    throw std::invalid_argument("the depth of a diagram is " + std::to_string(diagram.depth) +
                                ", must be >= 0");
  if (diagram.branches < 1)
    throw std::invalid_argument("the maximum number of branches of a diagram is " +
                                std::to_string(diagram.branches) + ", must be >= 1");
  if (!(diagram.same_place > 0)) throw std::invalid_argument("same_place must be larger than 0");
  return DiagramTracer(std::move(problem), start, options, diagram, std::move(monitors), std::move(observer))
      .run();
}

}  // namespace arcslip::continuation
