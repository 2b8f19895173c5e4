#pragma once

#include <arcslip/output/figure_data.hpp>

#include <iosfwd>
#include <string>
#include <vector>

namespace arcslip::output {

/// One figure of the script: which column of the data over the frequency.
struct GnuplotFigure {
  std::string name;        // of the images, without .svg and .png
  int column = 2;          // of the data: 2 amplitude, from 3 on the stick of each friction element
  std::string element;     // the friction element of a stick column
  std::string axis_label;  // "amplitude (m)"
};

/// The figures that the data allows: the amplitude, and the stick share of each friction element.
std::vector<GnuplotFigure> gnuplot_figures(const FigureData& data, const std::string& name);

/// A script that draws NAME.dat as the given figures, each as SVG and as PNG. It runs by itself ("gnuplot
/// NAME.gp"); a variable `suffix` set before is put after the names of the images.
void write_gnuplot_script(std::ostream& out, const FigureData& data, const std::string& name,
                          const std::vector<GnuplotFigure>& figures);

}  // namespace arcslip::output
