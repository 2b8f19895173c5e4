#include <arcslip/report/parts.hpp>

#include <arcslip/results/text.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::report {
namespace {

using results::Range;

constexpr double decade = 10;
constexpr double wanted_ticks = 6;

/// 1, 2 or 5 times a power of ten.
double round_step(double width) {
  const double power = std::pow(decade, std::floor(std::log10(width)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= width) return factor * power;
  return decade * power;
}

Range padded(const results::FigureColumn& column, bool fills) {
  constexpr double room = 0.05;
  const auto [lower, upper] = column.range;
  if (column.scale == results::Scale::percent) return {-2, 102};
  if (!(lower <= upper)) return {0, 1};
  if (column.scale == results::Scale::logarithmic) {
    const double spread = std::max(std::pow(upper / lower, fills ? 0 : room), lower < upper ? 1 : decade);
    return {lower / spread, upper * spread};
  }
  const double width = upper - lower;
  if (width <= 1e-12 * std::max(std::abs(lower), std::abs(upper))) {
    const double half = lower == 0 ? 1 : std::abs(lower) / decade;
    return {lower - half, upper + half};
  }
  return fills ? column.range : Range{lower - room * width, upper + room * width};
}

/// "10⁻³"
std::string power_of_ten(int exponent) {
  constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
  return text;
}

}  // namespace

PlainAxis::PlainAxis(const results::FigureColumn& column, bool fills, double from, double to)
    : range_(padded(column, fills)),
      logarithmic_(column.scale == results::Scale::logarithmic && range_.lower > 0),
      from_(from),
      to_(to) {}

bool PlainAxis::shows(double value) const {
  return std::isfinite(value) && !(logarithmic_ && value <= 0);
}

double PlainAxis::place(double value) const {
  const auto [lower, upper] = range_;
  const double share =
      logarithmic_ ? std::log(value / lower) / std::log(upper / lower) : (value - lower) / (upper - lower);
  return from_ + share * (to_ - from_);
}

std::vector<Tick> PlainAxis::ticks() const {
  std::vector<Tick> all;
  const auto [lower, upper] = range_;
  if (logarithmic_) {
    const int first = static_cast<int>(std::floor(std::log10(lower))),
              last = static_cast<int>(std::ceil(std::log10(upper)));
    const int every = 1 + (last - first) / static_cast<int>(decade);
    const bool is_short = upper < decade * decade * decade * lower;
    for (int exponent = first; exponent <= last; ++exponent)
      for (const double factor : {1.0, 2.0, 5.0}) {
        const double value = factor * std::pow(decade, exponent);
        if (value < lower * (1 - 1e-9) || value > upper * (1 + 1e-9) || (factor > 1 && !is_short)) continue;
        const bool has_label = (exponent - first) % every == 0;
        all.push_back({value, !has_label    ? ""
                              : factor == 1 ? power_of_ten(exponent)
                                            : results::to_digits(factor, 1) + "·" + power_of_ten(exponent)});
      }
    return all;
  }
  const double step = round_step((upper - lower) / wanted_ticks);
  for (double k = std::ceil(lower / step - 1e-9); k * step <= upper + 1e-9 * step; ++k)
    all.push_back({k * step, results::to_digits(k == 0 ? 0.0 : k * step, 6)});
  return all;
}

}  // namespace arcslip::report
