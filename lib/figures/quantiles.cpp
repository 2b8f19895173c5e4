#include <arcslip/figures/parts.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace arcslip::figures {
namespace {

using results::FigureData;
using results::FigureLine;
using results::FigureView;
using results::Record;

constexpr std::size_t places = 400;  // along x

/// The highest value of a line at each place along x; NaN beyond its points.
std::vector<double> heights(const FigureLine& line, const FigureView& view, const std::vector<double>& at) {
  std::vector<double> highest(at.size(), std::numeric_limits<double>::quiet_NaN());
  for (const auto& part : line.parts)
    for (std::size_t i = 1; i < part.size(); ++i) {
      const double x0 = part[i - 1][view.x], x1 = part[i][view.x], y0 = part[i - 1][view.y],
                   y1 = part[i][view.y];
      if (!(std::abs(x1 - x0) > 0) || !std::isfinite(y0) || !std::isfinite(y1)) continue;
      const auto [lower, upper] = std::minmax(x0, x1);
      auto first = std::lower_bound(at.begin(), at.end(), lower);
      for (; first != at.end() && *first <= upper; ++first) {
        const double share = (*first - x0) / (x1 - x0);
        double& height = highest[static_cast<std::size_t>(first - at.begin())];
        height = std::fmax(height, (1 - share) * y0 + share * y1);
      }
    }
  return highest;
}

/// Of sorted values, by linear interpolation.
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double part = place - static_cast<double>(below);
  return (1 - part) * sorted[below] + part * sorted[above];
}

}  // namespace

void add_quantiles(const FigureData& data, const FigureView& view, const results::FigureStyle& style,
                   results::Figure& figure) {
  struct Band {
    const char* name;
    double share, opacity;
  };
  constexpr Band bands[] = {{"nine tenths of the curves", 0.05, 0.2}, {"a half of them", 0.25, 0.4}};
  const std::string count = std::to_string(data.lines.size());
  const std::string colour = line_colour(0, 1, style.is_grey);
  const auto [lower, upper] = data.columns[view.x].range;
  std::vector<double> at;
  for (std::size_t i = 0; i < places; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(places - 1);
    at.push_back(figure.x.logarithmic ? lower * std::pow(upper / lower, share)
                                      : lower + share * (upper - lower));
  }
  std::vector<std::vector<double>> columns(places);
  for (const FigureLine& line : data.lines) {
    const std::vector<double> own = heights(line, view, at);
    for (std::size_t i = 0; i < places; ++i)
      if (figure.y.shows(own[i])) columns[i].push_back(own[i]);
  }
  results::FigureCurve median{.name = "median of " + count + " curves", .colour = colour};
  std::vector<std::vector<Record>> strips(std::size(bands));
  for (std::size_t i = 0; i < places; ++i) {
    if (columns[i].empty()) continue;
    std::sort(columns[i].begin(), columns[i].end());
    median.x.push_back(at[i]);
    median.y.push_back(quantile(columns[i], 0.5));
    for (std::size_t k = 0; k < std::size(bands); ++k)
      strips[k].push_back(
          {at[i], quantile(columns[i], bands[k].share), quantile(columns[i], 1 - bands[k].share)});
  }
  median.stretches = {{0, median.x.size(), false}};
  figure.note = count + " curves: their median, and bands of a half and nine tenths";
  figure.key.push_back({.of = results::FigureKeyEntry::Of::curve, .text = "median", .colour = colour});
  figure.curves.push_back(std::move(median));
  for (std::size_t k = 0; k < std::size(bands); ++k) {
    figure.fills.push_back({bands[k].name, colour, bands[k].opacity, 0, {std::move(strips[k])}});
    figure.key.push_back({.of = results::FigureKeyEntry::Of::fill,
                          .text = bands[k].name,
                          .colour = colour,
                          .opacity = bands[k].opacity});
  }
}

}  // namespace arcslip::figures
