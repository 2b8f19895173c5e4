#pragma once

#include <arcslip/output/figure_data.hpp>

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

namespace arcslip::output {

/// One figure of the script: one column of the data over another, both counted from 0.
struct GnuplotFigure {
  std::string name;  // of the images, without .svg and .png
  std::size_t x = 0, y = 1;
  std::string x_label, y_label;  // "amplitude (m)"
};

/// The figures that the data allows. Of frequency responses and of traces over a parameter: the amplitude
/// (NAME_amplitude) and the stick share of each friction element (NAME_stick). Of resonance peaks over a
/// parameter: their amplitude, their frequency (NAME_frequency), and the amplitude over the stick share of
/// each friction element (NAME_amplitude_over_stick). Of folds: the parameter over the frequency
/// (NAME_folds). Of motions in time: those of write_figures() in output/motion.hpp.
std::vector<GnuplotFigure> gnuplot_figures(const FigureData& data, const std::string& name);

/// A script that draws NAME.dat as the given figures, each as SVG and as PNG. It runs by itself ("gnuplot
/// NAME.gp"); a variable `suffix` set before is put after the names of the images.
void write_gnuplot_script(std::ostream& out, const FigureData& data, const std::string& name,
                          const std::vector<GnuplotFigure>& figures);

}  // namespace arcslip::output
