#include <arcslip/observables/amplitude.hpp>

#include <arcslip/hbm/problem.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arcslip::observables {
namespace {

constexpr double same_height = 1e-13;  // relative: extrema that differ by rounding
}  // namespace

Extreme Amplitude::of(elements::In x) {
  Extreme extreme;
  if (!harmonics_.odd) extreme = {std::abs(x[0]), 0, x[0] < 0 ? -1.0 : 1.0};
  const auto& turns = reversals_.find(x);
  if (turns.empty()) return extreme;
  double highest = 0;
  for (const auto& turn : turns) highest = std::max(highest, std::abs(turn.x));
  std::size_t first = 0;
  while (std::abs(turns[first].x) < (1 - same_height) * highest) ++first;
  const auto& turn = turns[first];
  return {std::abs(turn.x), turn.theta, turn.x < 0 ? -1.0 : 1.0, first};
}

Extreme Amplitude::of(const hbm::HbmEvaluator& at, elements::In u, elements::Out x) {
  const hbm::DynamicStiffness& linear = at.stiffness();
  linear.response(u, at.force_factor(), x);
  Extreme largest = of(x);
  for (int place = 1; place < linear.places(); ++place) {
    other_.resize(x.size());
    linear.response(u, at.force_factor(), other_, place);
    Extreme extreme = of(other_);
    if (!(extreme.amplitude > (1 + same_height) * largest.amplitude)) continue;
    extreme.place = place;
    largest = extreme;
    x = other_;
  }
  return largest;
}

std::vector<Extreme> Amplitude::all(elements::In x) {
  std::vector<Extreme> extremes;
  for (const auto& turn : reversals_.find(x))
    extremes.push_back({std::abs(turn.x), turn.theta, turn.x < 0 ? -1.0 : 1.0, extremes.size()});
  return extremes;
}

Extreme Amplitude::near(elements::In x, double theta) {
  const std::vector<Extreme> extremes = all(x);
  if (extremes.empty()) return of(x);
  const double period = harmonics_.odd ? std::numbers::pi : 2 * std::numbers::pi;  // of |x|
  const auto distance = [&](const Extreme& extreme) {
    return std::abs(std::remainder(extreme.theta - theta, period));
  };
  return *std::min_element(extremes.begin(), extremes.end(),
                           [&](const Extreme& a, const Extreme& b) { return distance(a) < distance(b); });
}

double amplitude_change(const elements::Harmonics& harmonics, const Extreme& extreme, elements::In dx) {
  return extreme.sign * elements::series_values(harmonics, dx, extreme.theta).x;
}

}  // namespace arcslip::observables
