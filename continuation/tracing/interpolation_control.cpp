#include <arcslip/continuation/tracing/interpolation_control.hpp>

#include <arcslip/continuation/correction/mode_crossings.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace arcslip::continuation {
namespace {

constexpr double extremum_safety = 2;          // times the measured bend of a slope
constexpr double unresolved_share = 1.0 / 50;  // of the step first found unresolved: minimum
constexpr double quantity_rounding = 1e-9;     // relative changes of a quantity below this are ignored
constexpr double middle_share = 0.7;  // of the maximum error of the curve: its value in the middle of a step
constexpr double smallest_relevant_curve = 1e-6;  // |u| in scales: below, the curve's error is absolute
constexpr double unknown_curve_error = 1 / 0.3;   // where the problem cannot be evaluated in the middle
// A kink that turns the branch by an angle, anywhere in a step, takes it off the cubic by at least 1/20 of
// the angle times the length of the step at one of these shares of it.
constexpr double shares_across_kinks[] = {0.25, 0.5, 0.75};
constexpr double least_departure = 1.0 / 20;
constexpr double middle_of_cubic[] = {0.5};
constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr double across_many =
    0.4;  // of the error allowed: kinks between these shares may take it 2.5 times as far
constexpr double slope_safety = 10;  // of a slope's sign, at a kink

// Whether a slope with values a and b at the ends of a step, and a deviation bend s (1 - s) from the straight
// line between them, has no more zeros than a and b imply, even with a safety factor on bend of either sign:
// none between slopes of one sign, if bend <= (sqrt|a| + sqrt|b|)^2, and one if it is monotonic,
// bend <= |a| + |b|.
bool is_resolved(double a, double b, double bend) {
  const double sum = std::abs(a) + std::abs(b);
  return a * b > 0 ? pair_safety * bend <= sum + 2 * std::sqrt(a * b) : extremum_safety * bend <= sum;
}

// In scales, to first order. NaN if F cannot be evaluated.
double distance_from_branch(Corrector& at, const Vector& v) {
  const Vector& correction = at.correction_at(v);
  return std::sqrt(at.dot(correction, correction));
}

}  // namespace

bool InterpolationControl::passes_kinks(TrialStep& trial) {
  const CurvePoint &from = s_.here, &to = trial.end;
  if (!looks_for_kinks_ || from.piece == to.piece || from.part != to.part) return false;
  if (by_curve_alone()) return passes_by_curve(trial);
  const double length = distance(main_, from.v, to.v), allowed = allowed_error(from, to);
  const double farthest = departure_across_kinks(from, to, allowed);
  if (!(farthest <= allowed)) return false;
  const double turn = farthest / (least_departure * length);
  if (!(turn < visible_corner) || !keeps_signs(from, to, turn) || !resolves(from, to, trial)) return false;
  trial.curve_error = options_.step.curve_tolerance > 0 ? farthest / allowed : 0;
  return trial.passes_kinks = true;
}

// With StepOptions::pass_kinks. A step that leaves the curve is one that is passed, too: it will be
// shortened, down to a limit.
bool InterpolationControl::passes_by_curve(TrialStep& trial) {
  const CurvePoint &from = s_.here, &to = trial.end;
  const double error = departure_across_kinks(from, to, unlimited) / (across_many * allowed_error(from, to));
  if (!std::isfinite(error)) return false;
  if (error > 1) {
    if (stretch_is_short(unresolved_share)) return false;
    trial.worst_begin = from.arclength;
    trial.worst_end = from.arclength + distance(main_, from.v, to.v);
    begin_stretch(trial.worst_end - trial.worst_begin);
  } else if (!has_no_event(from, to) || !resolves(from, to, trial)) {
    return false;
  }
  trial.curve_error = error;
  return trial.passes_kinks = trial.worst_has_kinks = true;
}

// Whether the curve alone decides: not where a monitor asks for kinks.
bool InterpolationControl::by_curve_alone() const {
  return options_.step.pass_kinks && std::none_of(monitors_.begin(), monitors_.end(), [](const Monitor& m) {
           return m.kind == MonitorKind::kink;
         });
}

// The farthest distance of the branch from the cubic, at some places: in turn until one is above `most`.
double InterpolationControl::departure_across_kinks(const CurvePoint& from, const CurvePoint& to,
                                                    double most) {
  const double length = distance(main_, from.v, to.v);
  double farthest = 0;
  for (const double share : shares_across_kinks) {
    hermite(from.v, from.tangent, to.v, to.tangent, length, share, middle_);
    const double departure = distance_from_branch(main_, middle_);
    if (!(departure <= most)) return departure;
    farthest = std::max(farthest, departure);
  }
  return farthest;
}

// Whether no monitor of a slope has an event between places with these values: an extremum that both ends
// hide is no farther from the cubic than the curve.
bool InterpolationControl::has_no_event(const CurvePoint& from, const CurvePoint& to) const {
  for (std::size_t m = 0; m < monitors_.size(); ++m) {
    if (!monitors_[m].quantity) continue;
    const double a = from.monitors[m], b = to.monitors[m];
    const Crossing wanted = monitors_[m].crossing;
    const bool unwanted = (a < 0 && wanted == Crossing::falling) || (a > 0 && wanted == Crossing::rising);
    if (!(a * b > 0 || unwanted)) return false;
  }
  return true;
}

// Whether no slope of a monitored quantity can pass zero where the tangent turns by this angle.
bool InterpolationControl::keeps_signs(const CurvePoint& from, const CurvePoint& to, double turn) const {
  for (std::size_t m = 0; m < monitors_.size(); ++m) {
    if (monitors_[m].kind == MonitorKind::kink) return false;
    if (!monitors_[m].quantity) continue;
    const double a = from.monitors[m], b = to.monitors[m];
    const double gradient =
        monitors_[m].quantity_is_parameter
            ? main_.parameter_scale()
            : std::abs(to.quantities[m]) / std::max(main_.norm_u(to.v), smallest_relevant_curve);
    const double jump = slope_safety * turn * std::max({gradient, std::abs(a), std::abs(b)});
    if (!(a * b > 0 && std::min(std::abs(a), std::abs(b)) > jump)) return false;
  }
  return true;
}

void InterpolationControl::measure_curve(TrialStep& trial) {
  if (trial.passes_kinks) return;
  trial.curve_error = 0;
  trial.other_piece_between = false;
  if (!(options_.step.curve_tolerance > 0)) return;
  trial.worst_begin = s_.here.arclength;
  trial.worst_end = trial.end.arclength;
  trial.all_sections(s_.here, [&](const CurvePoint& from, const CurvePoint& to) {
    if (from.piece == to.piece || by_curve_alone()) {
      bool passes = false;
      const double error = curve_error(from, trial, to, passes);
      if (error <= trial.curve_error) return true;
      trial.curve_error = error;
      trial.worst_has_kinks = passes;
      trial.worst_begin = from.arclength;
      trial.worst_end = to.arclength;
    } else if (looks_for_kinks_) {
      trial.other_piece_between = true;
    }
    return true;
  });
}

// The error of one cubic: in its middle, where it is largest up to the variation of the fourth derivative.
// Where kinks are passed, at three places, so that a piece that both ends hide is seen from a quarter of the
// step on.
double InterpolationControl::curve_error(const CurvePoint& from, TrialStep& trial, const CurvePoint& to,
                                         bool& passes_kinks) {
  const double length = distance(main_, from.v, to.v);
  if (!(length > 0)) return 0;
  const bool passes = by_curve_alone();
  bool changes = from.piece != to.piece;
  double farthest = 0;
  for (const double share : passes ? std::span<const double>(shares_across_kinks) : middle_of_cubic) {
    hermite(from.v, from.tangent, to.v, to.tangent, length, share, middle_);
    const double departure = distance_from_branch(main_, middle_);
    if (!std::isfinite(departure)) return unknown_curve_error;
    farthest = std::max(farthest, departure);
    std::uint64_t piece = 0;
    changes = changes || (main_.piece(piece) && piece != to.piece);
  }
  passes_kinks = passes && changes;
  trial.other_piece_between = trial.other_piece_between || (changes && !passes);
  return farthest / ((passes_kinks ? across_many : 1) * allowed_error(from, to));
}

// In the middle of the cubic. Infinite without a tolerance.
double InterpolationControl::allowed_error(const CurvePoint& from, const CurvePoint& to) const {
  if (!(options_.step.curve_tolerance > 0)) return std::numeric_limits<double>::infinity();
  const double size = std::max({main_.norm_u(from.v), main_.norm_u(to.v), smallest_relevant_curve});
  return middle_share * options_.step.curve_tolerance * size;
}

bool InterpolationControl::misses_kinks(const TrialStep& trial) {
  if (!trial.other_piece_between || stretch_is_short(unresolved_share)) return false;
  begin_stretch(trial.length);
  return true;
}

bool InterpolationControl::resolves_quantities(TrialStep& trial) {
  trial.chord_error = 0;
  if (stretch_is_short(unresolved_share)) return true;
  const bool all = trial.all_sections(
      s_.here, [&](const CurvePoint& from, const CurvePoint& to) { return resolves(from, to, trial); });
  if (!all) begin_stretch(trial.length);
  return all;
}

// The same for one section. The bend of the slope between its ends follows from the change of the quantity,
// and from the preceding slope.
bool InterpolationControl::resolves(const CurvePoint& from, const CurvePoint& to, TrialStep& trial) const {
  const double length = to.arclength - from.arclength;
  for (std::size_t m = 0; m < monitors_.size(); ++m) {
    if (!monitors_[m].quantity) continue;
    const double a = from.monitors[m], b = to.monitors[m];
    const double change = (to.quantities[m] - from.quantities[m]) / length;
    if (std::isnan(a + b + change)) continue;  // see Branch::warnings
    double bend = 6 * std::abs(change - 0.5 * (a + b));
    if (s_.has_before && &from == &s_.here) {
      const double before = (a - s_.before.monitors[m]) / s_.last_step;
      if (std::isfinite(before))
        bend =
            std::max(bend, length * length / (length + s_.last_step) * std::abs((b - a) / length - before));
    }
    const double size = std::max(std::abs(a), std::abs(b)) * length;
    const double chord_error = monitors_[m].chord_tolerance > 0
                                   ? chord_departure(from, to, m, length) / monitors_[m].chord_tolerance
                                   : 0;
    if (chord_error > trial.chord_error) trial.chord_error = chord_error;
    const double typical = std::max(std::abs(to.quantities[m]),
                                    monitors_[m].quantity_is_parameter ? main_.parameter_scale() : 0.0);
    if ((!is_resolved(a, b, bend) || chord_error > 1) && size > quantity_rounding * typical) {
      trial.unresolved = m;
      return false;
    }
  }
  return true;
}

// Deviation of the curve of a quantity q over p from its chord in a step, relative to q along q or to p along
// p, whichever is less, as on logarithmic axes. The middle of three points at ds/2 is off the chord by a
// parallelogram of the slopes at the ends.
double InterpolationControl::chord_departure(const CurvePoint& from, const CurvePoint& to, std::size_t m,
                                             double length) const {
  const Eigen::Index n = to.v.size() - 1;
  const double area =
      std::abs(from.tangent[n] * to.monitors[m] - to.tangent[n] * from.monitors[m]) * length * length / 8;
  const double p = std::abs(to.v[n]), q = std::abs(to.quantities[m]);
  return area /
         std::max(q * std::abs(to.v[n] - from.v[n]), p * std::abs(to.quantities[m] - from.quantities[m]));
}

bool InterpolationControl::stretch_is_short(double share) const {
  return s_.here.arclength <= s_.unresolved_end && s_.step <= share * s_.unresolved_step;
}

void InterpolationControl::begin_stretch(double length) {
  if (s_.here.arclength <= s_.unresolved_end) return;
  if (s_.here.arclength > s_.unresolved_end + length) s_.unresolved_step = 0;
  s_.unresolved_end = s_.here.arclength + length;
  s_.unresolved_step = std::max(s_.unresolved_step, s_.step);
}

}  // namespace arcslip::continuation
