#include <arcslip/continuation/tracing/event_locator.hpp>

#include <arcslip/continuation/correction/kink_location.hpp>
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

// The zero of a monitor between two points, on a smooth section or next to a kink.

namespace {

constexpr double nonsmooth_share = 1e-4;  // of a monitor's change over a step, remaining at its zero
constexpr double beyond_kink = 1e-3;      // of the way from the kink to the next point, to look at that side
constexpr double linearized_there = 1e-13;  // smaller corrections leave the factors of the solution
constexpr double steepest = 1.5;            // rad: between the chord of a step and the branch on it
constexpr double state_tolerance = 1e-10;   // relative, of u at an event
constexpr int samples_nearby = 4;           // of q on each side of an extremum, for its rounding
constexpr double sample_share = 1e-2;       // of the step, between them
constexpr double spreads = 2;               // of the samples: more is not rounding
constexpr double spreads_at_kink = 8;       // of two samples
constexpr double uncertain_sign = 1e-3;     // of a monitor's change over a section: a value nearer to zero
constexpr double near_singular = 1e-6;      // of a section: places next to one with a singular matrix
constexpr double finest_share = 1e-13, coarsest_share = 1e-3;  // of a step, to which its zero is bracketed

// The value of a monitor at the share s of a section, corrected onto the branch from the cubic between its
// ends.
class OnSection {
 public:
  OnSection(Corrector& probe, const Monitor& monitor, const CurvePoint& from, const CurvePoint& to,
            double largest_angle)
      : probe_(probe),
        monitor_(monitor),
        from_(from),
        to_(to),
        length_(to.arclength - from.arclength),
        chord_(to.v - from.v),
        row_(probe.border_row(chord_ / length_)),
        least_along_(length_ * std::cos(std::min(2 * largest_angle, steepest))),
        place_(to),
        positive_{0, 0, to, {}, 0, false},
        negative_{positive_} {}

  /// A place of the section at which the monitor is known.
  struct Sample {
    double s, value;
    CurvePoint place;
    Correction correction;
    double quantity;
    bool corrected;  // by this; else an end of the section, with its errors
  };

  double operator()(double s) {
    const std::optional<double> f = go_near(s) ? measure() : singular_ ? between_neighbours(s) : std::nullopt;
    if (!f) return fail();
    factors_ = true;
    failed_ = std::isnan(*f);
    Sample& end = side(*f);
    take(end, s, *f, place_);
    end.correction = correction_;
    end.quantity = quantity_of(monitor_, accepted(probe_, place_));
    end.corrected = true;
    return *f;
  }

  /// Notes an end of the section.
  void took(double f, double s, const CurvePoint& place) {
    take(side(f), s, f, place);
    side(f).corrected = false;
  }

  /// The last places with either sign of the monitor bracket the zero. Whether they lie on two pieces.
  bool changes_piece() const { return positive_.place.piece != negative_.place.piece; }

  /// The place at s, an end of the bracket or a new one.
  const Sample& sample(double s) {
    for (const Sample* each : {&positive_, &negative_})
      if (each->s == s && each->corrected) return *each;
    return side((*this)(s));
  }

  bool failed() const { return failed_; }

  /// Of s, to locate a zero to the tolerances in p and u.
  double tolerance(double in_p) const {
    const Eigen::Index n = to_.v.size() - 1;
    const double p_size = std::max(std::abs(to_.v[n]), 1e-300);
    const double u_size = std::max(probe_.norm_u(to_.v), 1e-300);
    const double by_p = in_p * p_size / std::max(std::abs(chord_[n]), 1e-300);
    const double by_u = state_tolerance * u_size / std::max(probe_.norm_u(chord_), 1e-300);
    return std::clamp(std::min(by_p, by_u), finest_share, coarsest_share);
  }

 private:
  double fail() {
    failed_ = true;
    return 0;
  }

  Sample& side(double f) { return f > 0 ? positive_ : negative_; }

  static void take(Sample& sample, double s, double f, const CurvePoint& place) {
    sample.s = s;
    sample.value = f;
    sample.place.v = place.v;
    sample.place.tangent = place.tangent;
    sample.place.arclength = place.arclength;
    sample.place.orientation = place.orientation;
    sample.place.piece = place.piece;
  }

  bool go_near(double s) {
    singular_ = false;
    hermite(from_.v, from_.tangent, to_.v, to_.tangent, length_, s, guess_);
    if (go_to_branch(factors_) || go_to_branch(false)) return true;
    // Next to a kink the cubic may lie beyond it, where it leads elsewhere: between the ends of the bracket.
    if (positive_.s == negative_.s) return false;
    const double share = (s - negative_.s) / (positive_.s - negative_.s);
    guess_ = negative_.place.v + share * (positive_.place.v - negative_.place.v);
    return go_to_branch(false);
  }

  // From guess_, along the plane through it. A tangent from factors near the solution may be less accurate
  // than the zero requires.
  bool go_to_branch(bool factors) {
    place_.v = guess_;
    correction_ = probe_.correct(place_.v, row_, factors);
    singular_ = singular_ || correction_.singular || !std::isfinite(correction_.last);
    if (!correction_.converged || distance(probe_, guess_, place_.v) > length_) return false;
    if ((correction_.last <= linearized_there || probe_.linearize(place_.v, row_)) && settle(probe_, place_))
      return true;
    singular_ = true;
    return false;
  }

  // The monitor at the place. Nothing: it lies on another branch.
  std::optional<double> measure() {
    const bool smooth = to_.piece == from_.piece && place_.piece == from_.piece;
    if (smooth && probe_.dot(place_.tangent, chord_) < least_along_) return {};
    place_.arclength = from_.arclength + distance(probe_, from_.v, place_.v);
    return value_of(monitor_, accepted(probe_, place_));
  }

  // Where the linear solver fails on the place itself, as one that takes J alone where J is singular: the
  // means of two places next to it, which differ from what is there by the square of their distance.
  std::optional<double> between_neighbours(double s) {
    if (!go_near(s - near_singular)) return {};
    const auto f = measure();
    const CurvePoint before = place_;
    if (!f || !go_near(s + near_singular) || place_.piece != before.piece) return {};
    const auto g = measure();
    place_.v = 0.5 * (before.v + place_.v);
    place_.tangent += before.tangent;
    place_.tangent /= std::sqrt(probe_.dot(place_.tangent, place_.tangent));
    place_.arclength = 0.5 * (before.arclength + place_.arclength);
    if (!g || !probe_.move_to(place_.v)) return {};
    return 0.5 * (*f + *g);
  }

  Corrector& probe_;
  const Monitor& monitor_;
  const CurvePoint &from_, &to_;
  double length_;
  Vector chord_, row_, guess_;
  double least_along_;
  CurvePoint place_;
  Correction correction_;
  bool factors_ = false, failed_ = false;
  bool singular_ = false;  // the last corrections met a singular matrix
  Sample positive_, negative_;
};

// The rounding of a quantity next to its extremum at s: its spread over a part of the section in which it
// hardly changes.
double spread_nearby(OnSection& value, double s, double extremum) {
  double lowest = extremum, highest = lowest;
  for (int k = -samples_nearby; k <= samples_nearby; ++k) {
    const double q = value.sample(s + sample_share * k).quantity;
    if (value.failed()) break;
    lowest = std::min(lowest, q);
    highest = std::max(highest, q);
  }
  const double representable = std::numeric_limits<double>::epsilon() * std::abs(extremum);
  return spreads * std::max(highest - lowest, representable);
}

}  // namespace

// If the corrector fails between the points, the one with the monitor nearer to zero represents the event.
LocatedEvent EventLocator::nearer_end(std::size_t monitor, const CurvePoint& from,
                                      const CurvePoint& to) const {
  const CurvePoint& end = std::abs(from.monitors[monitor]) < std::abs(to.monitors[monitor]) ? from : to;
  Event found = event(monitor, end, end.monitors[monitor], {});
  found.located = false;
  return {std::move(found), end, end.quantities[monitor]};
}

// A quantity is the same on both sides of a kink, but for its rounding.
std::optional<LocatedEvent> EventLocator::at_kink(std::size_t monitor, const CurvePoint& kink,
                                                  const CurvePoint& beyond) {
  Event found = event(monitor, kink, kink.monitors[monitor], {});
  found.nonsmooth = true;
  LocatedEvent result{std::move(found), kink, kink.quantities[monitor]};
  if (!monitors_[monitor].quantity) return result;
  const double representable = std::numeric_limits<double>::epsilon() * std::abs(result.quantity);
  const double jump = std::abs(beyond.quantities[monitor] - kink.quantities[monitor]);
  result.rounding = spreads_at_kink * std::max(jump, representable);
  return result;
}

std::optional<LocatedEvent> EventLocator::locate_near_kink(std::size_t monitor, const CurvePoint& from,
                                                           const CurvePoint& to) {
  Corrector& probe = this->probe();
  CurvePoint kink;
  Correction correction;
  if (!locate_kink(probe, from, to.arclength - from.arclength, kink, correction))
    return nearer_end(monitor, from, to);
  const double ahead = beyond_kink * (to.arclength - kink.arclength);
  CurvePoint beyond = to;
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
  if (changes_sign(from, kink)) take_limits(from, to.arclength - from.arclength, kink);
  if ((kink.monitors[monitor] > 0) != positive) return locate(monitor, from, kink);
  return at_kink(monitor, kink, beyond);
}

std::optional<LocatedEvent> EventLocator::locate(std::size_t monitor, const CurvePoint& from,
                                                 const CurvePoint& to) {
  OnSection value(probe(), monitors_[monitor], from, to, options_.step.largest_angle);
  const double a = from.monitors[monitor], b = to.monitors[monitor];
  // Matrices are singular at a crossing; a value next to zero may have the wrong sign.
  const bool certain = from_crossing_ || std::abs(a) > uncertain_sign * std::abs(b - a);
  double begin = 0, at_begin = certain ? a : value(0);
  if (certain) value.took(a, 0, from);
  while (!value.failed() && (at_begin > 0) == (b > 0) && at_begin != 0) {  // the sign of `from` was rounding
    if (begin <= -1) return std::nullopt;
    begin = begin == 0 ? -0.25 : 2 * begin;
    at_begin = value(begin);
  }
  if (value.failed()) return nearer_end(monitor, from, to);
  value.took(b, 1, to);
  const auto at = [&](double s) { return value(s); };
  const Root root = find_root(at, begin, at_begin, 1, b, value.tolerance(options_.event_tolerance));
  if (value.failed()) return nearer_end(monitor, from, to);
  const auto& zero = value.sample(root.x);
  if (value.failed()) return nearer_end(monitor, from, to);
  LocatedEvent found{event(monitor, zero.place, zero.value, zero.correction), zero.place};
  found.event.nonsmooth = value.changes_piece() && std::max(std::abs(root.f_lower), std::abs(root.f_upper)) >
                                                       nonsmooth_share * std::abs(b - a);
  if (!monitors_[monitor].quantity) return found;
  found.quantity = zero.quantity;
  const double change = std::max(std::abs(a), std::abs(b)) * (to.arclength - from.arclength);
  if (change <= options_.newton.rounding_level * std::abs(found.quantity))
    found.rounding = spread_nearby(value, root.x, found.quantity);
  return found;
}

}  // namespace arcslip::continuation
