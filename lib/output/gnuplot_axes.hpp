#pragma once

#include <arcslip/output/figure_data.hpp>
#include <arcslip/output/figure_labels.hpp>
#include <arcslip/output/gnuplot_script.hpp>

#include <iosfwd>

namespace arcslip::output {

/// What one axis of a figure spans.
struct Axis {
  Range range;
  bool logarithmic = false;

  bool shows(double value) const;
  /// Where a value lies, from 0 to 1.
  double place(double value) const;
};

struct Axes {
  Axis x, y;

  bool shows(const Record& values, const GnuplotFigure& figure) const;
  Place place(const Record& values, const GnuplotFigure& figure) const;
};

Axes axes_of(const FigureData& data, const GnuplotFigure& figure);

/// Labels, ranges and tics.
void write_axes(std::ostream& out, const GnuplotFigure& figure, const Axes& axes);

}  // namespace arcslip::output
