#pragma once

#include <arcslip/output/figure_labels.hpp>
#include <arcslip/results/figure.hpp>

#include <iosfwd>

namespace arcslip::output {

/// What one axis of a figure spans.
struct Axis {
  results::Range range;
  bool logarithmic = false;

  bool shows(double value) const;
  /// Where a value lies, from 0 to 1.
  double place(double value) const;
};

struct Axes {
  Axis x, y;

  bool shows(const results::Record& values, const results::Figure& figure) const;
  Place place(const results::Record& values, const results::Figure& figure) const;
};

Axes axes_of(const results::FigureData& data, const results::Figure& figure);

/// Labels, ranges and tics.
void write_axes(std::ostream& out, const results::Figure& figure, const Axes& axes);

}  // namespace arcslip::output
