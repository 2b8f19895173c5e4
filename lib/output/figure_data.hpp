#pragma once
// What the figures of a family of frequency responses show, before any program draws it.

#include <arcslip/observables/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <iosfwd>
#include <span>
#include <string>
#include <vector>

namespace arcslip::output {

/// A mark on a line: a peak or a fold.
struct FigureMark {
  bool peak = true;
  double frequency = 0, amplitude = 0;
  std::vector<double> stick;  // % for each friction element
};

/// One line of a figure: the branches with the same set parameters.
struct FigureLine {
  std::string label;                                      // "3 N", or "3 N, 0.1 N s/m"
  std::vector<const observables::ResponseBranch*> parts;  // drawn apart
  std::vector<FigureMark> marks;
};

struct Range {
  double lower = 0, upper = 0;
};

struct FigureData {
  std::string title;
  double frequency_unit = 1;            // rad/s
  std::string frequency_label;          // "frequency (Hz)"
  std::vector<std::string> parameters;  // that tell the lines apart, by name
  std::vector<std::string> friction;    // names of the friction elements
  std::vector<FigureLine> lines;
  Range frequency;
  Range amplitude;  // of the positive ones; upper = 0: there is none
};

/// Points into `branches`, which must outlive it.
FigureData figure_data(const scene::Scene& scene, std::span<const observables::ResponseBranch> branches);

/// Data as gnuplot reads it: for each line an indexed block with its points, then one with its peaks, then
/// one with its folds; columns frequency, amplitude (m), stick (%) of each friction element. No block is
/// empty.
void write_figure_data(std::ostream& out, const scene::Scene& scene, const FigureData& data);

}  // namespace arcslip::output
