#include <arcslip/output/gnuplot_axes.hpp>

#include <arcslip/output/gnuplot_style.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <vector>

namespace arcslip::output {
namespace {

/// Without the rounding of units in the last digits, so that the tic at the end of an axis is there.
std::string rounded(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.10g", value);
  return text.data();
}

/// Tics of a logarithmic axis: decades, or 1, 2, 5 where there are few of them.
void write_logarithmic_tics(std::ostream& out, const Range& range) {
  const double decades = std::log10(range.upper / range.lower);
  if (decades > 2) {
    out << "set ytics " << (decades > 12 ? "1e3" : "10") << "\nset mytics 10\nset format y '10^{%T}'\n";
    return;
  }
  const std::vector<double> fine{1, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 9};
  const std::vector<double> coarse{1, 2, 5};
  out << "set ytics (";
  const char* separator = "";
  for (int exponent = static_cast<int>(std::floor(std::log10(range.lower)));
       exponent <= static_cast<int>(std::ceil(std::log10(range.upper))); ++exponent) {
    for (const double digit : decades > 0.7 ? coarse : fine) {
      const double value = digit * std::pow(10.0, exponent);
      if (value >= range.lower && value <= range.upper) {
        out << separator << rounded(value);
        separator = ", ";
      }
    }
  }
  out << ")\nset format y '%g'\n";
}

}  // namespace

bool Axes::shows(double height) const {
  return std::isfinite(height) && !(logarithmic && height <= 0);
}

Place Axes::place(double frequency, double height) const {
  return {(frequency - x.lower) / (x.upper - x.lower),
          logarithmic ? std::log(height / y.lower) / std::log(y.upper / y.lower)
                      : (height - y.lower) / (y.upper - y.lower)};
}

Axes axes_of(const FigureData& data, const GnuplotFigure& figure) {
  Axes axes;
  axes.x = data.frequency;
  if (!(axes.x.upper > axes.x.lower)) {  // a single frequency
    const double width = std::isfinite(axes.x.lower) ? std::max(std::abs(axes.x.lower), 1e-300) / 10 : 1;
    const double middle = std::isfinite(axes.x.lower) ? axes.x.lower : 0;
    axes.x = {middle - width, middle + width};
  }
  if (figure.column != 2) {
    axes.y = {-3, 103};
  } else if (data.amplitude.upper > 0) {
    axes.logarithmic = true;
    const double spread = std::pow(data.amplitude.upper / data.amplitude.lower, 0.05);
    axes.y = {data.amplitude.lower / std::max(spread, 1.05),
              data.amplitude.upper * std::max(spread * spread, 1.15)};
  } else {
    axes.y = {-1, 1};
  }
  return axes;
}

void write_axes(std::ostream& out, const FigureData& data, const GnuplotFigure& figure, const Axes& axes) {
  out << (axes.logarithmic ? "set logscale y 10\n" : "unset logscale y\n") << "set xlabel "
      << quoted(data.frequency_label) << " noenhanced\n"
      << "set ylabel " << quoted(figure.axis_label) << " noenhanced\n"
      << "set xrange [" << rounded(axes.x.lower) << ":" << rounded(axes.x.upper) << "]\n"
      << "set yrange [" << rounded(axes.y.lower) << ":" << rounded(axes.y.upper) << "]\n"
      << "set xtics autofreq\nset format x '%g'\n";
  if (axes.logarithmic) {
    write_logarithmic_tics(out, axes.y);
  } else {
    out << "set ytics autofreq\nunset mytics\nset format y '%g'\n";
  }
}

}  // namespace arcslip::output
