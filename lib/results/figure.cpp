#include <arcslip/results/figure.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

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

}  // namespace arcslip::results
