// What the harmonics left out do to the events of a curve of special points (docs/theory/07-observables.md).
//
// Each point of the curve has the change of its frequency and amplitude at its value of the parameter p,
// d omega and dA (observables/truncation.hpp). Along the curve, with its arclength s and y' = dy/ds:
//
//   an extremum of y = A or omega   y + dy has one at ds = -(dy)'/y'': dp = p' ds, d omega + omega' ds,
//                                   dA + A' ds
//   a turn in p                     dp = -d omega p'/omega' and dA - A' d omega/omega' at the same frequency,
//                                   which are regular; d omega = -omega' (dp)'/p''
//   a cusp of a curve of folds      omega = q + e (p - p_c) on the curve, q = c s^3, p - p_c = a s^2:
//                                   dp = -2 a (d omega)'/(3 c), d omega + e dp; dA has a pole,
//                                   r/s + dA_0; with A = b_1 s + b_2 s^2, p - p_c = a s^2 + a_3 s^3:
//                                   dA_0 + (b_2 - 3/4 b_1 a_3/a) dp/a
//
// Derivatives are those of polynomials through the event and two points on each side.

#include <arcslip/analyses/curves/special_curve_results.hpp>

#include <arcslip/observables/truncation.hpp>
#include <arcslip/results/event_kinds.hpp>

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace arcslip::observables {
namespace {

constexpr std::size_t on_each_side = 2;
constexpr double located = 0.1;   // slope of a parameter where it turns, over that at its neighbours
constexpr double varying = 0.01;  // of d omega next to a cusp: what of it is of second order may vary as much

struct Neighbour {
  double s = 0;  // arclength from the event
  const ResponsePoint* point = nullptr;
};

// Two points on each side of an event, or fewer up to the next corner of the curve; none next to one, and
// where the curve follows a corner of the responses on one side only. to_corner: the distance to that corner.
std::vector<Neighbour> neighbours_of(const SpecialCurve& curve, double arclength, double& to_corner) {
  double from = -HUGE_VAL, to = HUGE_VAL;
  for (const auto& each : curve.events) {
    if (each.event.kind != event_kinds::corner) continue;
    if (each.arclength <= arclength) from = std::max(from, each.arclength);
    if (each.arclength >= arclength) to = std::min(to, each.arclength);
  }
  to_corner = std::min(arclength - from, to - arclength);
  std::vector<const SpecialCurve::At*> before, after;
  for (const auto& at : curve.points)
    if (at.arclength >= from && at.arclength <= to && at.arclength != arclength &&
        std::isfinite(at.point.location_change))
      (at.arclength < arclength ? before : after).push_back(&at);
  if (before.empty() || after.empty() ||
      before.back()->corner.has_value() != after.front()->corner.has_value())
    return {};
  if (before.size() > on_each_side) before.erase(before.begin(), before.end() - on_each_side);
  if (after.size() > on_each_side) after.resize(on_each_side);
  std::vector<Neighbour> all;
  for (const auto* side : {&before, &after})
    for (const auto* at : *side) all.push_back({at->arclength - arclength, &at->point});
  return all;
}

using NeighbourQuantity = std::function<double(const Neighbour&)>;

using Coefficients = std::array<double, 3>;

// Of y = c_0 s^n + c_1 s^(n+1) + ... with so many terms, by least squares; NaN without as many neighbours.
// first: in place of s^n.
Coefficients fitted(const std::vector<Neighbour>& nearby, int n, int terms, const NeighbourQuantity& y_of,
                    const NeighbourQuantity& first = {}) {
  const auto rows = static_cast<Eigen::Index>(nearby.size());
  if (rows < terms) return {no_value, no_value, no_value};
  double size = 0;  // of s
  for (const Neighbour& at : nearby) size = std::max(size, std::abs(at.s));
  Eigen::MatrixXd powers(rows, terms);
  Eigen::VectorXd y(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Neighbour& at = nearby[static_cast<std::size_t>(i)];
    for (int k = 0; k < terms; ++k) powers(i, k) = std::pow(at.s / size, n + k);
    if (first) powers(i, 0) = first(at);
    y[i] = y_of(at);
  }
  const double unit = first ? powers.col(0).cwiseAbs().maxCoeff() : std::pow(size, n);
  if (first) powers.col(0) /= unit;
  const Eigen::VectorXd c = powers.colPivHouseholderQr().solve(y);
  Coefficients all{c[0] / unit};
  for (int k = 1; k < terms; ++k) all[static_cast<std::size_t>(k)] = c[k] / std::pow(size, n + k);
  return all;
}

// Of an event with its signs, NaN where not known, and the sizes of their parts.
struct Changes {
  double parameter = no_value, frequency = no_value, amplitude = no_value;
  double of_parameter = 0, of_frequency = 0, of_amplitude = 0;
  double along = 0;       // the curve, ds
  bool doubtful = false;  // the estimate may be far too low
};

class Event {
 public:
  Event(std::vector<Neighbour> nearby, const Solution& at) : nearby_(std::move(nearby)), at_(at) {}

  Changes extremum(double Solution::* y, double Solution::* dy) const {
    const double along = -course(dy, 1)[0] / (2 * course(y, 2)[0]);
    const double moved = course(&Solution::omega, 1)[0] * along,
                 grown = course(&Solution::amplitude, 1)[0] * along;
    return {.parameter = course(&Solution::over, 1)[0] * along,
            .frequency = at_.location_change + moved,
            .amplitude = at_.truncation_change + grown,
            .of_frequency = std::abs(at_.location_change) + std::abs(moved),
            .of_amplitude = std::abs(at_.truncation_change) + std::abs(grown),
            .along = along};
  }

  Changes turn() const {
    if (!turns()) return {};
    const auto p = course(&Solution::over, 2), w = course(&Solution::omega, 1),
               A = course(&Solution::amplitude, 2);
    // Of y = y_0 + c_0 s^2 + c_1 s^3 at a given frequency, by the change of that at a given p.
    const auto by_frequency = [&](const Coefficients& y, const Neighbour& at) {
      return -at.point->location_change * (2 * y[0] * at.s + 3 * y[1] * at.s * at.s) /
             (w[0] + 2 * w[1] * at.s);
    };
    const auto of_parameter = fitted(nearby_, 0, 2, [&](const Neighbour& at) { return by_frequency(p, at); });
    const auto of_amplitude = fitted(nearby_, 0, 2, [&](const Neighbour& at) {
      return at.point->truncation_change + by_frequency(A, at);
    });
    const bool has_pole = std::all_of(nearby_.begin(), nearby_.end(), [&](const Neighbour& at) {
      return std::abs(by_frequency(p, at) - of_parameter[0]) <= std::abs(of_parameter[0]);
    });
    if (!has_pole) return {};
    const double along = -of_parameter[1] / (2 * p[0]);
    return {.parameter = of_parameter[0],
            .frequency = w[0] * along,
            .amplitude = of_amplitude[0],
            .along = along};
  }

  Changes cusp() const {
    if (!turns()) return {};
    const auto p = course(&Solution::over, 2, 3), A = course(&Solution::amplitude, 1, 3);
    const auto [e, cubic, rest] = fitted(
        nearby_, 2, 3, [&](const Neighbour& at) { return at.point->omega - at_.omega; },
        [&](const Neighbour& at) { return at.point->over - at_.over; });
    const auto d = fitted(nearby_, 0, 3, [](const Neighbour& at) { return at.point->location_change; });
    const double parameter = -2 * p[0] * d[1] / (3 * cubic);
    // At its value of p the fold moves as 1/s, and with it dA.
    const auto pole =
        fitted(nearby_, 0, 3, [](const Neighbour& at) { return at.point->truncation_change * at.s; });
    const double moved = e * parameter, grown = (A[1] - 0.75 * A[0] * p[1] / p[0]) * parameter / p[0];
    return {.parameter = parameter,
            .frequency = d[0] + moved,
            .amplitude = pole[1] + grown,
            .of_parameter = std::abs(parameter) * (1 + std::abs(d[2] * reach() / d[1])),
            .of_frequency = std::abs(d[0]) + std::abs(moved),
            .of_amplitude = std::abs(pole[1]) + std::abs(grown),
            .doubtful = std::abs(d[1]) * reach() < varying * std::abs(d[0])};
  }

 private:
  // Whether p = p_0 + c s^2 next to the event, which is not so within the accuracy of its location.
  bool turns() const {
    const auto p = course(&Solution::over, 1, 3);
    return !nearby_.empty() && std::abs(p[0]) <= located * std::abs(p[1]) * reach();
  }

  double reach() const { return std::max(-nearby_.front().s, nearby_.back().s); }

  // Of y from the event on, from the power n.
  Coefficients course(double Solution::* y, int n, int terms = 2) const {
    return fitted(nearby_, n, terms, [&](const Neighbour& at) { return at.point->*y - at_.*y; });
  }

  std::vector<Neighbour> nearby_;
  const Solution& at_;
};

double size(double change, double of_parts) {
  return std::max(std::abs(change), uncancelled * of_parts);
}

// At a value of the parameter that has a cusp, more harmonics have no fold next to it, or two.
void forget_estimates(ResponsePoint& at) {
  at.truncation_estimate = at.truncation_change = no_value;
  at.truncation_flagged = true;
  for (auto* list : {&at.elements, &at.patches})
    for (ElementResponse& part : *list) part.stick_estimate = no_value;
}

}  // namespace

void estimate_change(const SpecialCurve& curve, double arclength, ResponseEvent& event) {
  ResponsePoint& at = event.point;
  const bool is_cusp = event.kind == event_kinds::cusp;
  std::vector<Neighbour> nearby;
  double to_corner = 0;
  if (!event.nonsmooth && event.located) nearby = neighbours_of(curve, arclength, to_corner);
  const Event it(nearby, at);
  Changes changes;
  if (event.kind == event_kinds::minimum || event.kind == event_kinds::maximum)
    changes = it.extremum(&Solution::amplitude, &Solution::truncation_change);
  else if (event.kind == event_kinds::turn)
    changes = it.extremum(&Solution::omega, &Solution::location_change);
  else if (event.kind == event_kinds::fold)
    changes = it.turn();
  else if (is_cusp)
    changes = it.cusp();
  at.location_estimate = at.location_change = no_value;  // was: at its value of the parameter
  if (is_cusp) forget_estimates(at);
  if (!std::isfinite(changes.parameter) || std::abs(changes.along) >= to_corner) return;
  at.parameter_estimate = size(changes.parameter, changes.of_parameter);
  at.location_estimate = size(changes.frequency, changes.of_frequency);
  at.location_change = changes.frequency;
  if (std::isfinite(changes.amplitude)) {
    at.truncation_estimate = std::fmax(at.truncation_estimate, size(changes.amplitude, changes.of_amplitude));
    at.truncation_change = changes.amplitude;
    if (is_cusp)
      at.truncation_flagged =
          changes.doubtful || std::any_of(nearby.begin(), nearby.end(), [](const Neighbour& each) {
            return each.point->truncation_flagged;
          });
  }
  const auto move = [&](auto list) {  // the shares of stick change along the curve
    for (std::size_t e = 0; e < (at.*list).size(); ++e) {
      const double from = (nearby.front().point->*list)[e].stick_percent,
                   to = (nearby.back().point->*list)[e].stick_percent;
      (at.*list)[e].stick_estimate +=
          std::abs((to - from) / (nearby.back().s - nearby.front().s) * changes.along);
    }
  };
  move(&ResponsePoint::elements);
  move(&ResponsePoint::patches);
}

}  // namespace arcslip::observables
