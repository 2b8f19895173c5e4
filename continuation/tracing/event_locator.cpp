#include <arcslip/continuation/tracing/event_locator.hpp>

#include <arcslip/continuation/events/monitor_calls.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double newton_share = 1e-2;   // the corrector's tolerance, of that on the branch
constexpr double near_event = 1e-7;     // of 1 + |u|: where the matrix is not singular, to describe an event
constexpr double smallest_kink = 1e-4;  // rad

// An extremum between two points that is not searched for lies within the intersection of the tangents to the
// quantity at both ends.
double farthest_extremum(std::size_t monitor, const CurvePoint& from, const CurvePoint& to) {
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
  state_ = problem_->initial_state();
}

Corrector& EventLocator::probe() {
  if (!probe_) {
    NewtonOptions newton = options_.newton;
    newton.tolerance *= newton_share;
    probe_ = std::make_unique<Corrector>(*problem_, p_, free_, newton, counts_, options_.linear_solver);
  }
  return *probe_;
}

std::vector<LocatedEvent> EventLocator::between(const CurvePoint& from, const CurvePoint& to) {
  return gather(&EventLocator::find, from, to);
}

std::vector<LocatedEvent> EventLocator::across(const PassedKink& corner) {
  std::vector<LocatedEvent> found = gather(&EventLocator::at_kink, corner.before, corner.beyond);
  if (angle_between(probe().dot(corner.before.tangent, corner.beyond.tangent)) > smallest_kink)
    for (const Monitor& monitor : monitors_)
      if (monitor.kind == MonitorKind::kink) found.push_back(kink_event(monitor, corner));
  return found;
}

std::vector<LocatedEvent> EventLocator::gather(Find by, const CurvePoint& from, const CurvePoint& to) {
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

void EventLocator::follow(std::size_t monitor, Find by, const CurvePoint& from, const CurvePoint& to,
                          std::vector<LocatedEvent>& certain) {
  Course& course = courses_[monitor];
  const double q = from.quantities[monitor], next = to.quantities[monitor];
  if (!course.last) course.last = q;
  if (changes(monitor, from, to, Crossing::any)) {
    const int side = from.monitors[monitor] > 0 ? 1 : -1;
    const bool wanted = changes(monitor, from, to, monitors_[monitor].crossing);
    auto event = wanted ? (this->*by)(monitor, from, to) : std::nullopt;
    const double extreme = event ? event->quantity : farthest_extremum(monitor, from, to);
    judge(course, extreme, certain);
    if (course.waiting && course.side != side) {
      course.waiting.reset();
    } else if (!event) {
      if (!wanted) course.last = extreme;
    } else if (event->rounding == 0 || side * (event->quantity - *course.last) > event->rounding) {
      course.waiting = std::move(event);
      course.waiting->accepted = state_;
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
    course.waiting->accepted = state_;
  }
  judge(course, next, certain);
}

std::optional<LocatedEvent> EventLocator::find(std::size_t monitor, const CurvePoint& from,
                                               const CurvePoint& to) {
  return turns(from, to) ? locate_near_kink(monitor, from, to) : locate(monitor, from, to);
}

bool EventLocator::is_event(std::size_t monitor, const LocatedEvent& found) {
  if (!monitors_[monitor].is_event) return true;
  const auto now = look_near(found.place);
  return !now || call(monitors_[monitor].is_event, monitors_[monitor], *now);
}

void EventLocator::describe(std::size_t monitor, LocatedEvent& found) {
  const Monitor& by = monitors_[monitor];
  if (found.event.nonsmooth || !found.event.located || refine(by, found) || !by.describe) return;
  if (const auto now = look_near(found.place)) found.event.data = call(by.describe, by, *now);
}

bool EventLocator::refine(const Monitor& by, LocatedEvent& found) {
  if (!by.refine) return false;
  const auto now = look_at(found.place);
  auto refined = now ? call(by.refine, by, *now) : std::nullopt;
  if (!refined || refined->v.size() != found.place.v.size() || !refined->v.allFinite()) return false;
  found.place.v = std::move(refined->v);
  const Eigen::Index n = found.place.v.size() - 1;
  found.event.point.u = found.place.v.head(n);
  found.event.point.parameter = found.place.v[n];
  found.event.data = std::move(refined->data);
  return true;
}

std::optional<Accepted> EventLocator::look_at(const CurvePoint& event) {
  if (!probe().linearize(event.v, probe().border_row(event.tangent))) return std::nullopt;
  if (!probe().move_to(event.v)) return std::nullopt;
  return accepted(probe(), event);
}

// The same, with factors next to the event if the linear solver fails on it. At a branch point the matrix
// itself is singular.
std::optional<Accepted> EventLocator::look_near(const CurvePoint& event) {
  if (auto now = look_at(event); now || from_crossing_) return now;
  const double aside = near_event * (1 + probe().norm_u(event.v));
  if (!probe().linearize(event.v + aside * event.tangent, probe().border_row(event.tangent)))
    return std::nullopt;
  if (!probe().move_to(event.v, Needs::jacobian)) return std::nullopt;
  return accepted(probe(), event);
}

bool EventLocator::changes_sign(const CurvePoint& from, const CurvePoint& to) const {
  for (std::size_t m = 0; m < monitors_.size(); ++m)
    if (changes(m, from, to, Crossing::any)) return true;
  return false;
}

bool EventLocator::changes(std::size_t monitor, const CurvePoint& from, const CurvePoint& to,
                           Crossing wanted) const {
  const double a = from.monitors[monitor], b = to.monitors[monitor];
  const bool falling = a > 0 && b <= 0, rising = a < 0 && b >= 0;
  return (falling && wanted != Crossing::rising) || (rising && wanted != Crossing::falling);
}

bool EventLocator::turns(const CurvePoint& from, const CurvePoint& to) {
  return to.piece != from.piece &&
         probe().dot(to.tangent, from.tangent) < std::cos(options_.step.largest_angle);
}

Event EventLocator::event(std::size_t monitor, const CurvePoint& place, double value,
                          const Correction& correction) const {
  Event result;
  result.monitor = monitors_[monitor].name;
  result.value = value;
  result.point = point(place, correction);
  return result;
}

}  // namespace arcslip::continuation
