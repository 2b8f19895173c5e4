// Figures (results/figure.hpp) of curves that Python has.

#include "bindings.hpp"

#include <arcslip/figures/layout.hpp>
#include <arcslip/optimize/curve/optimum_curve.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/figure.hpp>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace nb = nanobind;

namespace arcslip::python {
namespace {

using results::EventKind;
using results::FigureData;

/// Points, of shape (points, 2).
using Points = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

/// The kind of a name; one without a mark where it is unknown.
EventKind kind_of(const std::string& name) {
  const auto& all = observables::event_kinds::all;
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const EventKind& kind) { return kind == name; });
  if (found != all.end()) return *found;
  return name == optimize::event_kinds::turning_point.name ? optimize::event_kinds::turning_point
                                                           : EventKind{};
}

std::vector<results::Record> records(const Points& points) {
  if (points.shape(1) != 2) throw nb::value_error("points must have two columns");
  std::vector<results::Record> all;
  for (std::size_t i = 0; i < points.shape(0); ++i)
    all.push_back({points.data()[2 * i], points.data()[2 * i + 1]});
  return all;
}

results::FigureColumn column_of(const nb::dict& of) {
  results::FigureColumn column{nb::cast<std::string>(of["words"]), nb::cast<std::string>(of["unit"])};
  const auto scale = nb::cast<std::string>(of["scale"]);
  if (scale == "logarithmic") column.scale = results::Scale::logarithmic;
  if (scale == "percent") column.scale = results::Scale::percent;
  return column;
}

results::FigureLine line_of(const nb::dict& of) {
  results::FigureLine line{nb::cast<std::string>(of["label"])};
  for (const nb::handle part : nb::cast<nb::list>(of["parts"]))
    line.parts.push_back(records(nb::cast<Points>(part)));
  line.unstable = nb::cast<std::vector<bool>>(of["unstable"]);
  for (const auto& [name, points] : nb::cast<nb::dict>(of["marks"]))
    for (results::Record& record : records(nb::cast<Points>(points)))
      line.marks.push_back({kind_of(nb::cast<std::string>(name)), std::move(record)});
  return line;
}

FigureData data_of(const nb::dict& of) {
  FigureData data;
  data.parameters = nb::cast<std::vector<std::string>>(of["parameters"]);
  for (const nb::handle column : nb::cast<nb::list>(of["columns"]))
    data.columns.push_back(column_of(nb::cast<nb::dict>(column)));
  for (const nb::handle line : nb::cast<nb::list>(of["lines"]))
    data.lines.push_back(line_of(nb::cast<nb::dict>(line)));
  for (std::size_t c = 0; c < data.columns.size(); ++c)
    data.columns[c].range = data.columns[c].scale == results::Scale::logarithmic
                                ? results::range_of(data, c, 0)
                                : results::full_range(data, c);
  return data;
}

nb::dict as_dict(const results::FigureAxis& axis) {
  nb::dict all;
  all["label"] = axis.label;
  all["factor"] = axis.factor;
  all["logarithmic"] = axis.logarithmic;
  return all;
}

/// The name of a shape: "filled_circle".
std::string name_of(results::Shape shape) {
  static constexpr std::array names{"none",
                                    "plus",
                                    "cross",
                                    "star",
                                    "square",
                                    "filled_square",
                                    "circle",
                                    "filled_circle",
                                    "triangle",
                                    "filled_triangle",
                                    "inverted_triangle",
                                    "filled_inverted_triangle",
                                    "diamond",
                                    "filled_diamond",
                                    "pentagon",
                                    "filled_pentagon"};
  return names.at(static_cast<std::size_t>(shape));
}

nb::list curves(const results::Figure& figure) {
  nb::list all;
  for (const results::FigureCurve& curve : figure.curves) {
    nb::list stretches;
    for (const results::FigureStretch& stretch : curve.stretches)
      stretches.append(nb::make_tuple(stretch.first, stretch.first + stretch.count, stretch.unstable));
    nb::dict each;
    each["name"] = curve.name;
    each["colour"] = curve.colour;
    each["line"] = curve.line;
    each["x"] = curve.x;
    each["y"] = curve.y;
    each["stretches"] = stretches;
    all.append(each);
  }
  return all;
}

nb::list symbols(const results::Figure& figure) {
  nb::list all;
  for (const results::FigureSymbol& symbol : figure.symbols)
    all.append(nb::make_tuple(name_of(symbol.kind.mark.shape), symbol.colour, symbol.x, symbol.y));
  return all;
}

nb::list texts(const results::Figure& figure) {
  nb::list all;
  for (const results::FigureText& text : figure.texts)
    all.append(nb::make_tuple(text.text, text.colour, text.x, text.y, text.right, text.up, text.alignment));
  return all;
}

nb::list fills(const results::Figure& figure) {
  nb::list all;
  for (const results::FigureFill& fill : figure.fills) {
    nb::dict each;
    each["name"] = fill.name;
    each["colour"] = fill.colour;
    each["opacity"] = fill.opacity;
    each["strips"] = fill.strips;
    all.append(each);
  }
  return all;
}

nb::list key(const results::Figure& figure) {
  static constexpr std::array kinds{"curve", "unstable", "mark", "fill"};
  nb::list all;
  for (const results::FigureKeyEntry& entry : figure.key) {
    nb::dict each;
    each["of"] = kinds.at(static_cast<std::size_t>(entry.of));
    each["text"] = entry.text;
    each["colour"] = entry.colour;
    each["shape"] = name_of(entry.kind.mark.shape);
    each["opacity"] = entry.opacity;
    all.append(each);
  }
  return all;
}

/// The figure of lines over two columns, x and y.
nb::dict figure(const nb::dict& of, int width, int height) {
  const FigureData data = data_of(of);
  if (data.columns.size() != 2) throw nb::value_error("a figure has two columns");
  const results::Figure made =
      figures::figure_of(data, {.name = "figure", .x = 0, .y = 1}, {.width = width, .height = height});
  nb::dict all;
  all["note"] = made.note;
  all["x"] = as_dict(made.x);
  all["y"] = as_dict(made.y);
  all["curves"] = curves(made);
  all["symbols"] = symbols(made);
  all["texts"] = texts(made);
  all["fills"] = fills(made);
  all["key_title"] = made.key_title;
  all["key"] = key(made);
  return all;
}

}  // namespace

void bind_figures(nb::module_& core) {
  core.def("figure", figure, nb::arg("data"), nb::arg("width"), nb::arg("height"));
}

}  // namespace arcslip::python
