#include <arcslip/report/parts.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::report {
namespace {

using results::FigureColumn;
using results::FigureData;
using results::Record;

/// Records in shares of the axes. What cannot be shown is 0.
class Scaled {
 public:
  Scaled(const FigureData& data, const std::vector<Record>& records) : records_(records) {
    for (std::size_t c = 0; c < data.columns.size(); ++c)
      if (data.columns[c].has_axis) axes_.push_back({c, data.columns[c]});
  }

  /// How far record i is from the line between two others, in the column where it is farthest, at the place
  /// along the line that is nearest.
  double distance(std::size_t from, std::size_t i, std::size_t to) const {
    double along = 0, length = 0;
    for (const Axis& axis : axes_) {
      const double a = axis.place(records_[from]), step = axis.place(records_[to]) - a;
      along += step * (axis.place(records_[i]) - a);
      length += step * step;
    }
    const double at = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
    double farthest = 0;
    for (const Axis& axis : axes_) {
      const double a = axis.place(records_[from]), step = axis.place(records_[to]) - a;
      farthest = std::max(farthest, std::abs(axis.place(records_[i]) - a - at * step));
    }
    return farthest;
  }

 private:
  struct Axis {
    std::size_t column;
    const FigureColumn& of;

    double place(const Record& record) const {
      const double value = record[column], lower = of.range.lower, upper = of.range.upper;
      const bool logarithmic = of.scale == results::Scale::logarithmic;
      if (!std::isfinite(value) || !(upper > lower) || (logarithmic && !(value > 0))) return 0;
      return logarithmic ? std::log(value / lower) / std::log(upper / lower)
                         : (value - lower) / (upper - lower);
    }
  };

  const std::vector<Record>& records_;
  std::vector<Axis> axes_;
};

/// Points of a part that are thinned at a time, since the work may grow as their square.
constexpr std::size_t block = 256;

/// Keeps the ends of a part and what lies farther than the tolerance from the line between two that are kept
/// (Ramer 1972, Douglas and Peucker 1973).
std::vector<Record> thinned(const FigureData& data, const std::vector<Record>& part, double tolerance) {
  if (part.size() < 3) return part;
  const Scaled scaled(data, part);
  std::vector<bool> kept(part.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open;
  for (std::size_t from = 0; from + 1 < part.size(); from += block) {
    open.emplace_back(from, std::min(from + block, part.size() - 1));
    kept[from] = true;
  }
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    std::size_t farthest = from;
    double distance = tolerance;
    for (std::size_t i = from + 1; i < to; ++i)
      if (const double own = scaled.distance(from, i, to); own > distance) farthest = i, distance = own;
    if (farthest == from) continue;
    kept[farthest] = true;
    open.insert(open.end(), {{from, farthest}, {farthest, to}});
  }
  std::vector<Record> some;
  for (std::size_t i = 0; i < part.size(); ++i)
    if (kept[i]) some.push_back(part[i]);
  return some;
}

}  // namespace

FigureData thinned(const FigureData& data, double tolerance) {
  constexpr double coarse_areas = 4e-4;  // of the axes: a third of a pixel
  const FigureColumn angle{.words = "angle", .range = {0, 360}};
  FigureData all = data;
  for (results::FigureLine& line : all.lines)
    for (std::vector<Record>& part : line.parts) part = thinned(data, part, tolerance);
  for (results::FigureView& view : all.figures) {
    FigureData of_areas;
    of_areas.columns = {data.columns[view.x], angle, angle};
    for (results::FigureArea& area : view.areas)
      for (std::vector<Record>& strip : area.strips)
        strip = thinned(of_areas, strip, std::max(tolerance, coarse_areas));
  }
  return all;
}

std::size_t points_of(const FigureData& data) {
  std::size_t count = 0;
  for (const results::FigureLine& line : data.lines)
    for (const std::vector<Record>& part : line.parts) count += part.size();
  return count;
}

}  // namespace arcslip::report
