#include <arcslip/report/parts.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::report {
namespace {

using results::Figure;
using results::FigureData;
using results::FigureLine;
using results::Record;

// Pixels of the drawing, and of its axes.
constexpr double paper_width = 760, paper_height = 400, frame_left = 78, frame_right = 744, frame_top = 14,
                 frame_bottom = 352;
constexpr double coarse = 4e-4;             // of the axes: a third of a pixel
constexpr std::size_t most_in_key = 24;     // lines
constexpr std::size_t categories = 8;       // colours that differ in kind
constexpr std::size_t sequence_steps = 16;  // colours in a sequence

struct Axes {
  PlainAxis x, y;

  bool shows(const Figure& figure, const Record& record) const {
    return x.shows(record[figure.x]) && y.shows(record[figure.y]);
  }
};

Axes axes_of(const FigureData& data, const Figure& figure) {
  const results::FigureColumn angle{"", results::Scale::linear, {0, 360}};
  const bool has_areas = !figure.areas.empty();
  return {PlainAxis(data.columns[figure.x], has_areas || figure.x == 0, frame_left, frame_right),
          PlainAxis(has_areas ? angle : data.columns[figure.y], has_areas, frame_bottom, frame_top)};
}

void write_axes(Html& html, const Figure& figure, const Axes& axes) {
  html.open("g", {{"class", "axis"}});
  const auto place = [](double at) { return pixels(at); };
  for (const Tick& tick : axes.x.ticks()) {
    const double at = axes.x.place(tick.value);
    html.empty("line", {{"class", "grid"},
                        {"x1", place(at)},
                        {"x2", place(at)},
                        {"y1", place(frame_top)},
                        {"y2", place(frame_bottom)}});
    html.element("text", tick.label,
                 {{"x", place(at)}, {"y", place(frame_bottom + 18)}, {"text-anchor", "middle"}});
  }
  for (const Tick& tick : axes.y.ticks()) {
    const double at = axes.y.place(tick.value);
    html.empty("line", {{"class", "grid"},
                        {"x1", place(frame_left)},
                        {"x2", place(frame_right)},
                        {"y1", place(at)},
                        {"y2", place(at)}});
    html.element("text", tick.label,
                 {{"x", place(frame_left - 8)}, {"y", place(at + 4)}, {"text-anchor", "end"}});
  }
  html.empty("path", {{"class", "frame"},
                      {"d", "M" + place(frame_left) + " " + place(frame_top) + "V" + place(frame_bottom) +
                                "H" + place(frame_right)}});
  html.element("text", figure.x_label,
               {{"class", "title"},
                {"x", place((frame_left + frame_right) / 2)},
                {"y", place(paper_height - 8)},
                {"text-anchor", "middle"}});
  html.element("text", figure.y_label,
               {{"class", "title"},
                {"transform", "translate(16 " + place((frame_top + frame_bottom) / 2) + ") rotate(-90)"},
                {"text-anchor", "middle"}});
  html.close();
}

std::string path_of(const std::vector<Record>& part, const Figure& figure, const Axes& axes) {
  std::string path;
  bool is_down = false;
  for (const Record& record : part) {
    const bool is_shown = axes.shows(figure, record);
    if (is_shown)
      path += (is_down ? "L" : "M") + pixels(axes.x.place(record[figure.x])) + " " +
              pixels(axes.y.place(record[figure.y]));
    is_down = is_shown;
  }
  return path;
}

void write_bands(Html& html, const FigureLine& line, const std::string& of, const Axes& axes) {
  for (const results::FigureBand& band : line.bands) {
    const double from = std::clamp(axes.x.place(band.range.lower), frame_left, frame_right),
                 to = std::clamp(axes.x.place(band.range.upper), frame_left, frame_right);
    html.open("rect", {{"class", "band " + of},
                       {"x", pixels(from)},
                       {"width", pixels(to - from)},
                       {"y", pixels(frame_top)},
                       {"height", pixels(frame_bottom - frame_top)}});
    html.element("title", band.label).close();
  }
}

void write_lines(Html& html, const FigureData& data, const Figure& figure, const Axes& axes) {
  const std::size_t count = data.lines.size();
  for (std::size_t i = 0; i < count && figure.x == 0; ++i)
    write_bands(html, data.lines[i], line_class(i, count), axes);
  for (std::size_t i = 0; i < count; ++i) {
    const FigureLine& line = data.lines[i];
    for (std::size_t k = 0; k < line.parts.size(); ++k) {
      const bool unstable = k < line.unstable.size() && line.unstable[k];
      html.empty("path", {{"class", "line " + line_class(i, count) + (unstable ? " unstable" : "")},
                          {"d", path_of(line.parts[k], figure, axes)}});
    }
    for (const results::FigureMark& mark : line.marks) {
      if (!axes.shows(figure, mark.record)) continue;
      const Outline shape = outline(mark.kind.mark.shape);
      html.open("path", {{"class", "mark " + line_class(i, count) + (shape.is_filled ? " filled" : "")},
                         {"transform", "translate(" + pixels(axes.x.place(mark.record[figure.x])) + " " +
                                           pixels(axes.y.place(mark.record[figure.y])) + ")"},
                         {"d", std::string(shape.path)}});
      html.element("title", mark.kind.words).close();
    }
  }
}

void write_areas(Html& html, const Figure& figure, const Axes& axes) {
  for (const results::FigureArea& area : figure.areas) {
    std::string path;
    for (const auto& strip : area.strips) {
      const char* command = "M";
      const auto add = [&](const Record& at, std::size_t end) {
        path += command + pixels(axes.x.place(at[0])) + " " + pixels(axes.y.place(at[end]));
        command = "L";
      };
      for (auto at = strip.begin(); at != strip.end(); ++at) add(*at, 1);
      for (auto at = strip.rbegin(); at != strip.rend(); ++at) add(*at, 2);
      path += "Z";
    }
    const auto* const kind = std::find(results::area_kinds.begin(), results::area_kinds.end(), area.kind);
    html.open("path",
              {{"class", "area a" + std::to_string(kind - results::area_kinds.begin())}, {"d", path}});
    html.element("title", area.kind).close();
  }
}

void write_swatch(Html& html, const std::string& of, std::string_view path, std::string_view label) {
  html.open("li").open("svg", {{"viewBox", "0 0 28 12"}, {"class", "swatch"}, {"aria-hidden", "true"}});
  html.empty("path", {{"class", of}, {"d", std::string(path)}}).close();
  html.write(label).close();
}

void write_key(Html& html, const FigureData& data, const Figure& figure) {
  constexpr std::string_view stroke = "M2 6H26";
  const std::size_t count = data.lines.size(), step = (count + most_in_key - 1) / most_in_key;
  html.open("div", {{"class", "key"}});
  std::string parameters;
  for (const std::string& name : data.parameters) parameters += (parameters.empty() ? "" : ", ") + name;
  if (!parameters.empty()) html.element("p", parameters + ":");
  html.open("ul");
  for (const results::FigureArea& area : figure.areas) {
    const auto* const kind = std::find(results::area_kinds.begin(), results::area_kinds.end(), area.kind);
    write_swatch(html, "area a" + std::to_string(kind - results::area_kinds.begin()), "M2 1H26V11H2Z",
                 area.kind);
  }
  bool unstable = false;
  for (std::size_t i = 0; i < count && figure.areas.empty(); ++i) {
    const FigureLine& line = data.lines[i];
    unstable = unstable || std::find(line.unstable.begin(), line.unstable.end(), true) != line.unstable.end();
    if (!line.label.empty() && i % step == 0)
      write_swatch(html, "line " + line_class(i, count), stroke,
                   line.label + (line.unbounded ? " (unbounded)" : ""));
  }
  if (unstable) write_swatch(html, "line unstable other", stroke, "unstable");
  for (const results::EventKind& kind : mark_kinds(data))
    if (const Outline shape = outline(kind.mark.shape); figure.areas.empty() && !shape.path.empty()) {
      html.open("li").open("svg",
                           {{"viewBox", "-14 -7 28 14"}, {"class", "swatch"}, {"aria-hidden", "true"}});
      html.empty("path", {{"class", std::string("mark other") + (shape.is_filled ? " filled" : "")},
                          {"d", std::string(shape.path)}});
      html.close().write(kind.words).close();
    }
  html.close().close();
}

}  // namespace

std::string line_class(std::size_t line, std::size_t lines) {
  if (lines <= categories) return "c" + std::to_string(line);
  return "s" + std::to_string(line * (sequence_steps - 1) / (lines - 1));
}

void write_plain_curve(Html& html, const FigureData& data, const Figure& figure) {
  const FigureData fewer = thinned(data, coarse);
  const Axes axes = axes_of(fewer, figure);
  html.open("svg", {{"class", "plain"},
                    {"viewBox", "0 0 " + pixels(paper_width) + " " + pixels(paper_height)},
                    {"role", "img"},
                    {"aria-label", figure.y_label + " over " + figure.x_label}});
  if (figure.areas.empty()) {
    write_axes(html, figure, axes);
    write_lines(html, fewer, figure, axes);
  } else {
    write_areas(html, figure, axes);
    write_axes(html, figure, axes);
  }
  html.close();
  write_key(html, data, figure);
}

}  // namespace arcslip::report
