#include <arcslip/stability/memory_along.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace arcslip::time {
namespace {

constexpr double settled_memory = 2e-15;       // of x, over the largest g
constexpr double neutral_contraction = 1e-13;  // contraction of the map that is rounding
constexpr int most_periodic_iterations = 100;
constexpr std::size_t most_kept = 4;  // harmonics

}  // namespace

double HysteresisCourse::around(double x, double& by_x) {
  turns_.clear();
  by_x = 1;
  for (std::size_t k = 0; k < sections_.size(); ++k) {
    Section& section = sections_[k];
    section.g = curve_.g(x);
    section.r = curve_.rate(x);
    x = curve_.x(section.end());
    const double before = is_at_bound(section) ? 0 : curve_.rate(x);
    const double phi = section.r >= HysteresisCurve::at_bound ? before / section.r : 0;
    turns_.push_back({within(end_of(k).theta), before, curve_.rate(-x), phi});
    by_x *= -phi;
    x = -x;
  }
  return x;
}

// The fixed point, between -1 and 1: around(x) - x falls.
double HysteresisCourse::periodic(double guess, double scale) {
  double low = -1, high = 1, x = guess, last = 2;
  for (int i = 0; i < most_periodic_iterations; ++i) {
    double by_x = 0;
    const double excess = around(x, by_x) - x;
    if (std::abs(excess) <= settled_memory * scale || 1 - by_x < neutral_contraction) break;
    (excess > 0 ? low : high) = x;
    double next = x + excess / (1 - by_x);
    // Newton's method, as long as it halves the excess.
    if (!(next >= low && next <= high) || !(std::abs(excess) <= 0.5 * last)) next = 0.5 * (low + high);
    last = std::abs(excess);
    if (std::abs(next - x) <= settled_memory * scale) break;
    x = next;
  }
  return x;
}

double HysteresisCourse::within(double theta) const {
  const double span = harmonics_.span(), rest = std::fmod(theta, span);
  return rest < 0 ? rest + span : rest;
}

// A place of a branch and its truncation estimate take turns.
elements::Reversals& HysteresisCourse::reversals_of(const elements::Harmonics& harmonics) {
  const auto kept = std::find_if(reversals_.begin(), reversals_.end(),
                                 [&](const auto& each) { return each.first == harmonics; });
  if (kept != reversals_.end()) return kept->second;
  if (reversals_.size() == most_kept) reversals_.erase(reversals_.begin());
  return reversals_.emplace_back(harmonics, harmonics).second;
}

bool HysteresisCourse::follow(const elements::Harmonics& harmonics, elements::In q) {
  sections_.clear();
  turns_.clear();
  breaks_.clear();
  if (!q.allFinite()) return false;
  q_ = q;
  harmonics_ = harmonics;
  elements::Reversals& reversals = reversals_of(harmonics);
  const auto& found = reversals.find(q_);
  if (found.empty()) return true;
  if (found.size() % 2 != (harmonics.odd ? 1 : 0)) return false;
  for (const elements::Reversal& each : found) sections_.push_back({each, 0});
  double low = found.front().x, high = low, longest = 0;
  for (std::size_t k = 0; k < sections_.size(); ++k) {
    Section& section = sections_[k];
    const double to = end_of(k).x;
    section.length = std::abs(to - section.from.x) / bound_;
    if (!(section.length < HUGE_VAL)) return false;
    longest = std::max(longest, section.length);
    low = std::min({low, section.from.x, to});
    high = std::max({high, section.from.x, to});
  }
  // As if z were q less its middle: q_0 is a minimum where q grows next.
  const double first = sections_[0].from.x, way = end_of(0).x > first ? 1 : -1;
  const double guess = std::clamp(way * (first - 0.5 * (low + high)) / bound_, -1.0, 1.0);
  const double x = periodic(guess, std::min(longest, 1.0));
  double by_x = 0;
  around(x, by_x);
  locate(reversals);
  return true;
}

elements::Reversal HysteresisCourse::end_of(std::size_t section) const {
  if (section + 1 < sections_.size()) return sections_[section + 1].from;
  const elements::Reversal& first = sections_[0].from;
  return {first.theta + harmonics_.span(), harmonics_.odd ? -first.x : first.x};
}

void HysteresisCourse::locate(const elements::Reversals& reversals) {
  for (std::size_t k = 0; k < sections_.size(); ++k) {
    const Section& section = sections_[k];
    const elements::Reversal to = end_of(k);
    const double way = to.x > section.from.x ? bound_ : -bound_;
    for (const double on_curve : {0.0, curve_.end()}) {
      const double g = on_curve - section.g;
      if (g > 0 && g < section.length)
        breaks_.push_back(within(reversals.crossing(q_, section.from, to, section.from.x + way * g)));
    }
  }
}

// Of q, by Horner's rule.
double HysteresisCourse::displacement(double c, double s) const {
  const int sines = harmonics_.sines();
  const double* const a = q_.data() + (harmonics_.odd ? 0 : 1);
  const double* const b = q_.data() + harmonics_.cosines();
  const double step_c = harmonics_.odd ? (c - s) * (c + s) : c, step_s = harmonics_.odd ? 2 * c * s : s;
  double re = 0, im = 0;
  for (int j = sines - 1; j >= 0; --j) {
    const double next = re * step_c - im * step_s + a[j];
    im = re * step_s + im * step_c - b[j];
    re = next;
  }
  return (harmonics_.odd ? 0 : q_[0]) + re * c - im * s;
}

HysteresisCourse::Values HysteresisCourse::at(double theta, double cos_theta, double sin_theta) const {
  if (sections_.empty()) return {curve_.rate(0), 1};
  const double first = sections_.front().from.theta, span = harmonics_.span();
  const double turned = std::floor((theta - first) / span);  // an antisymmetric motion changes its sign
  const double at = theta - turned * span;
  const auto after = std::upper_bound(sections_.begin(), sections_.end(), at,
                                      [](double angle, const Section& of) { return angle < of.from.theta; });
  const Section& section = after == sections_.begin() ? sections_.front() : *std::prev(after);
  const double sign = harmonics_.odd && std::fmod(turned, 2) != 0 ? -1 : 1;
  const double q = sign * displacement(cos_theta, sin_theta);
  const double g = section.g + std::min(std::abs(q - section.from.x) / bound_, section.length);
  const double r = curve_.rate_at(g);
  return {r, section.r >= HysteresisCurve::at_bound ? r / section.r : 0};
}

}  // namespace arcslip::time
