#pragma once

#include <arcslip/output/figure_labels.hpp>
#include <arcslip/results/figure.hpp>

#include <cstddef>
#include <iosfwd>
#include <string>

namespace arcslip::output {

/// A text in single quotes for gnuplot. Characters that are invalid in XML or unsafe for a terminal are
/// escaped (results/text.hpp).
std::string single_quoted(const std::string& text);

/// The first `longest` characters (UTF-8) of a text, followed by " ..." if it is longer.
std::string shortened(const std::string& text, int longest);

/// Colour of a line by its rank, "#0d0887": the map "plasma" without its light end, so that the order of a
/// family is visible, also in grey and to the colour-blind.
std::string line_colour(std::size_t line, std::size_t lines);

/// Dash type of a line, different for neighbours, for use without colour.
std::string line_dash(std::size_t line);

/// The range and scale of an axis.
struct Axis {
  results::Range range;
  bool logarithmic = false;

  bool shows(double value) const;
  /// Position of a value on the axis, from 0 to 1.
  double place(double value) const;
};

struct Axes {
  Axis x, y;

  bool shows(const results::Record& values, const results::Figure& figure) const;
  Position place(const results::Record& values, const results::Figure& figure) const;
};

Axes axes_of(const results::FigureData& data, const results::Figure& figure);

/// Labels, ranges and tics.
void write_axes(std::ostream& out, const results::Figure& figure, const Axes& axes);

}  // namespace arcslip::output
