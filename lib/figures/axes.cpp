#include <arcslip/figures/layout.hpp>
#include <arcslip/figures/parts.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace arcslip::figures {
namespace {

using results::FigureAxis;
using results::FigureTick;
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

/// "10⁻³"
std::string power_of_ten(int exponent) {
  constexpr std::array<const char*, 10> digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[static_cast<std::size_t>(c - '0')];
  return text;
}

std::vector<FigureTick> linear_ticks(const Range& range, double step) {
  std::vector<FigureTick> all;
  for (double k = std::ceil(range.lower / step - 1e-9); k * step <= range.upper + 1e-9 * step; ++k)
    all.push_back({k * step, results::to_digits(k == 0 ? 0.0 : k * step, 6)});
  return all;
}

/// Decades with lines between them, or 1, 2, 5 where there are few of them, or more where there is not one.
std::vector<FigureTick> logarithmic_ticks(const Range& range) {
  const auto [lower, upper] = range;
  const double decades = std::log10(upper / lower);
  const int first = static_cast<int>(std::floor(std::log10(lower))),
            last = static_cast<int>(std::ceil(std::log10(upper)));
  const int every = 1 + static_cast<int>(decades / decade);
  const bool is_plain = lower > 0.9e-3 && upper < 1.1e5;
  std::vector<FigureTick> all;
  const auto has_label = [&](double digit, int exponent) {
    if (decades > 2.5) return digit == 1 && (exponent - first) % every == 0;
    if (decades > 0.7) return digit == 1 || digit == 2 || digit == 5;
    return true;
  };
  for (int exponent = first; exponent <= last; ++exponent)
    for (const double digit : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0}) {
      const double value = digit * std::pow(decade, exponent);
      const bool is_half = digit == 1.5 || digit == 2.5;
      if (value < lower * (1 - 1e-9) || value > upper * (1 + 1e-9)) continue;
      if ((is_half && decades > 0.7) || (digit > 1 && decades > 12)) continue;
      std::string label;
      if (has_label(digit, exponent))
        label = is_plain    ? results::to_digits(value, 6)
                : digit > 1 ? results::to_digits(digit, 2) + "·" + power_of_ten(exponent)
                            : power_of_ten(exponent);
      all.push_back({value, std::move(label)});
    }
  return all;
}

/// The range of an axis with room around values that are not equal but for rounding.
Range with_room(const Range& of, bool logarithmic, bool fills, bool has_minima) {
  constexpr double room = 0.05;
  const auto [lower, upper] = of;
  const double parts_below = has_minima ? 2 : 1;
  if (logarithmic) {
    if (fills && lower < upper) return of;
    const double spread = std::pow(upper / lower, room);
    return {lower / std::max(std::pow(spread, parts_below), 1.05), upper * std::max(spread * spread, 1.15)};
  }
  if (upper - lower <= 1e-8 * std::max(std::abs(lower), std::abs(upper))) {
    const double width = lower == 0 ? 1 : std::max(std::abs(lower), 1e-300) / decade;
    return {lower - width, upper + width};
  }
  const double width = fills ? 0 : room * (upper - lower);
  return {lower - parts_below * width, upper + 2 * width};
}

}  // namespace

results::PrefixedUnit unit_of(const results::FigureColumn& column) {
  const auto [lower, upper] = column.range;
  if (!(lower <= upper)) return results::prefixed(column.unit, 0);
  if (column.scale == results::Scale::logarithmic && lower > 0)
    return results::prefixed(column.unit, std::sqrt(lower) * std::sqrt(upper));  // the middle of the axis
  return results::prefixed(column.unit, std::max(std::abs(lower), std::abs(upper)));
}

FigureAxis axis_of(const results::FigureColumn& column, std::string_view words, bool fills, bool has_minima) {
  const results::PrefixedUnit in = unit_of(column);
  FigureAxis axis{.label = results::with_unit(words, in.unit), .factor = in.factor};
  if (column.scale == results::Scale::percent) {
    axis.range = {-3, 103};
    axis.ticks = linear_ticks(axis.range, 20);
    return axis;
  }
  const bool is_empty = !(column.range.lower <= column.range.upper);
  axis.logarithmic = column.scale == results::Scale::logarithmic && !is_empty;
  axis.range = is_empty ? Range{-1, 1} : with_room(column.range, axis.logarithmic, fills, has_minima);
  axis.range = {axis.range.lower * axis.factor, axis.range.upper * axis.factor};
  axis.ticks =
      axis.logarithmic
          ? logarithmic_ticks(axis.range)
          : linear_ticks(axis.range, round_step((axis.range.upper - axis.range.lower) / wanted_ticks));
  return axis;
}

FigureAxis angle_axis(std::string_view words) {
  constexpr Range turn{0, 360};
  return {.label = results::with_unit(words, "degrees"), .range = turn, .ticks = linear_ticks(turn, 90)};
}

std::string line_colour(std::size_t line, std::size_t lines, bool is_grey) {
  using Colours = std::array<std::array<int, 3>, 7>;
  constexpr Colours plasma{{{13, 8, 135},
                            {84, 2, 163},
                            {139, 10, 165},
                            {185, 50, 137},
                            {219, 92, 104},
                            {228, 112, 72},
                            {226, 138, 24}}};
  constexpr Colours grey{{{0, 0, 0},
                          {30, 30, 30},
                          {60, 60, 60},
                          {90, 90, 90},
                          {115, 115, 115},
                          {140, 140, 140},
                          {165, 165, 165}}};
  const Colours& anchors = is_grey ? grey : plasma;
  const double place = lines > 1 ? static_cast<double>(line) / static_cast<double>(lines - 1) *
                                       static_cast<double>(anchors.size() - 1)
                                 : 0.0;
  const auto lower = std::min(static_cast<std::size_t>(place), anchors.size() - 2);
  const double share = place - static_cast<double>(lower);
  std::string text = "#";
  for (std::size_t i = 0; i < 3; ++i) {
    const long level = std::lround((1 - share) * anchors[lower][i] + share * anchors[lower + 1][i]);
    constexpr std::string_view digits = "0123456789abcdef";
    text += digits[static_cast<std::size_t>(level / 16)];
    text += digits[static_cast<std::size_t>(level % 16)];
  }
  return text;
}

}  // namespace arcslip::figures
