#pragma once
// Figures as gnuplot data and scripts.

#include <arcslip/results/figure.hpp>

#include <iosfwd>
#include <span>
#include <string>
#include <vector>

namespace arcslip::output {

/// For each figure and each of its curves an indexed block with its stable points and one with its unstable
/// ones, then one for each of its marks, then one for each fill, its strips apart. Empty blocks are omitted.
void write_figure_data(std::ostream& out, std::span<const results::Figure> figures);

/// A script that draws NAME.dat as these images, one for each figure, in these formats (svg, png, pdf). It
/// runs on its own ("gnuplot NAME.gp"); a variable `suffix` set before is appended to the names of the
/// images.
void write_gnuplot_script(std::ostream& out, std::span<const results::Figure> figures,
                          const std::string& name, const std::vector<std::string>& images,
                          const std::vector<std::string>& formats, const results::FigureStyle& style);

}  // namespace arcslip::output
