#pragma once
// What the figures of a study show, before any program draws it.

#include <arcslip/observables/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <array>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace arcslip::output {

struct Range {
  double lower = 0, upper = 0;
};

enum class Scale { linear, logarithmic, percent };

/// A quantity of every point, and how an axis shows it.
struct FigureColumn {
  std::string label;  // "frequency (Hz)"
  Scale scale = Scale::linear;
  Range range{};  // of the values that the scale can show; lower > upper: there are none
};

using Record = std::vector<double>;  // a value for each column, NaN where there is none

/// The kinds of events that are drawn, in the order of the data.
inline constexpr std::array<std::string_view, 6> mark_kinds = {"peak",    "fold", "maximum",
                                                               "minimum", "cusp", "turn"};

struct FigureMark {
  std::string kind;
  Record record;
  std::string label{};  // empty: that of its line
};

/// Values of what the study goes over (column 0) that are shaded over the height of the figure.
struct FigureBand {
  std::string label;  // "within 5 %"
  Range range;
};

/// One line of a figure: the branches with the same set parameters.
struct FigureLine {
  std::string label;                                // "3 N", or "3 N, 0.1 N s/m"
  std::vector<std::pair<std::string, double>> set;  // what the label tells, with names
  std::vector<std::vector<Record>> parts;           // drawn apart
  std::vector<FigureMark> marks;
  bool unbounded = false;           // somewhere, where nothing can be drawn
  std::vector<FigureBand> bands{};  // the widest first
};

/// A column beyond those of every study, drawn over column 0 in a figure of its own, NAME_`name`.
struct FurtherColumn {
  std::string name;
  std::size_t column;
};

struct FigureData {
  scene::StudyKind kind = scene::StudyKind::frf;
  std::string title;
  std::vector<std::string> parameters;  // that tell the lines apart, by name
  std::vector<std::string> friction;    // names of the friction elements
  std::vector<FigureColumn> columns;    // see write_figure_data()
  std::vector<FigureLine> lines;
  std::vector<FurtherColumn> further{};

  /// Columns from 0; stick_column() is that of the first friction element.
  std::size_t frequency_column() const { return kind == scene::StudyKind::frf ? 0 : 1; }
  std::size_t amplitude_column() const { return frequency_column() + 1; }
  std::size_t stick_column() const { return frequency_column() + 2; }
};

/// The branches of one study of this kind.
FigureData figure_data(const scene::Scene& scene, scene::StudyKind kind,
                       std::span<const observables::ResponseBranch> branches);

/// What tells a line by its set parameters: "3 N, 0.1 N s/m".
std::string set_label(const scene::Scene& scene, const std::vector<std::pair<std::string, double>>& set);

/// Of all finite values of a column; lower > upper where there are none.
Range full_range(const FigureData& data, std::size_t column);

/// Data as gnuplot reads it: for each line an indexed block with its points, then one for each kind of its
/// marks, in the order of mark_kinds; columns: the parameter of a study over one, the frequency, amplitude
/// (m), stick (%) of each friction element. No block is empty.
void write_figure_data(std::ostream& out, const scene::Scene& scene, const FigureData& data);

}  // namespace arcslip::output
