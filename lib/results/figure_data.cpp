#include <arcslip/results/figure_data.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arcslip::results {

Range range_of(const FigureData& data, std::size_t column, double above) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Range range{infinity, -infinity};
  const auto add = [&](const Record& values) {
    const double value = values[column];
    if (std::isfinite(value) && value > above)
      range = {std::min(range.lower, value), std::max(range.upper, value)};
  };
  for (const FigureLine& line : data.lines) {
    for (const auto& part : line.parts) std::for_each(part.begin(), part.end(), add);
    for (const FigureMark& mark : line.marks) add(mark.record);
  }
  return range;
}

Range full_range(const FigureData& data, std::size_t column) {
  return range_of(data, column, -std::numeric_limits<double>::infinity());
}

std::string x_words(const FigureData& data, const FigureView& view) {
  return view.x_words.empty() ? data.columns[view.x].words : view.x_words;
}

std::string y_words(const FigureData& data, const FigureView& view) {
  return view.y_words.empty() ? data.columns[view.y].words : view.y_words;
}

std::string caption(const FigureData& data, const FigureView& view) {
  return view.tiles.empty() ? y_words(data, view) + " over " + x_words(data, view) : view.value.words;
}

bool is_drawn(const FigureData& data, const FigureView& view) {
  return !data.lines.empty() || !view.tiles.empty();
}

std::string y_unit(const FigureData& data, const FigureView& view) {
  return view.areas.empty() ? data.columns[view.y].unit : "degrees";
}

void add_receptance(FigureData& data) {
  const auto is_amplitude = [](const FigureColumn& column) { return column.is_amplitude; };
  const auto amplitude = std::find_if(data.columns.begin(), data.columns.end(), is_amplitude);
  const auto has_force = [](const FigureLine& line) { return line.force > 0; };
  if (amplitude == data.columns.end() || std::none_of(data.lines.begin(), data.lines.end(), has_force))
    return;
  const auto from = static_cast<std::size_t>(amplitude - data.columns.begin()), to = data.columns.size();
  FigureColumn column{.words = "receptance", .unit = amplitude->unit + "/N", .scale = amplitude->scale};
  for (FigureLine& line : data.lines) {
    const auto add = [&](Record& record) {
      record.push_back(line.force > 0 ? record[from] / line.force : std::nan(""));
    };
    for (auto& part : line.parts) std::for_each(part.begin(), part.end(), add);
    for (FigureMark& mark : line.marks) add(mark.record);
  }
  data.columns.push_back(std::move(column));
  data.columns.back().range =
      data.columns.back().scale == Scale::logarithmic ? range_of(data, to, 0) : full_range(data, to);
  const std::size_t count = data.figures.size();
  for (std::size_t i = 0; i < count; ++i) {
    const FigureView& view = data.figures[i];
    if (view.y == from && view.x == 0 && view.areas.empty())
      data.figures.push_back({.name = "receptance", .x = 0, .y = to, .x_words = view.x_words});
  }
}

}  // namespace arcslip::results
