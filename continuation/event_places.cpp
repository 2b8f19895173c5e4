// Events that are no zeros of functions: kinks, and points where two branches cross.

#include <arcslip/continuation/branch_point.hpp>
#include <arcslip/continuation/event_locator.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <limits>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr int most_kinks = 16;          // looked for in one step
constexpr double just_beyond = 1e-6;    // of a step: where the other side of a kink is looked at
constexpr double smallest_kink = 1e-4;  // rad
constexpr double beside_step = 0.1;     // of a step: a branch point so near lies on it
// Of a monitor's change over a step, and of the largest dp/ds as for the type of a branch point: less is
// zero.
constexpr double zero_share = 1e-6;

}  // namespace

std::optional<LocatedEvent> EventLocator::branch_point(const Place& from, const Place& to) {
  const double length = to.arclength - from.arclength;
  Corrector& probe = this->probe();
  Place place = from;
  Vector beside(from.v.size());
  for (double guess : {0.5, 0.1, 0.9}) {
    hermite(from.v, from.tangent, to.v, to.tangent, length, guess, beside);
    std::optional<BranchPointLocation> crossing;
    try {
      crossing = locate_branch_point(problem_, p_, free_, beside, options_.linear_solver, options_.newton);
    } catch (const std::exception&) {  // what the corrector takes for a place that cannot be evaluated
    }
    if (!crossing || !crossing->branches_cross()) continue;
    const Vector way = crossing->x - from.v;
    const double share = probe.dot(way, to.v - from.v) / (length * length);
    if (!(share > -beside_step && share < 1 + beside_step)) continue;
    hermite(from.v, from.tangent, to.v, to.tangent, length, share, beside);
    if (distance(probe, beside, crossing->x) > beside_step * length) continue;
    auto branches = describe_branch_point(*problem_, free_, *crossing, to.v - from.v);
    if (!branches) continue;
    place.v = crossing->x;
    place.tangent = branches->tangents.front();
    place.arclength = from.arclength + std::clamp(share, 0.0, 1.0) * length;
    LocatedEvent found;
    for (const Monitor& monitor : monitors_)
      if (monitor.kind == MonitorKind::branch_point) found.event.monitor = monitor.name;
    found.event.point = point(place, {});
    found.event.data = std::move(*branches);
    found.place = std::move(place);
    return found;
  }
  return std::nullopt;
}

std::vector<LocatedEvent> EventLocator::past(const Place& from, const Place& crossing, const Place& to) {
  Place at = crossing;
  at.piece = from.piece;
  at.orientation = from.orientation;
  const bool smooth = to.piece == from.piece;
  if (!smooth || !probe().linearize(to.v, probe().border_row(crossing.tangent)) ||
      !probe().move_to(at.v, Needs::jacobian))
    return between(from, to);
  evaluate(monitors_, probe(), at);
  zero_at_crossing_.assign(monitors_.size(), false);
  for (std::size_t m = 0; m < monitors_.size(); ++m) {
    double& here = at.monitors[m];
    const double a = from.monitors[m], b = to.monitors[m];
    const double size =
        monitors_[m].at_branch_points ? std::max(std::abs(a), std::abs(b)) : probe().parameter_scale();
    zero_at_crossing_[m] = std::abs(here) <= zero_share * size;
    if (zero_at_crossing_[m]) here = std::copysign(std::numeric_limits<double>::min(), a);
  }
  std::vector<LocatedEvent> found = gather(&EventLocator::find, from, at);
  at.orientation = to.orientation;
  from_crossing_ = true;
  append(found, gather(&EventLocator::beyond_crossing, at, to));
  from_crossing_ = false;
  return found;
}

std::optional<LocatedEvent> EventLocator::beyond_crossing(std::size_t monitor, const Place& crossing,
                                                          const Place& to) {
  if (!zero_at_crossing_[monitor]) return find(monitor, crossing, to);
  if (!monitors_[monitor].at_branch_points) return std::nullopt;
  return LocatedEvent{event(monitor, crossing, 0, {}), crossing, crossing.quantities[monitor]};
}

LocatedEvent EventLocator::kink_event(const Monitor& monitor, const Place& kink, const Vector& beyond) const {
  LocatedEvent found;
  found.event.monitor = monitor.name;
  found.event.point = point(kink, {});
  found.event.nonsmooth = true;
  found.event.data = Kink{kink.tangent, beyond};
  found.place = kink;
  return found;
}

// The branch shortly beyond a kink, with its tangent there: linearized ahead, where the other piece is, and
// corrected along that tangent, on the side of `to`.
bool EventLocator::look_beyond(const Place& kink, const Place& to, double way, Place& beyond) {
  Corrector& probe = this->probe();
  beyond = kink;
  beyond.v = kink.v + way * kink.tangent;
  if (!probe.linearize(beyond.v, probe.border_row(kink.tangent)) || !settle(probe, beyond)) return false;
  const bool against = kink.orientation != 0 ? beyond.orientation != kink.orientation
                                             : probe.dot(beyond.tangent, to.v - kink.v) < 0;
  if (against) beyond.reverse();
  const Vector tangent = beyond.tangent;
  beyond.v = kink.v + way * tangent;
  if (!probe.correct(beyond.v, probe.border_row(tangent), false).converged || !settle(probe, beyond))
    return false;
  beyond.arclength = kink.arclength + way;
  return beyond.piece != kink.piece;
}

// From piece to piece: each section is searched by itself, so that two events of one monitor within the step,
// as two nonsmooth folds are, do not cancel. Returns the beginning of the last section.
Place EventLocator::pass_kinks(const Place& from, const Place& to, std::vector<LocatedEvent>& found) {
  Place side = from, kink, beyond;
  const auto add = [&](std::vector<LocatedEvent>&& events) { append(found, std::move(events)); };
  for (int k = 0; k < most_kinks && side.piece != to.piece; ++k) {
    const double length = to.arclength - side.arclength;
    Correction correction;
    if (!(length > 0) || !locate_kink(probe(), side, length, kink, correction)) break;
    if (!probe().linearize(kink.v, probe().border_row(side.tangent))) break;
    evaluate(monitors_, probe(), kink);
    if (!look_beyond(kink, to, just_beyond * length, beyond)) break;
    evaluate(monitors_, probe(), beyond);
    add(gather(&EventLocator::find, side, kink));
    const double turn = probe().dot(kink.tangent, beyond.tangent);
    if (turn < 1 - 0.5 * smallest_kink * smallest_kink)
      add(across(kink, beyond));
    else
      add(gather(&EventLocator::find, kink, beyond));
    side = beyond;
  }
  return side;
}

}  // namespace arcslip::continuation
