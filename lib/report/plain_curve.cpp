#include <arcslip/figures/layout.hpp>
#include <arcslip/report/parts.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace arcslip::report {
namespace {

using results::Figure;
using results::FigureCurve;
using results::FigureData;
using results::FigureFill;
using results::FigureKeyEntry;
using results::FigureView;

// Pixels of the drawing, and of its axes.
constexpr double paper_width = 760, paper_height = 400, frame_left = 78, frame_right = 744, frame_top = 14,
                 frame_bottom = 352;
constexpr double coarse = 4e-4;             // of the axes: a third of a pixel
constexpr std::size_t categories = 8;       // colours that differ in kind
constexpr std::size_t sequence_steps = 16;  // colours in a sequence

double across(double share) {
  return frame_left + share * (frame_right - frame_left);
}

double up(double share) {
  return frame_bottom + share * (frame_top - frame_bottom);
}

/// A place of the data on the paper.
std::string place(const Figure& figure, double x, double y) {
  return pixels(across(figure.x.place(x))) + " " + pixels(up(figure.y.place(y)));
}

/// The places of the ticks that have labels.
std::vector<std::pair<double, std::string>> ticks_of(const results::FigureAxis& axis) {
  std::vector<std::pair<double, std::string>> all;
  for (const results::FigureTick& tick : axis.ticks)
    if (!tick.label.empty()) all.emplace_back(axis.place(tick.value / axis.factor), tick.label);
  return all;
}

void write_axes(Html& html, const Figure& figure) {
  html.open("g", {{"class", "axis"}});
  for (const auto& [share, label] : ticks_of(figure.x)) {
    const std::string at = pixels(across(share));
    html.empty(
        "line",
        {{"class", "grid"}, {"x1", at}, {"x2", at}, {"y1", pixels(frame_top)}, {"y2", pixels(frame_bottom)}});
    html.element("text", label, {{"x", at}, {"y", pixels(frame_bottom + 18)}, {"text-anchor", "middle"}});
  }
  for (const auto& [share, label] : ticks_of(figure.y)) {
    const double at = up(share);
    html.empty("line", {{"class", "grid"},
                        {"x1", pixels(frame_left)},
                        {"x2", pixels(frame_right)},
                        {"y1", pixels(at)},
                        {"y2", pixels(at)}});
    html.element("text", label,
                 {{"x", pixels(frame_left - 8)}, {"y", pixels(at + 4)}, {"text-anchor", "end"}});
  }
  html.empty("path", {{"class", "frame"},
                      {"d", "M" + pixels(frame_left) + " " + pixels(frame_top) + "V" + pixels(frame_bottom) +
                                "H" + pixels(frame_right)}});
  html.element("text", figure.x.label,
               {{"class", "title"},
                {"x", pixels((frame_left + frame_right) / 2)},
                {"y", pixels(paper_height - 8)},
                {"text-anchor", "middle"}});
  html.element("text", figure.y.label,
               {{"class", "title"},
                {"transform", "translate(16 " + pixels((frame_top + frame_bottom) / 2) + ") rotate(-90)"},
                {"text-anchor", "middle"}});
  html.close();
}

std::string path_of(const Figure& figure, const FigureCurve& curve, const results::FigureStretch& stretch) {
  std::string path;
  bool is_down = false;
  for (std::size_t i = stretch.first; i < stretch.first + stretch.count; ++i) {
    const bool is_shown = figure.x.shows(curve.x[i]) && figure.y.shows(curve.y[i]);
    if (is_shown) path += (is_down ? "L" : "M") + place(figure, curve.x[i], curve.y[i]);
    is_down = is_shown;
  }
  return path;
}

std::string path_of(const Figure& figure, const FigureFill& fill) {
  const auto end_of = [&](double value) {
    return std::isfinite(value) ? up(figure.y.place(value)) : value < 0 ? frame_bottom : frame_top;
  };
  const auto x_of = [&](double value) {
    return pixels(std::clamp(across(figure.x.place(value)), frame_left, frame_right));
  };
  std::string path;
  for (const auto& strip : fill.strips) {
    const char* command = "M";
    const auto add = [&](const results::Record& at, std::size_t end) {
      path += command + x_of(at[0]) + " " + pixels(end_of(at[end]));
      command = "L";
    };
    for (auto at = strip.begin(); at != strip.end(); ++at) add(*at, 1);
    for (auto at = strip.rbegin(); at != strip.rend(); ++at) add(*at, 2);
    path += "Z";
  }
  return path;
}

/// How the curves, the marks and the fills of a figure look.
class Classes {
 public:
  Classes(const FigureData& data, const Figure& figure) : data_(data), figure_(figure) {}

  std::string curve(std::size_t line) const {
    return line_class(line, data_.lines.size()) + (data_.lines[line].is_main ? " main" : "");
  }
  std::string fill(std::size_t line, double opacity) const {
    if (figure_.are_areas) return area_class(figure_, line);
    if (figure_.note.empty()) return "band " + curve(line);
    return opacity > 0.3 ? "band narrow c0" : "band c0";
  }

 private:
  const FigureData& data_;
  const Figure& figure_;
};

void write_fills(Html& html, const Figure& figure, const Classes& classes) {
  for (const FigureFill& fill : figure.fills) {
    html.open("path", {{"class", classes.fill(fill.line, fill.opacity)}, {"d", path_of(figure, fill)}});
    html.element("title", fill.name).close();
  }
}

void write_curves(Html& html, const Figure& figure, const Classes& classes) {
  for (const FigureCurve& curve : figure.curves)
    for (const results::FigureStretch& stretch : curve.stretches)
      html.empty("path",
                 {{"class", "line " + classes.curve(curve.line) + (stretch.unstable ? " unstable" : "")},
                  {"d", path_of(figure, curve, stretch)}});
  for (const results::FigureSymbol& symbol : figure.symbols) {
    const Outline shape = outline(symbol.kind.mark.shape);
    html.open("path", {{"class", "mark " + classes.curve(symbol.line) + (shape.is_filled ? " filled" : "")},
                       {"transform", "translate(" + place(figure, symbol.x, symbol.y) + ")"},
                       {"d", std::string(shape.path)}});
    html.element("title", symbol.kind.words).close();
  }
}

void write_swatch(Html& html, const FigureKeyEntry& entry, const Figure& figure, const Classes& classes) {
  constexpr std::string_view stroke = "M2 6H26", box = "M2 1H26V11H2Z";
  const bool is_curve = entry.of == FigureKeyEntry::Of::curve;
  const bool is_mark = entry.of == FigureKeyEntry::Of::mark;
  const Outline shape = outline(entry.kind.mark.shape);
  std::string name = "line unstable other";
  if (is_curve) name = "line " + classes.curve(entry.line);
  if (is_mark) name = std::string("mark other") + (shape.is_filled ? " filled" : "");
  if (entry.of == FigureKeyEntry::Of::fill) name = classes.fill(entry.line, entry.opacity);
  const std::string_view path = is_mark ? shape.path : entry.of == FigureKeyEntry::Of::fill ? box : stroke;
  if (is_curve && figure.note.empty())
    html.open("li", {{"data-line", std::to_string(entry.line)}});
  else
    html.open("li");
  html.open(
      "svg",
      {{"viewBox", is_mark ? "-14 -7 28 14" : "0 0 28 12"}, {"class", "swatch"}, {"aria-hidden", "true"}});
  html.empty("path", {{"class", name}, {"d", std::string(path)}}).close();
  html.write(entry.text).close();
}

void write_key(Html& html, const Figure& figure, const Classes& classes) {
  html.open("div", {{"class", "key"}});
  std::string parameters;
  for (const std::string& name : figure.key_title) parameters += (parameters.empty() ? "" : ", ") + name;
  if (!figure.note.empty()) html.element("p", figure.note + ".");
  if (!parameters.empty()) html.element("p", parameters + ":");
  html.open("ul");
  for (const FigureKeyEntry& entry : figure.key) write_swatch(html, entry, figure, classes);
  html.close().close();
}

}  // namespace

std::string area_class(const Figure& figure, std::size_t rank) {
  if (figure.classes == 0) return "area a" + std::to_string(rank);
  const std::size_t last = std::max<std::size_t>(figure.classes - 1, 1);
  return "area tile s" + std::to_string(rank * (sequence_steps - 1) / last);
}

std::string line_class(std::size_t line, std::size_t lines) {
  if (lines <= categories) return "c" + std::to_string(line);
  return "s" + std::to_string(line * (sequence_steps - 1) / (lines - 1));
}

void write_plain_curve(Html& html, const FigureData& data, const FigureView& view) {
  const FigureData fewer = thinned(data, coarse);
  const Figure figure = figures::figure_of(fewer, view);
  const Classes classes(fewer, figure);
  html.open("svg", {{"class", "plain"},
                    {"viewBox", "0 0 " + pixels(paper_width) + " " + pixels(paper_height)},
                    {"role", "img"},
                    {"aria-label", results::caption(fewer, view)}});
  if (!figure.are_areas) write_axes(html, figure);
  write_fills(html, figure, classes);
  write_curves(html, figure, classes);
  if (figure.are_areas) write_axes(html, figure);
  html.close();
  write_key(html, figure, classes);
}

}  // namespace arcslip::report
