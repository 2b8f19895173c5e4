#pragma once
// Figures as gnuplot data and scripts.

#include <arcslip/results/figure.hpp>

#include <iosfwd>
#include <string>
#include <vector>

namespace arcslip::output {

/// The names of the images of each figure, without .svg and .png: NAME_FIGURE, shortened to a valid
/// file name.
std::vector<std::string> image_names(const results::FigureData& data, const std::string& name);

/// For each line an indexed block with its points, then one for each kind of its marks, in the order of
/// results/event_kinds.hpp. Empty blocks are omitted. Then a block for each area of each figure, its strips
/// apart.
void write_figure_data(std::ostream& out, const results::FigureData& data);

/// A script that draws NAME.dat as these images, each as SVG and PNG. It runs on its own ("gnuplot NAME.gp");
/// a variable `suffix` set before is appended to the names of the images.
void write_gnuplot_script(std::ostream& out, const results::FigureData& data, const std::string& name,
                          const std::vector<std::string>& images);

}  // namespace arcslip::output
