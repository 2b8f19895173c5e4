// Events other than zeros of functions: kinks, and crossings of two branches.

#include <arcslip/continuation/events/monitor_calls.hpp>
#include <arcslip/continuation/events/place_of_event.hpp>
#include <arcslip/continuation/normal_forms/steady_form.hpp>
#include <arcslip/continuation/special_points/branch_point.hpp>
#include <arcslip/continuation/special_points/multiple_point.hpp>
#include <arcslip/continuation/tracing/event_locator.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <span>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double guess_shares[] = {0.5, 0.1, 0.9};  // shares of a step: initial guesses of branch points
constexpr int most_kinks = 16;                      // in one step
// Of a step: distances to the far side of a kink, and of one that only divides the curve.
constexpr double just_beyond[] = {1e-9, 1e-6, 1e-3}, beyond_division[] = {1e-4, 1e-3, 1e-2};
constexpr double just_before = 1e-9;        // of a step: distance to the near side of a kink,
constexpr double beyond_its_error = 1e-11;  // and of |u|
constexpr double near_step = 0.1;           // of a step: a branch point this close lies on it
constexpr double beyond_step = 1e-4;        // tolerance beyond its ends, for rounding
// Of a monitor's change over a step, and of the largest dp/ds for the type of a branch point: smaller values
// count as zero.
constexpr double zero_share = 1e-6;

}  // namespace

// The branch point x as an event of the step. Nothing if it does not lie on the step.
std::optional<LocatedEvent> EventLocator::crossing_event(const CurvePoint& from, const CurvePoint& to,
                                                         const Vector& x, BranchPoint&& branches) {
  const double length = to.arclength - from.arclength;
  Corrector& probe = this->probe();
  Vector nearby(x.size());
  const double share = probe.dot(x - from.v, to.v - from.v) / (length * length);
  if (!(share > -beyond_step && share < 1 + beyond_step)) return std::nullopt;
  hermite(from.v, from.tangent, to.v, to.tangent, length, share, nearby);
  if (distance(probe, nearby, x) > near_step * length) return std::nullopt;
  LocatedEvent found;
  found.place = from;
  found.place.v = x;
  found.place.tangent = branches.tangents.front();
  found.place.arclength = from.arclength + std::clamp(share, 0.0, 1.0) * length;
  for (const Monitor& monitor : monitors_)
    if (monitor.kind == MonitorKind::branch_point) found.event.monitor = monitor.name;
  found.event.point = point(found.place, {});
  found.event.data = std::move(branches);
  return found;
}

std::optional<LocatedEvent> EventLocator::branch_point(const CurvePoint& from, const CurvePoint& to) {
  Vector nearby(from.v.size());
  for (const double guess : guess_shares) {
    hermite(from.v, from.tangent, to.v, to.tangent, to.arclength - from.arclength, guess, nearby);
    std::optional<BranchPointLocation> crossing;
    try {
      crossing = locate_branch_point(problem_, p_, free_, nearby, options_.linear_solver, options_.newton);
    } catch (const std::exception&) {  // a point that cannot be evaluated, for the corrector
    }
    if (!crossing) continue;
    auto branches = describe_branch_point(*problem_, free_, *crossing, to.v - from.v);
    if (!branches) continue;
    auto found = crossing_event(from, to, crossing->x, std::move(*branches));
    if (!found) continue;
    add_normal_form(probe().evaluator(), place_of_event(accepted(probe(), found->place)),
                    std::get<BranchPoint>(found->event.data));
    return found;
  }
  return std::nullopt;
}

std::optional<LocatedEvent> EventLocator::multiple_point(const CurvePoint& from, const CurvePoint& to,
                                                         int rank_loss) {
  const double length = to.arclength - from.arclength;
  Corrector& probe = this->probe();
  const Vector chord = to.v - from.v;
  Vector nearby(from.v.size());
  for (const double guess : guess_shares) {
    hermite(from.v, from.tangent, to.v, to.tangent, length, guess, nearby);
    std::optional<MultiplePoint> crossing;
    try {
      crossing = locate_multiple_point(*problem_, p_, free_, nearby, rank_loss, (1 + near_step) * length,
                                       options_.linear_solver);
    } catch (const std::exception&) {
    }
    if (!crossing || crossing->tangents.empty()) continue;
    BranchPoint branches;
    branches.type = BranchPoint::Type::multiple;
    branches.tangents = std::move(crossing->tangents);
    const auto along = [&](const Vector& t) { return std::abs(probe.dot(t, chord)); };
    const auto traced =
        std::max_element(branches.tangents.begin(), branches.tangents.end(),
                         [&](const Vector& a, const Vector& b) { return along(a) < along(b); });
    if (along(*traced) < length * std::cos(options_.step.largest_angle)) continue;
    std::iter_swap(branches.tangents.begin(), traced);
    Vector& tangent = branches.tangents.front();
    if (probe.dot(tangent, chord) < 0) tangent = -tangent;
    if (auto found = crossing_event(from, to, crossing->x, std::move(branches))) return found;
  }
  return std::nullopt;
}

std::vector<LocatedEvent> EventLocator::past(const CurvePoint& from, const CurvePoint& crossing,
                                             const CurvePoint& to) {
  CurvePoint at = crossing;
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

std::optional<LocatedEvent> EventLocator::beyond_crossing(std::size_t monitor, const CurvePoint& crossing,
                                                          const CurvePoint& to) {
  if (!zero_at_crossing_[monitor]) return find(monitor, crossing, to);
  if (!monitors_[monitor].at_branch_points) return std::nullopt;
  return LocatedEvent{event(monitor, crossing, 0, {}), crossing, crossing.quantities[monitor]};
}

LocatedEvent EventLocator::kink_event(const Monitor& monitor, const PassedKink& corner) const {
  LocatedEvent found;
  found.event.monitor = monitor.name;
  found.event.point = point(corner.before, {});
  found.event.nonsmooth = true;
  found.event.data = Kink{corner.before.tangent, corner.beyond.tangent};
  found.place = corner.before;
  return found;
}

// A point of the branch just beyond a kink, with its tangent: linearized ahead on the other piece, and
// corrected along that tangent, farther away than the error of the kink.
bool EventLocator::look_beyond(const CurvePoint& kink, double way, bool is_next_to_it, const Vector& towards,
                               CurvePoint& beyond) {
  Corrector& probe = this->probe();
  beyond = kink;
  beyond.v = kink.v + way * kink.tangent;
  if (!probe.linearize(beyond.v, probe.border_row(kink.tangent)) || !settle(probe, beyond)) {
    const Vector row = Vector::Unit(beyond.v.size(), beyond.v.size() - 1);  // orthogonal to it
    if (!probe.linearize(beyond.v, row) || !settle(probe, beyond)) return false;
  }
  const bool against =
      kink.orientation != 0 ? beyond.orientation != kink.orientation : probe.dot(beyond.tangent, towards) < 0;
  if (against) beyond.reverse();
  const Vector tangent = beyond.tangent;
  beyond.v = kink.v + way * tangent;
  const bool on_it = is_next_to_it ? probe.move_to(beyond.v) && probe.piece(beyond.piece)
                                   : probe.correct(beyond.v, probe.border_row(tangent), false).converged &&
                                         settle(probe, beyond);
  if (!on_it) return false;
  beyond.arclength = kink.arclength + way;
  return beyond.piece != kink.piece && (kink.orientation == 0 || beyond.orientation == kink.orientation);
}

std::optional<PassedKink> EventLocator::corner(const CurvePoint& from, double length, const Vector& towards,
                                               double accuracy) {
  const auto known = std::find_if(located_.begin(), located_.end(), [&](const LocatedCorner& each) {
    return each.from == from.v && each.accuracy == accuracy &&
           each.corner.before.arclength - from.arclength < length;
  });
  if (known != located_.end() && known->has_beyond && from.orientation != 0) return known->corner;
  LocatedCorner found{from.v, accuracy, {}, false};
  if (known != located_.end())
    found.corner.before = known->corner.before;
  else if (!locate_corner(from, length, accuracy, found.corner.before))
    return std::nullopt;
  found.has_beyond = pass(found.corner, length, towards, accuracy);
  if (known != located_.end())
    *known = found;
  else
    located_.push_back(found);
  return found.has_beyond ? std::optional(found.corner) : std::nullopt;
}

bool EventLocator::locate_corner(const CurvePoint& from, double length, double accuracy, CurvePoint& kink) {
  Correction correction;
  if (!locate_kink(probe(), from, length, kink, correction, {}, accuracy)) return false;
  if (correction.converged)
    probe().move_to(kink.v);
  else if (!probe().linearize(kink.v, probe().border_row(from.tangent)))  // it is `from` itself
    return false;
  evaluate(monitors_, probe(), kink);
  if (changes_sign(from, kink)) {
    take_limits(from, length, kink);
    probe().linearize(kink.v, probe().border_row(from.tangent));
    probe().move_to(kink.v);
  }
  return true;
}

// What is of no length at a kink, as a phase that is just born, may have any derivative there to rounding:
// the derivatives before the kink are limits. A monitor that changes its sign only at the kink itself has the
// value just before it.
void EventLocator::take_limits(const CurvePoint& from, double length, CurvePoint& kink) {
  Corrector& probe = this->probe();
  const double way = std::max(just_before * length, beyond_its_error * probe.norm_u(kink.v));
  CurvePoint before = kink;
  before.v -= way * from.tangent;
  before.arclength -= way;
  if (!(before.arclength > from.arclength) ||
      !probe.correct(before.v, probe.border_row(from.tangent), false).converged || !settle(probe, before) ||
      before.piece != kink.piece)
    return;
  const bool against = from.orientation != 0 ? before.orientation != from.orientation
                                             : probe.dot(before.tangent, from.tangent) < 0;
  if (against) before.reverse();
  evaluate(monitors_, probe, before);
  for (std::size_t m = 0; m < monitors_.size(); ++m) {
    if (!changes(m, from, kink, Crossing::any) || changes(m, from, before, Crossing::any)) continue;
    kink.monitors[m] = before.monitors[m];
  }
}

bool EventLocator::pass(PassedKink& corner, double length, const Vector& towards, double accuracy) {
  const std::span<const double> shares = accuracy > finest_kink ? beyond_division : just_beyond;
  for (const double share : shares) {
    if (!look_beyond(corner.before, share * length, share == shares[0], towards, corner.beyond)) continue;
    evaluate(monitors_, probe(), corner.beyond);
    return true;
  }
  return false;
}

bool EventLocator::looks_for_kinks() const {
  return std::any_of(monitors_.begin(), monitors_.end(), [](const Monitor& each) {
    return each.kind == MonitorKind::kink || (each.quantity && each.divides_at_kinks);
  });
}

std::vector<PassedKink> EventLocator::corners(const CurvePoint& from, const CurvePoint& to, double accuracy) {
  if (accuracy > finest_kink && !changes_sign(from, to)) {
    auto found = corners_within(from, to, accuracy);
    const CurvePoint* side = &from;
    bool any_sign = false;
    for (const PassedKink& each : found) {
      any_sign = any_sign || changes_sign(*side, each.before) || changes_sign(each.before, each.beyond);
      side = &each.beyond;
    }
    if (!any_sign && !changes_sign(*side, to)) return found;
  }
  return corners_within(from, to, finest_kink);
}

std::vector<PassedKink> EventLocator::corners_within(const CurvePoint& from, const CurvePoint& to,
                                                     double accuracy) {
  std::vector<PassedKink> found;
  if (to.piece == from.piece || !looks_for_kinks()) return found;
  const CurvePoint* side = &from;
  for (int k = 0; k < most_kinks && side->piece != to.piece; ++k) {
    const Vector way = to.v - side->v;
    const double length = std::sqrt(probe().dot(way, way));
    if (!(length > 0)) break;
    auto next = corner(*side, length, way, accuracy);
    if (!next) break;
    found.push_back(std::move(*next));
    side = &found.back().beyond;
  }
  return found;
}

std::optional<PassedKink> EventLocator::division(const CurvePoint& from, double length) {
  Corrector& probe = this->probe();
  CurvePoint at = from;
  const auto part = [&](const Vector& v) {
    at.v = v;
    const Accepted now = accepted(probe, at);
    std::uint64_t all = 0;
    for (const Monitor& monitor : monitors_) {
      if (monitor.part) value_of(monitor, now);
      all = with_part(all, monitor, now);
    }
    return all;
  };
  PassedKink found;
  Correction correction;
  const auto is_inside = [&](const Vector& v) { return part(v) == from.part; };
  if (!locate_kink(probe, from, length, found.before, correction, is_inside)) return std::nullopt;
  const auto measured = [&](CurvePoint& place) {
    if (!probe.linearize(place.v, probe.border_row(from.tangent)) || !settle(probe, place)) return false;
    if (probe.dot(place.tangent, from.tangent) < 0) place.reverse();
    evaluate(monitors_, probe, place);
    return true;
  };
  if (!measured(found.before)) return std::nullopt;
  for (const double share : just_beyond) {
    CurvePoint& beyond = found.beyond = found.before;
    beyond.v += share * length * found.before.tangent;
    if (!probe.correct(beyond.v, probe.border_row(found.before.tangent), false).converged ||
        !measured(beyond))
      return std::nullopt;
    beyond.arclength += share * length;
    if (beyond.piece == from.piece && beyond.part != from.part) return found;
  }
  return std::nullopt;
}

std::vector<PassedKink> EventLocator::divisions(const CurvePoint& from, const CurvePoint& to) {
  std::vector<PassedKink> found;
  const CurvePoint* side = &from;
  for (int k = 0; k < most_kinks && side->piece == to.piece && side->part != to.part; ++k) {
    const double length = continuation::distance(probe(), side->v, to.v);
    if (!(length > 0)) break;
    auto next = division(*side, length);
    if (!next) break;
    found.push_back(std::move(*next));
    side = &found.back().beyond;
  }
  return found;
}

}  // namespace arcslip::continuation
