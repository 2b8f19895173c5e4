#pragma once
// A figure as a value: what stands where, in which colour and with which words. Programs and libraries that
// draw follow it and decide nothing.

#include <arcslip/results/event_kind.hpp>
#include <arcslip/results/figure_data.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace arcslip::results {

/// How figures look.
struct FigureStyle {
  int width = 800, height = 500;  // pixels of 1/96 inch; of PNG one and a half times as many
  bool is_grey = false;           // shades of grey in place of colours
};

/// A tick of an axis, in its unit; an empty label: a line without a number.
struct FigureTick {
  double value;
  std::string label;
};

/// Numbers of a figure are those of the data; the axis shows `factor` times as much.
struct FigureAxis {
  std::string label{};  // "amplitude (mm)"
  double factor = 1;    // 1000
  Range range{};        // as it is shown
  bool logarithmic = false;
  std::vector<FigureTick> ticks{};

  /// Whether a number of the data has a place on the axis.
  bool shows(double value) const;
  /// The place of a number of the data, from 0 to 1.
  double place(double value) const;
};

/// A part of a curve.
struct FigureStretch {
  std::size_t first = 0, count = 0;
  bool unstable = false;  // drawn dashed
};

struct FigureCurve {
  std::string name{};     // "3 N"; empty: the only one
  std::string heading{};  // "damper.normal_load = 3 N"
  std::string colour{};   // "#0d0887"
  double width = 2;
  std::size_t line = 0;  // of the data
  std::vector<double> x{}, y{};
  std::vector<FigureStretch> stretches{};
};

/// Marks of a kind on a curve that lie on each other are one, with their count.
struct FigureSymbol {
  EventKind kind;
  std::string colour;
  std::size_t line = 0;
  double x = 0, y = 0;
  std::size_t count = 1;
  std::string text{};  // what it says of itself; empty: the name of its curve
};

/// A text next to a place.
struct FigureText {
  std::string text, colour;
  double x = 0, y = 0;
  double right = 0, up = 0;  // from there, in characters and lines
  int alignment = 0;         // -1: it ends there, 0: its middle is there, 1: it begins there
};

/// What is filled between two curves over x, each strip apart. A band that spans the axis has infinite ends.
struct FigureFill {
  std::string name, colour;
  double opacity = 1;
  std::size_t line = 0;                       // of the data; of areas the rank of their kind or class
  std::vector<std::vector<Record>> strips{};  // records {x, lower, upper}
};

/// An entry of the key.
struct FigureKeyEntry {
  enum class Of { curve, unstable, mark, fill };
  Of of;
  std::string text{}, colour{};
  std::size_t line = 0;  // of curves; of areas the rank of their kind or class
  EventKind kind{};      // of marks
  double opacity = 1;    // of fills
};

struct Figure {
  std::string name{};  // "amplitude"
  std::string title{};
  std::string note{};  // what it shows in place of all curves; empty: it shows them
  FigureAxis x{}, y{};
  std::vector<FigureFill> fills{};
  bool are_areas = false;   // the fills are contact states or tiles, which stand before the grid
  std::size_t classes = 0;  // of tiles, by their values; 0: there are none
  std::vector<FigureCurve> curves{};
  std::vector<FigureSymbol> symbols{};
  std::vector<FigureText> texts{};
  std::vector<std::string> key_title{};  // lines
  std::vector<FigureKeyEntry> key{};
};

}  // namespace arcslip::results
