#pragma once
// The curves of results as data, from which pages and figures are made.

#include <arcslip/results/event_kind.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::results {

struct Range {
  double lower = 0, upper = 0;
};

enum class Scale { linear, logarithmic, percent };

/// A quantity of every point, with its axis.
struct FigureColumn {
  std::string words;   // "amplitude"
  std::string unit{};  // "m"; empty: none
  Scale scale = Scale::linear;
  Range range{};              // of the values that the scale can show; lower > upper: none
  bool has_axis = true;       // false: shown at a point alone, and in no file of data
  bool is_frequency = false;  // of the excitation, whose multiples mean something
  bool is_amplitude = false;  // of the response, over which a force gives a receptance
};

using Record = std::vector<double>;  // a value for each column, NaN if missing

struct FigureMark {
  EventKind kind;
  Record record;
  std::string label{};  // empty: that of its line
};

/// A range of column 0 that is shaded in the figures over it.
struct FigureBand {
  std::string label;  // "within 5 %"
  Range range;
};

/// A force over the displacement that it acts along, over a period.
struct FigureLoop {
  std::string name;  // "damper"
  std::vector<double> displacement, force;
};

/// The motion at a point of a line, at instants from 0 to 1 of its period.
struct FigureMotion {
  Record record;                       // the point
  std::string words{};                 // "resonance peak"; empty: no event
  double period = 0;                   // s
  std::vector<double> displacement{};  // of the response, m
  std::vector<FigureLoop> loops{};     // of friction elements
};

/// One line of a figure: the results with the same set parameters.
struct FigureLine {
  std::string label{};                                // "3 N", or "3 N, 0.1 N s/m"
  std::string heading{};                              // in the data: "damper.normal_load = 3 N, ..."
  std::vector<std::pair<std::string, double>> set{};  // the parameters
  std::vector<std::vector<Record>> parts{};           // drawn separately
  std::vector<bool> unstable{};                       // of each part: it is drawn dashed; empty: not known
  std::vector<FigureMark> marks{};
  std::vector<FigureMotion> motions{};  // at some points
  bool unbounded = false;               // somewhere, outside what is drawn
  bool is_main = false;                 // drawn before the others, wider and dark: the curve of an optimum
  double force = std::numeric_limits<double>::quiet_NaN();  // amplitude of the excitation, N; NaN: not one
  std::vector<FigureBand> bands{};                          // the widest first
};

/// The kinds of areas that are drawn, in the order of the key.
inline constexpr std::array<std::string_view, 8> area_kinds = {"stick", "slip",   "slip+",   "slip-",
                                                               "open",  "closed", "closed+", "closed-"};

/// Strips of a plane that are filled: of each, at some x, its lower and its upper end.
struct FigureArea {
  std::string kind;
  std::vector<std::vector<Record>> strips;  // records {x, lower, upper}
};

/// A rectangle of the plane of two columns, with a value.
struct FigureTile {
  double left = 0, right = 0, lower = 0, upper = 0;
  double value = 0;
};

/// One column over another, both counted from 0; or areas over column x and an angle, 0 to 360 degrees; or
/// tiles over columns x and y.
struct FigureView {
  std::string name;  // "amplitude"
  std::size_t x = 0, y = 1;
  std::string x_words{}, y_words{};  // "peak amplitude"; empty: those of the column
  std::vector<FigureArea> areas{};   // in place of the lines
  std::vector<FigureTile> tiles{};   // in place of the lines
  FigureColumn value{};              // of the tiles
  std::string note{};                // what the tiles are of: "resonance peak at 73.5 Hz"
};

/// The data of figures with the same lines.
struct FigureData {
  std::string name{};  // distinguishes it from others of the same results; usually ""
  std::string title;
  std::vector<std::string> parameters{};  // that distinguish the lines, by name
  std::vector<FigureColumn> columns{};
  std::vector<FigureLine> lines{};
  std::vector<FigureView> figures{};  // none: nothing is drawn
};

/// The words of the axes of a figure: "peak amplitude".
std::string x_words(const FigureData& data, const FigureView& view);
std::string y_words(const FigureData& data, const FigureView& view);

/// What stands over a figure: "amplitude over frequency", "largest pressure".
std::string caption(const FigureData& data, const FigureView& view);

/// Whether a figure shows anything.
bool is_drawn(const FigureData& data, const FigureView& view);

/// The unit of y, which areas have of their own.
std::string y_unit(const FigureData& data, const FigureView& view);

/// Adds amplitudes over the force of their lines as a column, and a figure for each that shows amplitudes
/// over the frequency or a parameter. Lines without a force have none.
void add_receptance(FigureData& data);

/// The range of all finite values of a column above a bound; lower > upper if there are none.
Range range_of(const FigureData& data, std::size_t column, double above);
Range full_range(const FigureData& data, std::size_t column);

}  // namespace arcslip::results
