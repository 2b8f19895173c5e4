#include <arcslip/time/hysteresis_course.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace arcslip::time {
namespace {

constexpr double tolerance = 1e-14;  // of x over a cell
constexpr double at_bound = 1e-13;   // r
constexpr double shortest = 1e-12;   // cell, in g, at a kink
constexpr double first_length = 0.5;
constexpr std::array<int, 5> substeps{2, 4, 6, 8, 10};
constexpr double error_power = 1.0 / 9;
constexpr double settled = 2e-15;  // of x, over the largest g
constexpr double neutral = 1e-13;  // contraction of the map that is rounding
constexpr int most_iterations = 100;

}  // namespace

HysteresisCourse::Step HysteresisCourse::step(double x, double g) const {
  std::array<double, substeps.size()> row{};
  const double first = rate(x);
  double error = 0;
  for (std::size_t j = 0; j < substeps.size(); ++j) {
    const int n = substeps[j];
    const double h = g / n;
    double before = x, now = x + h * first;
    for (int i = 1; i < n; ++i) {
      const double next = before + 2 * h * rate(now);
      before = now;
      now = next;
    }
    double value = 0.5 * (now + before + h * rate(now));
    for (std::size_t k = 1; k <= j; ++k) {
      const double ratio = static_cast<double>(n) / substeps[j - k];
      const double finer = value + (value - row[k - 1]) / (ratio * ratio - 1);
      row[k - 1] = value;
      error = std::abs(finer - value);
      value = finer;
    }
    row[j] = value;
  }
  return {row.back(), error};
}

// From x over a section, whose cells are appended.
double HysteresisCourse::march(double x, Section& section) {
  section.cell = cells_.size();
  section.r = rate(x);
  section.saturated = HUGE_VAL;
  double g = 0, length = first_length;
  cells_.push_back({g, x});
  while (g < section.length) {
    const double r = rate(x);
    if (!(r >= at_bound)) {
      section.saturated = g;
      return 1;
    }
    length = std::min(length, section.length - g);
    if (x < 0) length = std::min(length, -x / r);  // not beyond 0: r falls on the way
    Step end = step(x, length);
    while (!(end.error <= tolerance) && length > shortest) {
      const double shorter = 0.8 * std::pow(tolerance / end.error, error_power);
      length *= shorter > 0.1 ? std::min(shorter, 0.5) : 0.1;  // overflow: 0.1
      end = step(x, length);
    }
    g += length;
    x = std::min(x < 0 && end.x > -settled ? 0.0 : end.x, 1.0);
    if (section.length - g <= settled * section.length) break;
    cells_.push_back({g, x});
    length *= std::clamp(0.8 * std::pow(tolerance / std::max(end.error, 1e-30), error_power), 1.0, 4.0);
  }
  return x;
}

double HysteresisCourse::around(double x, double& by_x) {
  cells_.clear();
  turns_.clear();
  by_x = 1;
  for (std::size_t k = 0; k < sections_.size(); ++k) {
    Section& section = sections_[k];
    x = march(x, section);
    const double before = section.saturated < HUGE_VAL ? 0 : rate(x);
    const double phi = section.r >= at_bound ? before / section.r : 0;
    const double theta = k + 1 < sections_.size() ? sections_[k + 1].from.theta : sections_[0].from.theta;
    turns_.push_back({within(theta), before, rate(-x), phi});
    by_x *= -phi;
    x = -x;
  }
  return x;
}

// The fixed point, between -1 and 1: around(x) - x falls.
double HysteresisCourse::periodic(double guess, double scale) {
  double low = -1, high = 1, x = guess, last = 2;
  for (int i = 0; i < most_iterations; ++i) {
    double by_x = 0;
    const double excess = around(x, by_x) - x;
    if (std::abs(excess) <= settled * scale || 1 - by_x < neutral) break;
    (excess > 0 ? low : high) = x;
    double next = x + excess / (1 - by_x);
    // Newton's method, as long as it halves the excess.
    if (!(next >= low && next <= high) || !(std::abs(excess) <= 0.5 * last)) next = 0.5 * (low + high);
    last = std::abs(excess);
    if (std::abs(next - x) <= settled * scale) break;
    x = next;
  }
  return x;
}

double HysteresisCourse::within(double theta) const {
  const double span = harmonics_.span(), rest = std::fmod(theta, span);
  return rest < 0 ? rest + span : rest;
}

bool HysteresisCourse::follow(const elements::Hysteresis& law, std::span<const double> fields,
                              const elements::Harmonics& harmonics, elements::In q) {
  sections_.clear();
  turns_.clear();
  breaks_.clear();
  if (!q.allFinite()) return false;
  law_ = &law;
  fields_.assign(fields.begin(), fields.end());
  bound_ = law.bound(fields);
  q_ = q;
  if (!reversals_ || !(harmonics == harmonics_)) reversals_.emplace(harmonics);
  harmonics_ = harmonics;
  const auto& found = reversals_->find(q_);
  if (found.empty()) return true;
  if (found.size() % 2 != (harmonics.odd ? 1 : 0)) return false;
  double low = found.front().x, high = low, longest = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double to =
        k + 1 < found.size() ? found[k + 1].x : (harmonics.odd ? -found.front().x : found.front().x);
    sections_.push_back({found[k], std::abs(to - found[k].x) / bound_, 0, 0});
    if (!(sections_.back().length < HUGE_VAL)) return false;
    longest = std::max(longest, sections_.back().length);
    low = std::min({low, found[k].x, to});
    high = std::max({high, found[k].x, to});
  }
  // As if z were q less its middle: q_0 is a minimum where q grows next.
  const double to = sections_.size() > 1 ? sections_[1].from.x : (harmonics.odd ? -found[0].x : found[0].x);
  const double way = to > found[0].x ? 1 : -1;
  const double guess = std::clamp(way * (found[0].x - 0.5 * (low + high)) / bound_, -1.0, 1.0);
  const double x = periodic(guess, std::min(longest, 1.0));
  double by_x = 0;
  around(x, by_x);
  locate();
  return true;
}

void HysteresisCourse::locate() {
  for (std::size_t k = 0; k < sections_.size(); ++k) {
    const bool last = k + 1 == sections_.size();
    const Section& section = sections_[k];
    const elements::Reversal& first = sections_[0].from;
    const elements::Reversal next =
        last ? elements::Reversal{first.theta + harmonics_.span(), harmonics_.odd ? -first.x : first.x}
             : sections_[k + 1].from;
    const std::size_t end = last ? cells_.size() : sections_[k + 1].cell;
    const double way = next.x > section.from.x ? bound_ : -bound_;
    for (std::size_t i = section.cell + 1; i < end; ++i)
      breaks_.push_back(
          within(reversals_->crossing(q_, section.from, next, section.from.x + way * cells_[i].g)));
  }
}

HysteresisCourse::Values HysteresisCourse::at(double theta) const {
  if (sections_.empty()) return {rate(0), 1};
  const double first = sections_.front().from.theta;
  const double at = first + within(theta - first);
  const auto after = std::upper_bound(sections_.begin(), sections_.end(), at,
                                      [](double angle, const Section& of) { return angle < of.from.theta; });
  const Section& section = after == sections_.begin() ? sections_.front() : *std::prev(after);
  const double q = elements::series_values(harmonics_, q_, at).x;
  const double g = std::min(std::abs(q - section.from.x) / bound_, section.length);
  if (g >= section.saturated) return {0, 0};
  const auto from = cells_.begin() + static_cast<std::ptrdiff_t>(section.cell);
  const auto to =
      after == sections_.end() ? cells_.end() : cells_.begin() + static_cast<std::ptrdiff_t>(after->cell);
  const Cell& cell = *std::prev(
      std::upper_bound(from + 1, to, g, [](double value, const Cell& of) { return value < of.g; }));
  const double r = std::max(rate(step(cell.x, g - cell.g).x), 0.0);
  return {r, section.r >= at_bound ? r / section.r : 0};
}

}  // namespace arcslip::time
