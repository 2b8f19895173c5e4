#include <arcslip/continuation/correction/curve_point.hpp>

#include <arcslip/continuation/events/monitor_calls.hpp>

#include <cmath>

namespace arcslip::continuation {
namespace {

constexpr double finest_kink = 1e-12;  // of the search interval, or of |u|: accuracy of the kink
constexpr double least_slope = 0.1;    // of a tangent relative to the first one, to predict along it
constexpr double farther = 8;          // factor after a prediction short of the end of the piece
constexpr double farthest_cubic = 8;   // of the interval of its two points
constexpr double first_margin = 1e-2;
constexpr double chord_share = 1e-3;      // accuracy of the end of the piece on a chord
constexpr double retry_share = 1.0 / 64;  // of the distance from which a correction failed, to try it anew
constexpr int most_kink_corrections = 60;
constexpr int most_blind_aims = 40;  // where no prediction leaves the piece

}  // namespace

void CurvePoint::reverse() {
  tangent = -tangent;
  orientation = -orientation;
}

bool settle(Corrector& at, CurvePoint& place) {
  if (!at.tangent(place.tangent)) return false;
  place.orientation = at.factors().determinant_sign().value_or(0);
  return at.piece(place.piece);
}

namespace {

// The branch beyond its last known point in steps x along a direction d: dv/dx = t / <t, d> with its tangent
// t. With two points it is the cubic through both, with one the tangent.
class Prediction {
 public:
  Prediction(const Vector& direction, const Vector& row)
      : direction_(direction), row_(row), second_(direction.size()), third_(direction.size()) {}

  void begin_at(double x, const CurvePoint& place) {
    h_ = 0;
    x_ = x;
    v_ = place.v;
    const double along = row_.dot(place.tangent);
    goes_on_ = along > least_slope;  // else the branch turns away
    slope_ = goes_on_ ? Vector(place.tangent / along) : direction_;
  }
  void go_on_to(double x, const CurvePoint& place) {
    const double h = x - x_;
    const bool went_on = goes_on_;
    second_ = v_;
    third_ = slope_;
    begin_at(x, place);
    if (!went_on || !goes_on_ || !(h > 0)) return;
    h_ = h;
    const Vector mean = (v_ - second_) / h;
    third_ = (third_ + slope_ - 2 * mean) / (h * h);
    second_ = (slope_ - mean) / h;
  }
  void use_tangent() { h_ = 0; }

  bool is_cubic() const { return h_ > 0; }
  double interval() const { return h_; }
  void at(double x, Vector& v) const {
    const double d = x - x_;
    v = v_ + d * slope_;
    if (is_cubic()) v += d * d * (second_ + (d + h_) * third_);
  }
  /// At a distance, up to a factor.
  double error(double d) const { return is_cubic() ? d * d * (d + h_) * (d + h_) : d * d; }

 private:
  const Vector &direction_, &row_;
  double x_ = 0, h_ = 0;
  bool goes_on_ = false;
  Vector v_, slope_, second_, third_;
};

}  // namespace

bool locate_kink(Corrector& with, const CurvePoint& from, double length, CurvePoint& kink, Correction& last,
                 const Inside& is_inside) {
  const Vector row = with.border_row(from.tangent);
  const double finest = finest_kink * std::max(length, with.norm_u(from.v));
  // Along from.tangent: of `kink`, which is in the piece of `from`, and of what is not.
  double lower = 0, upper = length, ahead = length;
  // Share of the distance to the predicted end of the piece that is kept, so that it is not passed. The error
  // of a prediction is known from the next one.
  double margin = first_margin, predicted = 0, error = 0;
  bool error_of_cubic = false;
  Vector beyond;  // the branch at `upper`, or nothing
  // Where a correction fails, the branch may be in the piece for all that: `upper` is then tried anew from
  // nearby, before it is taken for its end. Back to what was found outside, if it is inside.
  double failed_from = 0;  // distance
  double outside_at = length;
  Vector branch_outside;
  bool factors_fit = false;
  int blind_aims = 0;
  bool end_tested = false;  // whether the branch is in the piece at `length`
  kink = from;
  Vector v = from.v;
  Prediction prediction(from.tangent, row);
  prediction.begin_at(0, from);
  const auto inside_at = [&] {
    std::uint64_t piece = 0;
    return with.piece(piece) && piece == from.piece && (!is_inside || is_inside(v));
  };
  const auto v_inside = [&](PieceTest test) {
    return is_inside ? with.move_to(v) && inside_at() : with.is_in_piece(v, from.piece, test);
  };
  const auto predicted_inside = [&](double x, PieceTest test) {
    prediction.at(x, v);
    return v_inside(test);
  };
  const auto inside_on_chord = [&](double x, PieceTest test) {
    v = kink.v + (x - lower) / (upper - lower) * (beyond - kink.v);
    return v_inside(test);
  };
  // The end of the piece on a path v(x), between a place inside and one outside, to a share of its distance.
  const auto bisect = [&](double& inside, double& outside, double share, const auto& is_in) {
    for (double tested = inside;;) {  // by all of F; what left the piece last is asked first
      while (outside - inside > std::max(finest / 4, share * (outside - lower))) {
        const double middle = 0.5 * (inside + outside);
        (is_in(middle, PieceTest::part) ? inside : outside) = middle;
      }
      if (inside == tested || is_in(inside, PieceTest::whole)) return;
      outside = inside;
      inside = tested;
    }
  };
  // Where the predicted branch stays in the piece but the branch does not: on the chord to its point beyond,
  // and in the middle in turns.
  const auto blind_aim = [&] {
    if (beyond.size() == 0 || blind_aims % 2 == 0) return 0.5 * (lower + upper);
    double inside = lower, outside = upper;
    bisect(inside, outside, chord_share, inside_on_chord);
    return inside > lower ? inside : 0.5 * (lower + outside);
  };
  for (int k = 0; k < most_kink_corrections && upper - lower > finest; ++k) {
    double inside = lower, outside = std::min(upper, lower + ahead);
    if (outside - lower > farthest_cubic * prediction.interval()) prediction.use_tangent();
    while (predicted_inside(outside, PieceTest::whole)) {
      inside = outside;
      if (outside == upper) break;
      outside = std::min(upper, lower + farther * (outside - lower));
      if (outside - lower > farthest_cubic * prediction.interval()) prediction.use_tangent();
    }
    const double distance = outside - lower;
    margin = first_margin;
    if (error > 0 && (prediction.is_cubic() || !error_of_cubic)) {
      const double next = error_of_cubic ? prediction.error(distance) : distance * distance;
      margin = std::min(first_margin, 2 * std::abs(outside - predicted) * (next / error) / distance);
    }
    bisect(inside, outside, 0.5 * margin, predicted_inside);
    if (inside == lower || outside - lower <= finest) return true;  // the piece ends here
    const bool stays = inside == upper;
    if (stays && ++blind_aims > most_blind_aims) return false;
    const bool at_end = stays && !end_tested && upper == length;  // whether the piece ends at all
    end_tested = end_tested || at_end;
    const bool anew = stays && failed_from > 0 && upper - lower < retry_share * failed_from;
    const double aim = at_end || anew ? upper : stays ? blind_aim() : inside - margin * (inside - lower);
    prediction.at(aim, v);
    const Correction at = with.correct(v, row, factors_fit);
    factors_fit = at.converged && inside_at();
    if (!factors_fit) {
      upper = aim;
      ahead = upper - lower;
      beyond = at.converged ? v : Vector();
      failed_from = at.converged ? 0 : ahead;
      if (at.converged) outside_at = upper, branch_outside = v;
      error = 0;
      continue;
    }
    if (aim == length) return false;  // it does not
    if (anew) {
      upper = outside_at;
      beyond = branch_outside;
      failed_from = 0;
      blind_aims = 0;
      end_tested = upper < length;
    }
    error = stays ? 0 : prediction.error(aim - lower);
    error_of_cubic = prediction.is_cubic();
    predicted = outside;
    ahead = stays ? upper - aim : 2 * (outside - aim);
    lower = aim;
    kink.v = v;
    kink.arclength = from.arclength + lower;
    last = at;
    if (!settle(with, kink)) return false;
    prediction.go_on_to(lower, kink);
  }
  return upper - lower <= finest;
}

Accepted accepted(Corrector& at, const CurvePoint& place) {
  const Eigen::Index n = place.v.size() - 1;
  return {place.v.head(n), at.parameters(), place.tangent, place.arclength, at.evaluator(),
          at.factors(),    place.v[n],      at.scratch(),  at.free()};
}

void evaluate(const std::vector<Monitor>& monitors, Corrector& at, CurvePoint& place) {
  const Accepted now = accepted(at, place);
  place.monitors.resize(monitors.size());
  place.quantities.resize(monitors.size());
  place.part = 0;
  for (std::size_t m = 0; m < monitors.size(); ++m) {
    place.monitors[m] = value_of(monitors[m], now);
    place.quantities[m] = quantity_of(monitors[m], now);
    place.part = with_part(place.part, monitors[m], now);
  }
}

Point point(const CurvePoint& place, const Correction& correction) {
  const Eigen::Index n = place.v.size() - 1;
  return {place.v.head(n),       place.v[n],     place.tangent, place.arclength,
          correction.iterations, correction.last};
}

double distance(const Corrector& in, const Vector& a, const Vector& b) {
  const Vector d = b - a;
  return std::sqrt(in.dot(d, d));
}

}  // namespace arcslip::continuation
