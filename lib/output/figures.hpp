#pragma once
// Figures, drawn by gnuplot.

#include <arcslip/control/run_control.hpp>
#include <arcslip/results/figure.hpp>

#include <string>
#include <vector>

namespace arcslip::output {

struct Figures {
  std::vector<std::string> sources;  // the data and the gnuplot script, paths starting with `folder`
  std::vector<std::string> images;   // SVG and PNG
  std::string problem;               // why images are missing, one sentence for the user; empty: none are
};

/// Writes NAME.dat and NAME.gp to `folder`, and runs gnuplot to draw the figures of `data` as SVG and PNG.
/// NAME consists of letters, digits, '.', '_' and '-'. If gnuplot is missing, fails, exceeds its time (a
/// minute, plus 0.1 ms for each point of each figure) or `control` ends, `problem` reports it and the
/// sources are written nevertheless. Images of these names that are there stay where they cannot be drawn.
/// Throws WriteError if the sources cannot be written.
Figures draw_figures(const results::FigureData& data, const std::string& folder, const std::string& name,
                     const control::Control& control = {});

/// Returns the names of all files that draw_figures() may write to its folder, temporary ones among them.
std::vector<std::string> figure_files(const results::FigureData& data, const std::string& name);

/// A file name for any name: characters other than letters, digits, '_', '-' and an inner '.' become '_'.
std::string file_name(const std::string& name);

}  // namespace arcslip::output
