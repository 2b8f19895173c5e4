#pragma once
// Figures, drawn by gnuplot.

#include <arcslip/results/figure.hpp>
#include <arcslip/scene/stop_request.hpp>

#include <string>
#include <vector>

namespace arcslip::output {

struct Figures {
  std::vector<std::string> sources;  // the data and the gnuplot script, paths that begin with `folder`
  std::vector<std::string> images;   // SVG and PNG
  std::string problem;               // why images are missing, one sentence for people; empty: all are there
};

/// Writes NAME.dat and NAME.gp into `folder`, and lets gnuplot make of them the figures of `data`, as SVG and
/// PNG. NAME is made of letters, digits, '.', '_' and '-' only. Without gnuplot, or where it fails, hangs (it
/// has a minute, and 0.1 ms more for each point of each figure) or `stop` is asked for, `problem` says so and
/// the sources are there all the same. Images of an earlier run with this NAME are removed first. Throws
/// WriteError where the sources cannot be written.
Figures draw_figures(const results::FigureData& data, const std::string& folder, const std::string& name,
                     const scene::StopRequest& stop = {});

/// Removes the sources of this NAME in `folder` and the images that they were drawn to, if they are there.
void remove_figures(const std::string& folder, const std::string& name);

/// A file name for anything that has a name: what is not a letter, a digit, '_', '-' or an inner '.' becomes
/// '_'.
std::string file_name(const std::string& name);

}  // namespace arcslip::output
