// Processing of the events of a step: their order, and branch points that could not be located.

#include <arcslip/continuation/multiple_point.hpp>
#include <arcslip/continuation/reduction.hpp>
#include <arcslip/continuation/text.hpp>
#include <arcslip/continuation/tracer.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double branch_point_step = 1e-7;  // relative to 1 + |u|: shorter steps cannot separate two branches
constexpr double pair_share = 1e-3;  // of the first step in which a mode may cross zero and return: minimum

}  // namespace

// Locates the branch point in the step to next_, if any, and rejects the step otherwise: a change of
// orientation is a jump to a nearby branch, unless branches cross here or it persists with the smallest step;
// and several modes that cross zero are several branch points, unless they do so at the same point.
std::optional<Tracer::Attempt> Tracer::look_for_crossing(double length) {
  const bool turned = next_.orientation != s_.here.orientation;
  int modes = turned ? 1 : 0;
  const bool apart = s_.step > branch_point_step * (1 + main_->norm_u(s_.here.v));
  if (modes_ && next_.orientation != 0 && next_.piece == s_.here.piece) {
    const auto crossed = modes_->between(s_.here, next_, length, row_, main_->factors());
    if (crossed && crossed->at_zero && apart)
      return refuse(Rejected::branch_points, 1, 0, Attempt::unresolved);
    if (crossed && (crossed->count % 2 == 1) == turned) modes = crossed->count;
    if (crossed && modes == 0 && !crossed->told && !stretch_is_short(pair_share)) {
      begin_stretch(length);
      return refuse(Rejected::branch_points, 2, 1, Attempt::unresolved);
    }
  }
  if (modes == 0) return {};
  next_.arclength = s_.here.arclength + length;
  if (modes == 1) crossing_ = events_->branch_point(s_.here, next_);
  for (int loss = std::max(modes, 2); modes_ && !crossing_ && loss <= largest_rank_loss; ++loss)
    if (loss == modes || modes == 1) crossing_ = events_->multiple_point(s_.here, next_, loss);
  if (crossing_) return {};
  if (apart && turned) return refuse(Rejected::another_branch, 0, 0);
  if (apart) return refuse(Rejected::branch_points, modes, 1, Attempt::unresolved);
  const std::string doubt = doubt_of_isolation(*problem_, s_.here.v, s_.p, s_.free, options_.linear_solver);
  if (!doubt.empty() && next_.piece == s_.here.piece) {
    end(StopReason::step_too_small, s_.step, branch_point_step * (1 + main_->norm_u(s_.here.v)),
        "the orientation of the branch changes even with the smallest step" + doubt);
    return Attempt::ended;
  }
  crossing_ = unlocated_branch_point(s_.here, next_);
  return {};
}

// In order of arclength: an event may have been pending for a few points.
const Event* Tracer::add(Event&& event) {
  const double s = event.point.arclength;
  const auto after = std::upper_bound(s_.branch.points.begin(), s_.branch.points.end(), s,
                                      [](double x, const Point& y) { return x < y.arclength; });
  event.after = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - s_.branch.points.begin(), 1) - 1);
  const auto place = std::upper_bound(s_.branch.events.begin(), s_.branch.events.end(), s,
                                      [](double x, const Event& y) { return x < y.point.arclength; });
  return &*s_.branch.events.insert(place, std::move(event));
}

// Where a monitor is NaN, its zeros are missed.
void Tracer::warn_of_undefined(const Place& place) {
  for (std::size_t m = 0; m < monitors_.size(); ++m) {
    if (!std::isnan(place.monitors[m]) && !std::isnan(place.quantities[m])) continue;
    const std::string start = "the monitor \"" + monitors_[m].name + "\" is not a number at ";
    auto& all = s_.branch.warnings;
    if (std::none_of(all.begin(), all.end(), [&](const std::string& w) { return w.starts_with(start); }))
      all.push_back(start + text(place.v[n_]) + ": zeros near such points are missed");
  }
}

bool Tracer::report(std::vector<LocatedEvent>&& all) {
  bool go_on = true;
  for (LocatedEvent& found : all) {
    const Event* event = add(std::move(found.event));
    if (observer_ && go_on) {
      const auto now = events_->look_at(found.place);
      if (!now) main_->move_to(found.place.v);  // at a branch point B may be singular to the last bit
      go_on = observer_(now ? *now : accepted(*main_, found.place), event);
    }
    const bool terminal = std::any_of(monitors_.begin(), monitors_.end(), [&](const Monitor& m) {
      return m.terminal && m.name == event->monitor;
    });
    if (terminal && !terminal_) terminal_ = std::move(found.place);
  }
  return go_on;
}

// If pieces of F meet there, or the branch point is not simple.
std::optional<LocatedEvent> Tracer::unlocated_branch_point(const Place& from, const Place& to) const {
  LocatedEvent found;
  for (const Monitor& monitor : monitors_)
    if (monitor.kind == MonitorKind::branch_point) found.event.monitor = monitor.name;
  found.event.nonsmooth = from.piece != to.piece;
  found.event.located = found.event.nonsmooth;
  found.event.point = point(from, {});
  BranchPoint half_branches;
  half_branches.tangents = {from.tangent, to.tangent};
  found.event.data = std::move(half_branches);
  found.place = from;
  return found;
}

// The events of a step in order of arclength: the first terminal one ends the branch.
std::vector<LocatedEvent> Tracer::with_crossing(std::vector<LocatedEvent>&& found) {
  if (crossing_ && !crossing_->event.monitor.empty()) {
    const auto place =
        std::upper_bound(found.begin(), found.end(), crossing_->place.arclength,
                         [](double s, const LocatedEvent& each) { return s < each.event.point.arclength; });
    found.insert(place, std::move(*crossing_));
  }
  crossing_.reset();
  return std::move(found);
}

}  // namespace arcslip::continuation
