// Step size control, prediction, and the acceptance criteria of a step.

#include <arcslip/continuation/tracer.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double growth = 2.0, shrinkage = 0.3;  // of the step, limits
// A turn of which this share remains in a step shortened by kink_step is a kink.
constexpr double kink_turn = 0.7;
constexpr double parameter_rounding = 1e-9;    // relative changes of p below this give no direction
constexpr double largest_extrapolation = 2.5;  // in last steps, for the cubic predictor
constexpr double unresolved_rejection = 0.5;   // of the step if the slopes do not determine a quantity
constexpr double pair_safety = 8, extreme_safety = 2;  // times the measured bend of a slope
constexpr double unresolved_share = 1.0 / 50;          // of the step first found unresolved: minimum
constexpr double quantity_rounding = 1e-9;  // relative changes of a quantity below this are ignored
constexpr double curve_safety = 0.9;        // of the step allowed by the curve's error
constexpr double middle_share = 0.7;  // of the maximum error of the curve: its value in the middle of a step
constexpr double smallest_relevant_curve = 1e-6;  // |u| in scales: below, the curve's error is absolute

// Factor of the step for a curve error of `error` times the tolerance: the error is of fourth order.
double curve_factor(double error) {
  return std::clamp(curve_safety / std::sqrt(std::sqrt(error)), shrinkage, growth);
}

// Whether a slope with values a and b at the ends of a step, and a deviation bend s (1 - s) from the straight
// line between them, has no more zeros than a and b imply, even with a safety factor on bend of either sign:
// none between slopes of one sign, if bend <= (sqrt|a| + sqrt|b|)^2, and one if it is monotonic,
// bend <= |a| + |b|.
bool is_told(double a, double b, double bend) {
  const double sum = std::abs(a) + std::abs(b);
  return a * b > 0 ? pair_safety * bend <= sum + 2 * std::sqrt(a * b) : extreme_safety * bend <= sum;
}

}  // namespace

double Tracer::largest_parameter_step() const {
  const double relative = options_.step.relative_parameter * std::abs(s_.here.v[n_]);
  const double limit = options_.step.largest_parameter;
  return relative > 0 ? std::min(limit, relative) : limit;  // at p = 0 there is no relative limit
}

double Tracer::limited(double ds) const {
  const double largest_change = options_.step.relative_state * (1 + main_->norm_u(s_.here.v));
  const double change = main_->norm_u(s_.here.tangent);  // |du/ds|
  if (change * ds > largest_change) ds = largest_change / change;
  if (options_.step.largest > 0) ds = std::min(ds, options_.step.largest);
  const double along = std::abs(s_.here.tangent[n_]), limit = largest_parameter_step();
  return along * ds > limit ? limit / along : ds;
}

// By the cubic or the secant of the last two points, or by the tangent after a kink, at the start or far out.
void Tracer::predict(Vector& v) const {
  const Predictor predictor = options_.step.predictor;
  if (predictor != Predictor::tangent && s_.has_before && s_.step <= largest_extrapolation * s_.last_step) {
    const double share = s_.step / s_.last_step;
    if (predictor == Predictor::cubic)
      hermite(s_.before.v, s_.before.tangent, s_.here.v, s_.here.tangent, s_.last_step, 1 + share, v);
    else
      v = s_.here.v + share * (s_.here.v - s_.before.v);
    return;
  }
  v = s_.here.v + s_.step * s_.here.tangent;
}

// Both tangents point the same way in p, but p changed the other way: another branch, or two folds in
// one step.
bool Tracer::went_back(const Place& next) const {
  const double a = s_.here.tangent[n_], b = next.tangent[n_], dp = next.v[n_] - s_.here.v[n_];
  return a * b > 0 && a * dp < 0 && std::abs(dp) > parameter_rounding * std::abs(s_.here.v[n_]);
}

// Deviation of the curve of a quantity q over p from its chord in a step, relative to q along q or to p along
// p, whichever is less, as on logarithmic axes. The middle of three points at ds/2 is off the chord by a
// parallelogram of the slopes at the ends.
double Tracer::chord_departure(const Place& from, const Place& to, std::size_t m, double length) const {
  const double area =
      std::abs(from.tangent[n_] * to.monitors[m] - to.tangent[n_] * from.monitors[m]) * length * length / 8;
  const double p = std::abs(to.v[n_]), q = std::abs(to.quantities[m]);
  return area /
         std::max(q * std::abs(to.v[n_] - from.v[n_]), p * std::abs(to.quantities[m] - from.quantities[m]));
}

// Whether each monitored quantity has no more extrema in the step than implied by its slopes at the ends of
// the sections. Next to a kink a slope may bend however short the step: within one section of the branch the
// step is shortened to a fixed fraction of the first one at most.
bool Tracer::resolved(double length) {
  chord_error_ = 0;
  if (stretch_is_short(unresolved_share)) return true;
  const Place* from = &s_.here;
  bool all = true;
  for (std::size_t k = 0; k <= corners_.size() && all; ++k) {
    const Place& to = k < corners_.size() ? corners_[k].before : next_;
    all = tells(*from, to, to.arclength - from->arclength);
    if (k < corners_.size()) from = &corners_[k].beyond;
  }
  if (!all) begin_stretch(length);
  return all;
}

// The same for one section. The bend of the slope between its ends follows from the change of the quantity,
// and from the preceding slope.
bool Tracer::tells(const Place& from, const Place& to, double length) {
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
    if (chord_error > chord_error_) chord_error_ = chord_error;
    const double typical = std::max(std::abs(to.quantities[m]),
                                    monitors_[m].quantity_is_parameter ? main_->parameter_scale() : 0.0);
    if ((!is_told(a, b, bend) || chord_error > 1) && size > quantity_rounding * typical) {
      unresolved_ = m;
      return false;
    }
  }
  return true;
}

// Whether steps have been shortened enough in an unresolved section of the branch.
bool Tracer::stretch_is_short(double share) const {
  return s_.here.arclength <= s_.unresolved_end && s_.step <= share * s_.unresolved_step;
}

void Tracer::begin_stretch(double length) {
  if (s_.here.arclength <= s_.unresolved_end) return;
  if (s_.here.arclength > s_.unresolved_end + length) s_.unresolved_step = 0;
  s_.unresolved_end = s_.here.arclength + length;
  s_.unresolved_step = std::max(s_.unresolved_step, s_.step);
}

// Whether too large a turn of the tangent is a kink: the piece changes, and the turn does not decrease with
// the step. A turn is first met with a long step and rejected; it counts as the same one until its arclength
// is passed.
bool Tracer::is_kink(double turn, const Place& next) {
  if (next.piece == s_.here.piece) return false;
  const State::Turn now{turn, s_.step, s_.here.arclength + 2 * s_.step};
  if (s_.here.arclength > s_.turn.end) s_.turn = now;
  if (s_.step > kink_step * s_.turn.step) return false;
  if (turn >= kink_turn * s_.turn.angle) return true;
  s_.turn = now;  // it decreased, but may persist from here on
  return false;
}

// The largest error of the cubics along the smooth pieces between here and next_, relative to the tolerance.
// Also whether there are other pieces in between.
double Tracer::curve_error() {
  double largest = 0;
  other_piece_between_ = false;
  if (!(options_.step.curve_tolerance > 0)) return largest;
  const Place* from = &s_.here;
  for (std::size_t k = 0; k <= corners_.size(); ++k) {
    const Place& to = k < corners_.size() ? corners_[k].before : next_;
    if (from->piece == to.piece)
      largest = std::max(largest, curve_error(*from, to));
    else if (events_->looks_for_kinks())
      other_piece_between_ = true;
    if (k < corners_.size()) from = &corners_[k].beyond;
  }
  return largest;
}

// The error of one cubic: in its middle, where it is largest up to the variation of the fourth derivative.
double Tracer::curve_error(const Place& from, const Place& to) {
  const double size = std::max({main_->norm_u(from.v), main_->norm_u(to.v), smallest_relevant_curve});
  const double allowed = middle_share * options_.step.curve_tolerance * size;
  const double length = distance(*main_, from.v, to.v);
  if (!(length > 0)) return 0;
  hermite(from.v, from.tangent, to.v, to.tangent, length, 0.5, v_);
  const double error = main_->distance_from_branch(v_) / allowed;
  std::uint64_t piece = 0;
  if (main_->piece(piece) && piece != to.piece) other_piece_between_ = true;
  return std::isfinite(error) ? error : 1 / shrinkage;
}

// Whether the step contains kinks that were not found, two between ends on one piece or one that is hard to
// locate: then it is shortened, down to a limit, as the cubic may touch another piece where the branch
// does not.
bool Tracer::hides_a_piece(double length) {
  if (!other_piece_between_ || stretch_is_short(unresolved_share)) return false;
  begin_stretch(length);
  return true;
}

// Growth of the curve's error at equal step length, from the last step to this one: growth, as towards a
// resonance, is expected to continue (Gustafsson, ACM Trans. Math. Softw. 20, 1994).
double Tracer::error_growth() const {
  if (!(s_.curve_error > 0) || !corners_.empty()) return 1;
  const double length = (next_.arclength - s_.here.arclength) / s_.last_step;
  return std::max(1.0, curve_error_ / (s_.curve_error * std::pow(length, 4)));
}

double Tracer::choose_step(double angle, const Correction& correction) const {
  double factor = angle > 0 ? options_.step.angle / angle : growth;
  const bool contraction_counts = correction.first > std::sqrt(options_.newton.tolerance);
  if (contraction_counts && correction.contraction > 0)
    factor = std::min(factor, std::sqrt(options_.step.contraction / correction.contraction));
  if (chord_error_ > 0) factor = std::min(factor, curve_safety / std::sqrt(chord_error_));
  if (curve_error_ > 0) factor = std::min(factor, curve_factor(curve_error_ * error_growth()));
  return s_.step * std::clamp(factor, shrinkage, growth);
}

// Factor of the step after a rejection with a converged corrector.
double Tracer::unresolved_factor() const {
  return curve_error_ > 1 ? curve_factor(curve_error_) : unresolved_rejection;
}

// Steps across a kink with an arbitrary turn of the branch.

namespace {

constexpr int most_corners = 3;  // one after the other

}  // namespace

// If the branch turns by any angle at a kink just ahead: moves to the kink, looks beyond it, and steps along
// the tangent there, oriented by the sign of the determinant. If that step fails, the piece beyond the kink
// may be very short, as where two elements start to slip together: then continues to its end.
bool Tracer::corner() {
  crossing_.reset();
  corners_.clear();
  curve_error_ = 0;
  v_ = s_.here.v + s_.step * s_.here.tangent;
  std::uint64_t ahead = 0;
  if (!main_->move_to(v_) || !main_->piece(ahead) || ahead == s_.here.piece) return false;
  const Place* from = &s_.here;
  for (int k = 0; k < most_corners; ++k) {
    auto found = events_->corner(*from, s_.step, from->tangent);
    if (!found) return false;
    corners_.push_back(std::move(*found));
    if (step_beyond_corner()) return true;
    corners_.resize(static_cast<std::size_t>(k) + 1);
    from = &corners_.back().beyond;
  }
  return false;
}

// From the last corner along the tangent beyond it.
bool Tracer::step_beyond_corner() {
  const Place kink = corners_.back().before;
  const Vector beyond = corners_.back().beyond.tangent;
  const double along = std::abs(beyond[n_]), most = largest_parameter_step();
  next_.v = kink.v + (along * s_.step > most ? most / along : s_.step) * beyond;
  main_->border_row(beyond, row_);
  const Correction correction = main_->correct(next_.v, row_, false);
  if (!correction.converged || !settle(*main_, next_)) return false;
  v_ = next_.v - kink.v;
  const double length = std::sqrt(main_->dot(v_, v_));
  if (next_.piece == s_.here.piece || next_.orientation != s_.here.orientation || !(length > 0) ||
      angle_between(main_->dot(next_.tangent, beyond)) > options_.step.largest_angle ||
      angle_between(main_->dot(v_, beyond) / length) > options_.step.largest_angle)
    return false;
  next_.arclength = kink.arclength + length;
  auto more = events_->corners(corners_.back().beyond, next_);
  corners_.insert(corners_.end(), std::move_iterator(more.begin()), std::move_iterator(more.end()));
  const double whole = next_.arclength - s_.here.arclength;
  if (!measure(next_) || curve_error() > 1) return false;
  divide();
  return resolved(whole) && take(whole, s_.step, true, correction) != Attempt::rejected;
}

}  // namespace arcslip::continuation
