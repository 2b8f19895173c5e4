#include <arcslip/continuation/diagrams/diagram.hpp>

#include <arcslip/continuation/diagrams/branch_parts.hpp>
#include <arcslip/continuation/diagrams/diagram_tracer.hpp>
#include <arcslip/continuation/special_points/augmented_problem.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace arcslip::continuation {

void DiagramTracer::incomplete(const std::string& why) {
  diagram_.complete = false;
  if (diagram_.message.empty()) diagram_.message = why;
}

Diagram DiagramTracer::run() {
  add_branch_through(start_);
  follow_half_branches();
  for (const double at : limits_.searches) search(at);
  if (stopped_) incomplete("stopped by the caller");
  diagram_.branch_points = std::move(agenda_.points);
  for (DiagramBranch& each : diagram_.branches) each.stability = stability_ranges(each.branch);
  return std::move(diagram_);
}

// Branch points are added meanwhile, those of one depth before those of the next.
void DiagramTracer::follow_half_branches() {
  while (!stopped_) {
    const auto place = agenda_.next();
    if (!place) return;
    if (agenda_.points[place->point].depth < limits_.depth)
      leave(*place);
    else if (std::string& why = agenda_.at(*place).untraced; why.empty())
      why = "a branch of it is beyond the depth of the diagram, " + std::to_string(limits_.depth);
  }
}

// The index of the branch through a solution, or -1: there is none, but for the first one, which says why.
int DiagramTracer::add_branch_through(const Start& from) {
  const int index = static_cast<int>(diagram_.branches.size());
  Branch forward = follow({from}, index, 0);
  if (!with_)
    with_ = std::make_unique<Corrector>(*problem_, start_.p, free_, options_.newton, counts_,
                                        options_.linear_solver);
  DiagramBranch added;
  added.begin = forward.stop;
  if (forward.points.empty()) {
    if (index > 0) return -1;
    incomplete(forward.stop.message);
  } else if (forward.stop.reason != StopReason::closed && !stopped_) {
    Start start = from;
    start.direction = -start.direction;
    start.tangent = -start.tangent;
    Branch whole = follow({start}, index, 0);
    added.begin = whole.stop;
    reverse(whole);
    if (!whole.points.empty()) whole.points.pop_back();
    whole.linear_solver = forward.linear_solver;
    append(whole, std::move(forward));
    forward = std::move(whole);
    number(forward);
  }
  added.branch = std::move(forward);
  diagram_.branches.push_back(std::move(added));
  name_events(index);
  return index;
}

// Whether a half-branch can be traced; otherwise notes why the diagram is incomplete.
bool DiagramTracer::may_trace(const Junction& junction, HalfBranch& half) {
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
void DiagramTracer::leave(const Agenda::Place& place) {
  const auto [k, h] = place;
  const auto half = [&](std::size_t i) -> HalfBranch& {
    return agenda_.points[place.point].half_branches[i];
  };
  if (!may_trace(agenda_.points[k], half(h))) return;
  const auto forward = enter(place);
  if (!forward) {
    if (half(h).branch < 0) incomplete(half(h).untraced);
    return;
  }
  const int index = static_cast<int>(diagram_.branches.size());
  const int depth = agenda_.points[k].depth + 1;
  half(h).branch = index;
  Branch ahead = follow(*forward, index, depth);
  DiagramBranch now;
  now.depth = depth;
  now.origin = static_cast<int>(k);
  now.begin = ahead.stop;
  diagram_.branches.push_back(std::move(now));

  const bool closed = ahead.stop.reason == StopReason::closed;
  const Junction origin = agenda_.points[k];
  Event event = as_event_of(origin, half(h).direction);
  shift(ahead, way_from(origin, ahead));
  Branch whole;
  whole.linear_solver = ahead.linear_solver;
  const auto opposite = simple(event) ? agenda_.nearest(origin, -half(h).direction, *with_) : std::nullopt;
  if (!closed && opposite && half(*opposite).branch < 0 && !stopped_) {
    diagram_.branches.back().branch = ahead;  // the backward trace may reach it
    if (const auto backward = enter({k, *opposite})) {
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

Branch DiagramTracer::follow(const Beginning& from, int branch, int depth) {
  Options options = options_;
  if (from.step > 0) options.step.initial = from.step;
  Observer observer;
  if (observer_)
    observer = [&](const Accepted& now, const Event* event) {
      stopped_ = !observer_(now, event);
      return !stopped_;
    };
  Arrival last = Arrival::first;
  Event at;  // of the last arrival
  Branch traced =
      trace_until(problem_, from.start, options, monitors_, std::move(observer), [&](const Event& event) {
        if (!with_)
          with_ = std::make_unique<Corrector>(*problem_, start_.p, free_, options_.newton, counts_,
                                              options_.linear_solver);
        last = pass(event, from, branch, depth);
        at = event;
        return last != Arrival::first;
      });
  drop_empty_step(traced);
  if (last == Arrival::repeated)
    traced.stop = {StopReason::known_branch, at.point.parameter, at.point.parameter,
                   "reached a half-branch that was already traced"};
  if (last == Arrival::home) {
    const Vector x = joined(at.point.u, at.point.parameter);
    const Junction& origin = agenda_.points[*from.origin];
    cut(traced, at, distance(*with_, x, joined(origin.u, origin.parameter)),
        limits_.same_place * (1 + with_->norm_u(x)));
  }
  return traced;
}

Arrival DiagramTracer::pass(const Event& event, const Beginning& from, int branch, int depth) {
  if (event.point.parameter < options_.lower || event.point.parameter > options_.upper) return Arrival::first;
  const BranchPoint& crossing = std::get<BranchPoint>(event.data);
  std::size_t k = agenda_.index_of(problem_, event, *with_);
  if (k == agenda_.points.size()) k = meet(event, depth);
  Junction& junction = agenda_.points[k];
  const Vector& beyond = simple(event) ? crossing.tangents.front() : crossing.tangents.back();
  const std::size_t arrived = half_towards(junction, -crossing.tangents.front());
  const std::size_t opposite = half_towards(junction, beyond);
  if (junction.half_branches[arrived].branch >= 0) return Arrival::repeated;
  const auto set_branch = [&](HalfBranch& half) {
    half.branch = branch;
    half.untraced.clear();
  };
  set_branch(junction.half_branches[arrived]);
  if (from.origin == k && simple(event) && with_->dot(beyond, from.start.tangent) > limits_.same_direction)
    return Arrival::home;
  if (junction.half_branches[opposite].branch < 0) set_branch(junction.half_branches[opposite]);
  return Arrival::first;
}

std::size_t DiagramTracer::meet(const Event& event, int depth) {
  const BranchPoint& crossing = std::get<BranchPoint>(event.data);
  Junction junction;
  if (simple(event)) {
    junction = Agenda::met(problem_, event);
  } else {
    junction = {problem_, event.point.u, event.point.parameter};
    junction.half_branches.push_back({-crossing.tangents.front(), -1, {}});
    junction.half_branches.push_back({crossing.tangents.back(), -1, {}});
    if (!event.nonsmooth && depth < limits_.depth)
      incomplete("the branch point at " + std::to_string(junction.parameter) +
                 " is not simple: other branches through it are not traced");
    if (event.nonsmooth) look_for_others(junction, joined(junction.u, junction.parameter), crossing);
  }
  junction.depth = depth;
  agenda_.points.push_back(std::move(junction));
  return agenda_.points.size() - 1;
}

void DiagramTracer::name_events(int branch) {
  const auto& events = diagram_.branches[static_cast<std::size_t>(branch)].branch.events;
  for (std::size_t e = 0; e < events.size(); ++e) {
    if (!std::holds_alternative<BranchPoint>(events[e].data)) continue;
    const std::size_t k = agenda_.index_of(problem_, events[e], *with_);
    if (k == agenda_.points.size() || agenda_.points[k].branch >= 0) continue;
    agenda_.points[k].branch = branch;
    agenda_.points[k].event = static_cast<int>(e);
  }
}

void check(const DiagramOptions& options) {
  const auto reject = [](const std::string& what, double value, const char* bound) {
    std::ostringstream text;
    text << what << " of a diagram is " << value << ", must be " << bound;
    throw std::invalid_argument(text.str());
  };
  const auto in_unit_interval = [&](const char* name, double value) {
    if (!(value > 0 && value < 1)) reject(name, value, "between 0 and 1");
  };
  if (options.depth < 0) reject("the depth", options.depth, ">= 0");
  if (options.branches < 1) reject("the maximum number of branches", options.branches, ">= 1");
  if (!(options.same_place > 0)) reject("same_place", options.same_place, "> 0");
  in_unit_interval("same_direction", options.same_direction);
  if (!(options.entry.shortest > 0)) reject("entry.shortest", options.entry.shortest, "> 0");
  if (!(options.entry.longest >= options.entry.shortest))
    reject("entry.longest", options.entry.longest, ">= entry.shortest");
  in_unit_interval("entry.reduction", options.entry.reduction);
  in_unit_interval("entry.error", options.entry.error);
  in_unit_interval("entry.turn", options.entry.turn);
  in_unit_interval("nearby.segment", options.nearby.segment);
  in_unit_interval("nearby.same_point", options.nearby.same_point);
  if (options.oblique_probes < 0) reject("oblique_probes", options.oblique_probes, ">= 0");
}

Diagram trace_diagram(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
                      const DiagramOptions& diagram, std::vector<Monitor> monitors, Observer observer) {
  if (!options.keep_points) throw std::invalid_argument("a diagram needs its points: keep_points is false");
  if (given(problem)->initial_state().size() != 0)
    throw std::invalid_argument(
        "a diagram is of a problem without a state: branches that meet have left different ones");
  const Parameter& free = problem->parameters()[static_cast<std::size_t>(start.free.in(*problem))];
  const double lower = std::max(options.lower, free.lower), upper = std::min(options.upper, free.upper);
  for (const double at : diagram.searches)
    if (!(at >= lower && at <= upper)) {
      std::ostringstream text;
      text << "a search of a diagram is at " << at << ", must be in the window, " << lower << " to " << upper;
      throw std::invalid_argument(text.str());
    }
  check(diagram);
  return DiagramTracer(std::move(problem), start, options, diagram, std::move(monitors), std::move(observer))
      .run();
}

}  // namespace arcslip::continuation
