#include <arcslip/continuation/tracing/event_locator.hpp>

#include <arcslip/continuation/events/monitor_calls.hpp>
#include <arcslip/continuation/events/root.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double newton_share = 1e-2;   // the corrector's tolerance, of that on the branch
constexpr double smallest_kink = 1e-4;  // rad

// An extremum between two points that is not searched for lies within the intersection of the tangents to the
// quantity at both ends.
double farthest_extreme(std::size_t monitor, const Place& from, const Place& to) {
  const double a = from.monitors[monitor], b = to.monitors[monitor], length = to.arclength - from.arclength;
  const double q = from.quantities[monitor], next = to.quantities[monitor];
  return q + a * std::clamp((next - q - b * length) / (a - b), 0.0, length);
}

}  // namespace

void append(std::vector<LocatedEvent>& found, std::vector<LocatedEvent>&& next) {
  std::move(next.begin(), next.end(), std::back_inserter(found));
}

EventLocator::EventLocator(std::shared_ptr<const Problem> problem, Vector p, int free, const Options& options,
                           const std::vector<Monitor>& monitors, std::vector<Course>& courses, Counts& counts)
    : problem_(std::move(problem)),
      p_(std::move(p)),
      free_(free),
      options_(options),
      monitors_(monitors),
      courses_(courses),
      counts_(counts) {
  courses_.resize(monitors_.size());
}

Corrector& EventLocator::probe() {
  if (!probe_) {
    NewtonOptions newton = options_.newton;
    newton.tolerance *= newton_share;
    probe_ = std::make_unique<Corrector>(*problem_, p_, free_, newton, counts_, options_.linear_solver);
  }
  return *probe_;
}

std::vector<LocatedEvent> EventLocator::between(const Place& from, const Place& to) {
  return gather(&EventLocator::find, from, to);
}

std::vector<LocatedEvent> EventLocator::across(const Corner& corner) {
  std::vector<LocatedEvent> found = gather(&EventLocator::at_kink, corner.before, corner.beyond);
  if (angle_between(probe().dot(corner.before.tangent, corner.beyond.tangent)) > smallest_kink)
    for (const Monitor& monitor : monitors_)
      if (monitor.kind == MonitorKind::kink) found.push_back(kink_event(monitor, corner));
  return found;
}

std::vector<LocatedEvent> EventLocator::gather(Find by, const Place& from, const Place& to) {
  std::vector<LocatedEvent> found;
  for (std::size_t m = 0; m < monitors_.size(); ++m) {
    const auto before = static_cast<std::ptrdiff_t>(found.size());
    if (monitors_[m].quantity) {
      follow(m, by, from, to, found);
    } else if (changes(m, from, to, monitors_[m].crossing)) {
      auto event = (this->*by)(m, from, to);
      if (event && is_event(m, *event)) found.push_back(std::move(*event));
    }
    std::for_each(found.begin() + before, found.end(), [&](LocatedEvent& each) { describe(m, each); });
  }
  std::stable_sort(found.begin(), found.end(), [](const LocatedEvent& x, const LocatedEvent& y) {
    return x.event.point.arclength < y.event.point.arclength;
  });
  return found;
}

// Updates a pending extremum with the value q: certain if q has departed from it, dropped if q has passed
// beyond it.
void EventLocator::judge(Course& course, double q, std::vector<LocatedEvent>& certain) {
  if (!course.waiting) return;
  const double departure = course.side * (course.waiting->quantity - q), rounding = course.waiting->rounding;
  if (rounding > 0 && std::abs(departure) <= rounding) return;
  if (rounding == 0 || departure > 0) {
    course.last = course.waiting->quantity;
    certain.push_back(std::move(*course.waiting));
  }
  course.waiting.reset();
}

void EventLocator::follow(std::size_t monitor, Find by, const Place& from, const Place& to,
                          std::vector<LocatedEvent>& certain) {
  Course& course = courses_[monitor];
  const double q = from.quantities[monitor], next = to.quantities[monitor];
  if (!course.last) course.last = q;
  if (changes(monitor, from, to, Crossing::any)) {
    const int side = from.monitors[monitor] > 0 ? 1 : -1;
    const bool wanted = changes(monitor, from, to, monitors_[monitor].crossing);
    auto event = wanted ? (this->*by)(monitor, from, to) : std::nullopt;
    const double extreme = event ? event->quantity : farthest_extreme(monitor, from, to);
    judge(course, extreme, certain);
    if (course.waiting && course.side != side) {
      course.waiting.reset();
    } else if (!event) {
      if (!wanted) course.last = extreme;
    } else if (event->rounding == 0 || side * (event->quantity - *course.last) > event->rounding) {
      course.waiting = std::move(event);
      course.side = side;
    }
  }
  const bool went_on = course.waiting && course.waiting->rounding > 0 &&
                       course.side * (next - course.waiting->quantity) > course.waiting->rounding;
  if (went_on) {  // q decides against its slope, whose sign is still that beyond the extremum: it is here
    course.waiting->event.point = point(to, {});
    course.waiting->event.value = to.monitors[monitor];
    course.waiting->place = to;
    course.waiting->quantity = next;
  }
  judge(course, next, certain);
}

std::optional<LocatedEvent> EventLocator::find(std::size_t monitor, const Place& from, const Place& to) {
  return turns(from, to) ? locate_beside_kink(monitor, from, to) : locate(monitor, from, to);
}

bool EventLocator::is_event(std::size_t monitor, const LocatedEvent& found) {
  if (!monitors_[monitor].is_event) return true;
  const auto now = look_at(found.place);
  return !now || call(monitors_[monitor].is_event, monitors_[monitor], *now);
}

void EventLocator::describe(std::size_t monitor, LocatedEvent& found) {
  const Monitor& by = monitors_[monitor];
  if (!by.describe || found.event.nonsmooth || !found.event.located) return;
  if (const auto now = look_at(found.place)) found.event.data = call(by.describe, by, *now);
}

std::optional<Accepted> EventLocator::look_at(const Place& event) {
  if (!probe().linearize(event.v, probe().border_row(event.tangent))) return std::nullopt;
  probe().move_to(event.v);
  return accepted(probe(), event);
}

bool EventLocator::changes_sign(const Place& from, const Place& to) const {
  for (std::size_t m = 0; m < monitors_.size(); ++m)
    if (changes(m, from, to, Crossing::any)) return true;
  return false;
}

bool EventLocator::changes(std::size_t monitor, const Place& from, const Place& to, Crossing wanted) const {
  const double a = from.monitors[monitor], b = to.monitors[monitor];
  const bool falling = a > 0 && b <= 0, rising = a < 0 && b >= 0;
  return (falling && wanted != Crossing::rising) || (rising && wanted != Crossing::falling);
}

bool EventLocator::turns(const Place& from, const Place& to) {
  return to.piece != from.piece &&
         probe().dot(to.tangent, from.tangent) < std::cos(options_.step.largest_angle);
}

Event EventLocator::event(std::size_t monitor, const Place& place, double value,
                          const Correction& correction) const {
  Event result;
  result.monitor = monitors_[monitor].name;
  result.value = value;
  result.point = point(place, correction);
  return result;
}

// The zero of a monitor between two points, on a smooth section or next to a kink.

namespace {

constexpr double nonsmooth_share = 1e-4;  // of a monitor's change over a step, remaining at its zero
constexpr double beyond_kink = 1e-3;      // of the way from the kink to the next point, to look at that side
constexpr double linearized_there = 1e-13;  // smaller corrections leave the factors of the solution
constexpr double steepest = 1.5;            // rad: between the chord of a step and the branch on it
constexpr double state_tolerance = 1e-10;   // relative, of u at an event
constexpr int samples_beside = 4;           // of q on each side of an extremum, for its rounding
constexpr double sample_share = 1e-2;       // of the step, between them
constexpr double spreads = 2;               // of the samples: more is not rounding
constexpr double spreads_at_kink = 8;       // of two samples
constexpr double finest_share = 1e-13, coarsest_share = 1e-3;  // of a step, to which its zero is bracketed

}  // namespace

// If the corrector fails between the points, the one with the monitor nearer to zero represents the event.
LocatedEvent EventLocator::nearer_end(std::size_t monitor, const Place& from, const Place& to) const {
  const Place& end = std::abs(from.monitors[monitor]) < std::abs(to.monitors[monitor]) ? from : to;
  Event found = event(monitor, end, end.monitors[monitor], {});
  found.located = false;
  return {std::move(found), end, end.quantities[monitor]};
}

// A quantity is the same on both sides of a kink, but for its rounding.
std::optional<LocatedEvent> EventLocator::at_kink(std::size_t monitor, const Place& kink,
                                                  const Place& beyond) {
  Event found = event(monitor, kink, kink.monitors[monitor], {});
  found.nonsmooth = true;
  LocatedEvent result{std::move(found), kink, kink.quantities[monitor]};
  if (!monitors_[monitor].quantity) return result;
  const double representable = std::numeric_limits<double>::epsilon() * std::abs(result.quantity);
  const double jump = std::abs(beyond.quantities[monitor] - kink.quantities[monitor]);
  result.rounding = spreads_at_kink * std::max(jump, representable);
  return result;
}

std::optional<LocatedEvent> EventLocator::locate_beside_kink(std::size_t monitor, const Place& from,
                                                             const Place& to) {
  Corrector& probe = this->probe();
  Place kink;
  Correction correction;
  if (!locate_kink(probe, from, to.arclength - from.arclength, kink, correction))
    return nearer_end(monitor, from, to);
  const double ahead = beyond_kink * (to.arclength - kink.arclength);
  Place beyond = to;
  beyond.v = kink.v + ahead * to.tangent;
  if (!probe.correct(beyond.v, probe.border_row(to.tangent), false).converged || !settle(probe, beyond))
    return nearer_end(monitor, from, to);
  beyond.arclength = kink.arclength + ahead;
  if (probe.dot(beyond.tangent, to.tangent) < 0) beyond.reverse();
  evaluate(monitors_, probe, beyond);
  const bool positive = from.monitors[monitor] > 0;
  if (beyond.piece == to.piece && (beyond.monitors[monitor] > 0) == positive)
    return locate(monitor, beyond, to);
  if (!probe.linearize(kink.v, probe.border_row(from.tangent))) return nearer_end(monitor, from, to);
  evaluate(monitors_, probe, kink);
  if ((kink.monitors[monitor] > 0) != positive) return locate(monitor, from, kink);
  return at_kink(monitor, kink, beyond);
}

std::optional<LocatedEvent> EventLocator::locate(std::size_t monitor, const Place& from, const Place& to) {
  Corrector& probe = this->probe();
  const double length = to.arclength - from.arclength;
  const Vector chord = to.v - from.v;
  const Vector row = probe.border_row(chord / length);
  Place place = to;
  Correction correction;
  bool factors = false, failed = false;
  const bool smooth = to.piece == from.piece;
  const double least_along = length * std::cos(std::min(2 * options_.step.largest_angle, steepest));
  std::uint64_t positive_piece = 0, negative_piece = 0;  // of the last value of each sign: the bracket's ends
  const auto value = [&](double s) {
    hermite(from.v, from.tangent, to.v, to.tangent, length, s, place.v);
    correction = probe.correct(place.v, row, factors);
    if (!correction.converged) correction = probe.correct(place.v, row, false);
    // A tangent from factors near the solution may be less accurate than the zero requires.
    if (!correction.converged || (correction.last > linearized_there && !probe.linearize(place.v, row)) ||
        !settle(probe, place)) {
      failed = true;
      return 0.0;
    }
    factors = true;
    if (smooth && place.piece == from.piece && probe.dot(place.tangent, chord) < least_along) {
      failed = true;  // on another branch
      return 0.0;
    }
    place.arclength = from.arclength + distance(probe, from.v, place.v);
    const double f = value_of(monitors_[monitor], accepted(probe, place));
    failed = std::isnan(f);
    (f > 0 ? positive_piece : negative_piece) = place.piece;
    return f;
  };
  const Eigen::Index n = to.v.size() - 1;
  const double p_size = std::max(std::abs(to.v[n]), 1e-300);
  const double u_size = std::max(probe.norm_u(to.v), 1e-300);
  const double in_p = options_.event_tolerance * p_size / std::max(std::abs(chord[n]), 1e-300);
  const double in_u = state_tolerance * u_size / std::max(probe.norm_u(chord), 1e-300);
  const double tolerance = std::clamp(std::min(in_p, in_u), finest_share, coarsest_share);
  const double a = from.monitors[monitor], b = to.monitors[monitor];
  double begin = 0, at_begin = from_crossing_ ? a : value(0);      // matrices are singular at a crossing
  while (!failed && (at_begin > 0) == (b > 0) && at_begin != 0) {  // the sign of `from` was one of rounding
    if (begin <= -1) return std::nullopt;
    begin = begin == 0 ? -0.25 : 2 * begin;
    at_begin = value(begin);
  }
  if (failed) return nearer_end(monitor, from, to);
  (b > 0 ? positive_piece : negative_piece) = to.piece;
  const Root root = find_root(value, begin, at_begin, 1, b, tolerance);
  if (failed) return nearer_end(monitor, from, to);
  const double left = value(root.x);
  if (failed) return nearer_end(monitor, from, to);
  Event found = event(monitor, place, left, correction);
  found.nonsmooth =
      positive_piece != negative_piece &&
      std::max(std::abs(root.f_lower), std::abs(root.f_upper)) > nonsmooth_share * std::abs(b - a);
  LocatedEvent result{std::move(found), place};
  if (!monitors_[monitor].quantity) return result;
  result.quantity = quantity_of(monitors_[monitor], accepted(probe, place));
  if (std::max(std::abs(a), std::abs(b)) * length >
      options_.newton.rounding_level * std::abs(result.quantity))
    return result;
  double lowest = result.quantity, highest = lowest;
  for (int k = -samples_beside; k <= samples_beside && !failed; ++k) {
    value(root.x + sample_share * k);
    const double q = quantity_of(monitors_[monitor], accepted(probe, place));
    lowest = std::min(lowest, q);
    highest = std::max(highest, q);
  }
  const double representable = std::numeric_limits<double>::epsilon() * std::abs(result.quantity);
  result.rounding = spreads * std::max(highest - lowest, representable);
  return result;
}

}  // namespace arcslip::continuation
