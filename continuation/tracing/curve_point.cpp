#include <arcslip/continuation/tracing/curve_point.hpp>

#include <arcslip/continuation/events/monitor_calls.hpp>

#include <cmath>

namespace arcslip::continuation {
namespace {

constexpr double finest_kink = 1e-12;  // of the search interval, or of |u|: accuracy of the kink
constexpr double least_slope = 0.1;    // of a tangent relative to the first one, to predict along it
constexpr double farther = 8;          // factor after a prediction short of the end of the piece
constexpr double first_margin = 1e-2, least_margin = 1e-12, largest_margin = 0.5;
constexpr double wider = 10;  // margin after passing the end
constexpr int most_kink_corrections = 60;
constexpr int most_bisections = 20;  // where no prediction leaves the piece

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

bool locate_kink(Corrector& with, const CurvePoint& from, double length, CurvePoint& kink, Correction& last,
                 const Inside& is_inside) {
  const Vector row = with.border_row(from.tangent);
  const double finest = finest_kink * std::max(length, with.norm_u(from.v));
  // Along from.tangent: of `kink`, which is in the piece of `from`, and of what is not.
  double lower = 0, upper = length, ahead = length;
  // Share of the distance to the predicted end of the piece that is kept, so that it is not passed. The error
  // of a prediction is quadratic in the distance, and is known from the next prediction.
  double margin = first_margin, predicted = 0, way = 0;
  bool factors_fit = false;
  int bisections = 0;
  kink = from;
  Vector v = from.v;
  const auto predict = [&](double x) {
    const double along = row.dot(kink.tangent);
    if (along > least_slope)
      v = kink.v + (x - lower) / along * kink.tangent;
    else  // the branch turns away: no prediction normal to its tangent
      v = kink.v + (x - lower) * from.tangent;
  };
  const auto inside_at = [&] {
    std::uint64_t piece = 0;
    return with.piece(piece) && piece == from.piece && (!is_inside || is_inside(v));
  };
  const auto predicted_inside = [&](double x) {
    predict(x);
    return with.move_to(v) && inside_at();
  };
  for (int k = 0; k < most_kink_corrections && upper - lower > finest; ++k) {
    double inside = lower, outside = std::min(upper, lower + ahead);
    while (predicted_inside(outside)) {
      inside = outside;
      if (outside == upper) break;
      outside = std::min(upper, lower + farther * (outside - lower));
    }
    const double fine = 0.5 * std::min(margin, largest_margin);
    while (outside - inside > std::max(finest / 4, fine * (outside - lower))) {
      const double middle = 0.5 * (inside + outside);
      (predicted_inside(middle) ? inside : outside) = middle;
    }
    if (inside == lower || outside - lower <= finest) return true;  // the piece ends here
    if (way > 0)
      margin = std::min(first_margin, 2 * std::abs(outside - predicted) / (way * way) * (outside - lower));
    const bool stays = inside == upper, bisected = stays || margin > largest_margin;
    if (stays && ++bisections > most_bisections) return false;
    const bool at_end = stays && bisections == 1 && upper == length;  // whether the piece ends at all
    const double aim = at_end ? upper : bisected ? 0.5 * (lower + upper) : inside - margin * (inside - lower);
    predict(aim);
    const Correction at = with.correct(v, row, factors_fit);
    factors_fit = at.converged && inside_at();
    if (!factors_fit) {
      upper = aim;
      ahead = upper - lower;
      margin = wider * std::max(margin, least_margin);
      way = 0;
      continue;
    }
    if (at_end) return false;
    way = bisected ? 0 : aim - lower;
    if (bisected) margin = largest_margin;
    predicted = outside;
    ahead = bisected ? upper - aim : 2 * (outside - aim);
    lower = aim;
    kink.v = v;
    kink.arclength = from.arclength + lower;
    last = at;
    if (!settle(with, kink)) return false;
  }
  return upper - lower <= finest;
}

Accepted accepted(Corrector& at, const CurvePoint& place) {
  const Eigen::Index n = place.v.size() - 1;
  return {place.v.head(n), at.parameters(), place.tangent, place.arclength,
          at.evaluator(),  at.factors(),    place.v[n],    at.scratch()};
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
