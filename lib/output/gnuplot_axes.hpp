#pragma once

#include <arcslip/output/figure_data.hpp>
#include <arcslip/output/figure_labels.hpp>
#include <arcslip/output/gnuplot_script.hpp>

#include <iosfwd>

namespace arcslip::output {

/// What the axes of a figure span. The amplitude is logarithmic, unless none is positive.
struct Axes {
  Range x, y;
  bool logarithmic = false;

  bool shows(double height) const;
  /// Where a frequency and a height lie over the axes.
  Place place(double frequency, double height) const;
};

Axes axes_of(const FigureData& data, const GnuplotFigure& figure);

/// Labels, ranges and tics.
void write_axes(std::ostream& out, const FigureData& data, const GnuplotFigure& figure, const Axes& axes);

}  // namespace arcslip::output
