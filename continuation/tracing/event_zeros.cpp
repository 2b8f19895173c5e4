// The zero of a monitor between two points, on a smooth section or next to a kink.

#include <arcslip/continuation/correction/kink_location.hpp>
#include <arcslip/continuation/events/monitor_calls.hpp>
#include <arcslip/continuation/events/root.hpp>
#include <arcslip/continuation/tracing/event_locator.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arcslip::continuation {
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
constexpr double close_ends = 0.05;         // of a section: ends of a bracket, to interpolate between them
constexpr double negligible_share = 0.1;    // of the tolerance: the distance of a place from the zero
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
        is_smooth_(probe.problem().smooth()),
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
    if (!factors_) note_bend(s);
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

  /// Smaller values are zero within the tolerance, by the slope between close ends of the bracket.
  double negligible(double tolerance) const {
    const double width = std::abs(positive_.s - negative_.s);
    if (!is_smooth_ || !(width > 0 && width < close_ends)) return 0;
    return negligible_share * tolerance * (positive_.value - negative_.value) / width;
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
    if (bend_.size() > 0) guess_ += quartic(s) * bend_;
    const double width = std::abs(positive_.s - negative_.s);
    if (is_smooth_ && width > 0 && width < close_ends) {
      guess_between_ends();
      if (go_to_branch(false)) return true;
      if (singular_) return false;
    }
    if (go_to_branch(factors_) || go_to_branch(false)) return true;
    // Next to a kink the cubic may lie beyond it, where it leads elsewhere: between the ends of the bracket.
    if (width == 0) return false;
    const double share = (s - negative_.s) / (positive_.s - negative_.s);
    guess_ = negative_.place.v + share * (positive_.place.v - negative_.place.v);
    return go_to_branch(false);
  }

  static double quartic(double s) { return s * s * (1 - s) * (1 - s); }

  // How far the first place is from the cubic, over the fourth power of s that vanishes with its slope at
  // both ends: what the cubic lacks of the branch, but for the next power.
  void note_bend(double s) {
    if (!is_smooth_ || !(s > 0 && s < 1)) return;
    bend_ = (place_.v - guess_) / quartic(s);
  }

  // From the cubic of the section to the one between the ends of the bracket, in the same plane across the
  // chord: so near to the branch that Newton's method from there takes one step.
  void guess_between_ends() {
    const CurvePoint &a = negative_.place, &b = positive_.place;
    const double plane = row_.dot(guess_), at_a = row_.dot(a.v), at_b = row_.dot(b.v);
    if (at_a == at_b) return;
    const double direction = at_b > at_a ? 1 : -1;
    hermite(a.v, direction * a.tangent, b.v, direction * b.tangent, distance(probe_, a.v, b.v),
            (plane - at_a) / (at_b - at_a), nearer_);
    const double along = row_.dot(a.tangent);
    guess_ = nearer_ + (plane - row_.dot(nearer_)) / along * a.tangent;
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
  Vector chord_, row_, guess_, nearer_, bend_;
  bool is_smooth_;  // F, wherever it is looked at
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

// The share of a section at which the cubic of a quantity, whose slope the monitor is, has its extremum; by
// the secant of the slope where it has none.
double first_share(std::size_t monitor, const CurvePoint& from, const CurvePoint& to) {
  const double length = to.arclength - from.arclength;
  const double a = length * from.monitors[monitor], b = length * to.monitors[monitor];
  const double change = to.quantities[monitor] - from.quantities[monitor];
  const double square = 3 * (a + b - 2 * change), half = 3 * change - 2 * a - b;  // slope: a + 2 half s + ...
  const double root = half * half - square * a;
  const double sum = half + std::copysign(std::sqrt(std::max(root, 0.0)), half);
  for (const double s : {-a / sum, -sum / square})
    if (root > 0 && s > 0 && s < 1) return s;
  return a / (a - b);
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
  const double tolerance = value.tolerance(options_.event_tolerance);
  const auto at = [&](double s) {
    const double negligible = value.negligible(tolerance), f = value(s);
    return std::abs(f) <= negligible ? 0 : f;
  };
  const bool by_quantity = problem_->smooth() && begin == 0 && monitors_[monitor].quantity;
  const double first = by_quantity ? first_share(monitor, from, to) : at_begin / (at_begin - b);
  const Root root = find_root(at, begin, at_begin, 1, b, tolerance, first);
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
