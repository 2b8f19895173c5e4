#pragma once
// The parts of a layout, each in a file of its name.

#include <arcslip/results/figure.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace arcslip::figures {

/// Returns the axis of a column.
/// fills: the values fill it; else it has room at both ends, of which the upper one may hold labels, and the
/// lower one where there are minima.
results::FigureAxis axis_of(const results::FigureColumn& column, std::string_view words, bool fills,
                            bool has_minima = false);

/// The axis of angles of a period, 0 to 360 degrees.
results::FigureAxis angle_axis(std::string_view words);

/// The colour of a line by its rank, "#0d0887": the map "plasma" without its light end, so that the order of
/// a family is visible, also in grey and to the colour-blind.
std::string line_colour(std::size_t line, std::size_t lines, bool is_grey);

/// Adds the median and the bands of many lines over x.
void add_quantiles(const results::FigureData& data, const results::FigureView& view,
                   const results::FigureStyle& style, results::Figure& figure);

/// Adds texts next to marks and curves where there is room.
void add_texts(const results::FigureStyle& style, results::Figure& figure);

}  // namespace arcslip::figures
