#pragma once
// Figures of studies, drawn by gnuplot.

#include <arcslip/observables/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <span>
#include <string>
#include <vector>

namespace arcslip::output {

struct Figures {
  std::vector<std::string> sources;  // the data and the gnuplot script, paths that begin with `folder`
  std::vector<std::string> images;   // SVG and PNG
  std::string problem;               // why images are missing, one sentence for people; empty: all are there
};

/// Writes NAME.dat and NAME.gp into `folder`, of the branches of one study of this kind, and lets gnuplot
/// make of them the figures of gnuplot_figures(), as SVG and PNG, with a line for each combination of set
/// parameters. NAME is made of letters, digits, '.', '_' and '-' only. Without gnuplot, or where it fails,
/// `problem` says so and the sources are there all the same. Throws WriteError where these cannot be written.
Figures write_figures(const scene::Scene& scene, scene::StudyKind kind,
                      std::span<const observables::ResponseBranch> branches, const std::string& folder,
                      const std::string& name);

/// A file name for anything that has a name: what is not a letter, a digit, '_', '-' or an inner '.' becomes
/// '_'.
std::string file_name(const std::string& name);

}  // namespace arcslip::output
