#include <arcslip/output/gnuplot_script.hpp>

#include <arcslip/output/figure_labels.hpp>
#include <arcslip/output/figures.hpp>
#include <arcslip/output/gnuplot_axes.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/results/version.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <utility>

namespace arcslip::output {
namespace {

namespace event_kinds = observables::event_kinds;

using results::EventKind;
using results::Figure;
using results::FigureArea;
using results::FigureBand;
using results::FigureColumn;
using results::FigureData;
using results::FigureLine;
using results::FigureMark;
using results::Record;
using results::shortest;

constexpr int longest_title = 76;                // characters across a figure
constexpr std::size_t most_in_key = 24;          // lines that a key has room for
constexpr const char* other_colour = "#444444";  // in the key, of what lines of several colours have

void write_record(std::ostream& out, const Record& values) {
  const char* separator = "";
  for (const double value : values) {
    out << separator << shortest(value);
    separator = " ";
  }
  out << '\n';
}

/// Writes what has an axis.
void write_record(std::ostream& out, const FigureData& data, const Record& values) {
  Record shown;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (data.columns[i].has_axis) shown.push_back(values[i]);
  write_record(out, shown);
}

/// Returns the number of a column in the file of data, from 1.
std::string column_number(const FigureData& data, std::size_t column) {
  const auto last = data.columns.begin() + static_cast<std::ptrdiff_t>(column) + 1;
  return std::to_string(
      std::count_if(data.columns.begin(), last, [](const FigureColumn& each) { return each.has_axis; }));
}

/// Returns how points of a mark are drawn.
std::string point_style(const results::Mark& mark) {
  std::string text = "pointtype " + std::to_string(static_cast<int>(mark.shape));
  text += " pointsize " + shortest(mark.size);
  return mark.line_width > 0 ? text + " linewidth " + shortest(mark.line_width) : text;
}

/// Returns the kinds of the marks: those of the table in its order, then others as the lines have them.
std::vector<EventKind> mark_kinds(const FigureData& data) {
  const auto rank = [](const EventKind& kind) {
    return std::find(event_kinds::all.begin(), event_kinds::all.end(), kind) - event_kinds::all.begin();
  };
  std::vector<EventKind> kinds;
  for (const FigureLine& line : data.lines)
    for (const FigureMark& mark : line.marks)
      if (!event_kinds::contains(kinds, mark.kind.name)) kinds.push_back(mark.kind);
  std::stable_sort(kinds.begin(), kinds.end(),
                   [&](const EventKind& a, const EventKind& b) { return rank(a) < rank(b); });
  return kinds;
}

/// Colours of the areas, in the order of area_kinds: alike where two kinds never meet.
constexpr std::array<const char*, results::area_kinds.size()> area_colours = {
    "#46039f", "#ed7953", "#ed7953", "#fdb42f", "#ececec", "#46039f", "#7e03a8", "#cc4778"};

constexpr double band_opacity = 0.12;

/// Style of the k-th band of a line, from 0: narrower bands are drawn over wider ones.
std::string band_style(std::size_t k, const std::string& colour) {
  const double opacity = 1 - std::pow(1 - band_opacity, static_cast<double>(k + 1));
  return "fillcolor rgb '" + colour + "' fillstyle transparent solid " + shortest(opacity) + " noborder";
}

/// The lines in axis coordinates from 0 to 1, to keep labels off them.
std::vector<std::vector<Position>> places(const FigureData& data, const Figure& figure, const Axes& axes) {
  std::vector<std::vector<Position>> lines;
  for (const FigureLine& line : data.lines) {
    for (const std::vector<Record>& part : line.parts) {
      std::vector<Position>& path = lines.emplace_back();
      for (const Record& values : part)
        if (axes.shows(values, figure)) path.push_back(axes.place(values, figure));
    }
  }
  return lines;
}

/// Labels at the marks, where there is room.
void write_labels(std::ostream& out, const FigureData& data, const Figure& figure, const Axes& axes) {
  struct Label {
    double x, y;
    std::size_t line;
  };
  std::vector<LabelWish> wishes;
  std::vector<Label> labels;
  for (std::size_t i = 0; i < data.lines.size(); ++i) {
    for (const FigureMark& mark : data.lines[i].marks) {
      const results::Mark& shown = mark.kind.mark;
      std::string label = mark.label.empty() ? std::string(shown.label) : mark.label;
      if (label.empty()) label = data.lines[i].label;
      if (shown.labelled && axes.shows(mark.record, figure) && !label.empty()) {
        wishes.push_back({axes.place(mark.record, figure), label});
        labels.push_back({mark.record[figure.x], mark.record[figure.y], i});
      }
    }
  }
  const std::vector<LabelSide> sides = place_labels(wishes, places(data, figure, axes));
  out << "unset label\n";
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (sides[i] == LabelSide::none) continue;
    const LabelOffset shift = offset(sides[i]);
    out << "set label " << single_quoted(wishes[i].text) << " at " << shortest(labels[i].x) << ","
        << shortest(labels[i].y)
        << (shift.alignment == 0 ? " center" : (shift.alignment > 0 ? " left" : " right")) << " offset "
        << shortest(shift.x) << "," << shortest(shift.y) << " front noenhanced font ',13' textcolor rgb '"
        << line_colour(labels[i].line, data.lines.size()) << "'\n";
  }
}

/// Bands behind the lines, if the figure is over their parameter.
void write_bands(std::ostream& out, const FigureData& data, const Figure& figure) {
  out << "unset object\n";
  if (figure.x != 0) return;
  for (std::size_t i = 0; i < data.lines.size(); ++i) {
    for (const FigureBand& band : data.lines[i].bands) {
      out << "set object rectangle from " << shortest(band.range.lower) << ", graph 0 to "
          << shortest(band.range.upper) << ", graph 1 behind "
          << band_style(0, line_colour(i, data.lines.size())) << '\n';
    }
  }
}

/// The names of the parameters, one a line, and room for the longest: gnuplot reserves none for the title of
/// a key.
void write_key_title(std::ostream& out, const FigureData& data) {
  if (data.parameters.empty()) {
    out << "set key width 1\n";  // off the edge
    return;
  }
  std::size_t longest_entry = 0;
  for (const FigureLine& line : data.lines) longest_entry = std::max(longest_entry, line.label.size());
  std::size_t longest_name = 0;
  out << "set key title ";
  const char* separator = "";
  for (const std::string& name : data.parameters) {
    out << separator << single_quoted(name);
    separator = ".\"\\n\".";
    longest_name = std::max(longest_name, name.size());
  }
  const std::size_t entry = longest_entry + 4;  // with its piece of line
  out << " noenhanced left\nset key width " << (longest_name > entry ? longest_name - entry : 0) << '\n';
}

/// Whether a line has parts that are unstable, or others.
bool has_parts(const FigureLine& line, bool unstable) {
  for (std::size_t i = 0; i < line.parts.size(); ++i)
    if ((i < line.unstable.size() && line.unstable[i]) == unstable) return true;
  return false;
}

bool any_unstable(const FigureData& data) {
  return std::any_of(data.lines.begin(), data.lines.end(),
                     [](const FigureLine& line) { return has_parts(line, true); });
}

bool has_mark(const FigureLine& line, const EventKind& kind) {
  return std::any_of(line.marks.begin(), line.marks.end(),
                     [&](const FigureMark& mark) { return mark.kind == kind; });
}

/// Whether a line, or its marks of a kind, has anything to draw in a figure.
bool is_in(const Figure& figure, const Record& values) {
  return std::isfinite(values[figure.x]) && std::isfinite(values[figure.y]);
}

bool is_in(const Figure& figure, const FigureLine& line) {
  return std::any_of(line.parts.begin(), line.parts.end(), [&](const std::vector<Record>& part) {
    return std::any_of(part.begin(), part.end(), [&](const Record& values) { return is_in(figure, values); });
  });
}

bool is_in(const Figure& figure, const FigureLine& line, const EventKind& kind) {
  return std::any_of(line.marks.begin(), line.marks.end(),
                     [&](const FigureMark& mark) { return mark.kind == kind && is_in(figure, mark.record); });
}

/// The blocks of the data before the areas.
int blocks_of_lines(const FigureData& data) {
  const std::vector<EventKind> kinds = mark_kinds(data);
  int blocks = 0;
  for (const FigureLine& line : data.lines) {
    blocks += (has_parts(line, false) ? 1 : 0) + (has_parts(line, true) ? 1 : 0);
    for (const EventKind& kind : kinds) blocks += has_mark(line, kind) ? 1 : 0;
  }
  return blocks;
}

/// first: the block of the first area.
void write_areas(std::ostream& out, const Figure& figure, int first) {
  const char* separator = "plot ";
  for (const FigureArea& area : figure.areas) {
    const auto kind = std::find(results::area_kinds.begin(), results::area_kinds.end(), area.kind);
    const auto rank = static_cast<std::size_t>(kind - results::area_kinds.begin());
    out << separator << "data index " << first++ << " using 1:2:3 with filledcurves fillcolor rgb '"
        << area_colours.at(rank) << "' fillstyle solid 1 noborder title " << single_quoted(area.kind)
        << " noenhanced";
    separator = ", \\\n     ";
  }
  out << '\n';
}

/// Key entries of the bands, narrowest first, from one line, as all lines have the same.
void add_bands_to_key(const FigureData& data, std::vector<std::string>& curves) {
  const auto has_bands = [](const FigureLine& line) { return !line.bands.empty(); };
  const auto line = std::find_if(data.lines.begin(), data.lines.end(), has_bands);
  if (line == data.lines.end()) return;
  const std::string colour = data.lines.size() == 1 ? line_colour(0, 1) : other_colour;
  for (std::size_t k = line->bands.size(); k-- > 0;) {
    curves.push_back("NaN with filledcurves " + band_style(k, colour) + " title " +
                     single_quoted(line->bands[k].label) + " noenhanced");
  }
}

void write_plot(std::ostream& out, const FigureData& data, const Figure& figure) {
  const std::string columns = " using " + column_number(data, figure.x) + ":" + column_number(data, figure.y);
  const std::size_t count = data.lines.size();
  const std::size_t key_step = (count + most_in_key - 1) / most_in_key;
  std::vector<std::string> curves;
  std::vector<std::string> marks;
  const std::vector<EventKind> kinds = mark_kinds(data);
  int index = 0;
  const bool with_stability = any_unstable(data);
  for (std::size_t i = 0; i < count; ++i) {
    const FigureLine& line = data.lines[i];
    const std::string paint = " linecolor rgb '" + line_colour(i, count) + "'";
    const bool in_key = !line.label.empty() && i % key_step == 0 && is_in(figure, line);
    const std::string title = line.label + (line.unbounded ? " (unbounded)" : "");
    bool titled = !in_key;
    for (const bool unstable : {false, true}) {
      if (!has_parts(line, unstable)) continue;
      // Dashes tell stability where any line has it.
      const std::string dash = unstable ? "(8,5)" : with_stability ? "1" : line_dash(i);
      curves.push_back(
          "data index " + std::to_string(index++) + columns + " with lines linewidth 2 dashtype " + dash +
          paint +
          (std::exchange(titled, true) ? " notitle" : " title " + single_quoted(title) + " noenhanced"));
    }
    for (const EventKind& kind : kinds)
      if (has_mark(line, kind))
        marks.push_back("data index " + std::to_string(index++) + columns + " with points " +
                        point_style(kind.mark) + paint + " notitle");
  }
  curves.insert(curves.end(), marks.begin(), marks.end());
  if (with_stability)
    curves.push_back(std::string("NaN with lines linewidth 2 dashtype (8,5) linecolor rgb '") + other_colour +
                     "' title 'unstable'");
  for (const EventKind& kind : kinds)
    if (std::any_of(data.lines.begin(), data.lines.end(),
                    [&](const FigureLine& line) { return is_in(figure, line, kind); }))
      curves.push_back("NaN with points " + point_style(kind.mark) + " linecolor rgb '" + other_colour +
                       "' title " + single_quoted(std::string(kind.words)));
  if (figure.x == 0) add_bands_to_key(data, curves);
  out << "plot ";
  const char* separator = "";
  for (const std::string& curve : curves) {
    out << separator << curve;
    separator = ", \\\n     ";
  }
  out << '\n';
}

}  // namespace

std::vector<std::string> image_names(const FigureData& data, const std::string& name) {
  std::vector<std::string> names;
  for (const Figure& figure : data.figures) {
    std::string own = name + "_" + file_name(figure.name);
    if (std::find(names.begin(), names.end(), own) != names.end())  // differs only in what it cannot hold
      own += "_" + std::to_string(names.size());
    names.push_back(own);
  }
  return names;
}

void write_figure_data(std::ostream& out, const FigureData& data) {
  const char* separator = "# ";
  for (const FigureColumn& column : data.columns) {
    if (!column.has_axis) continue;
    out << separator << results::visible(column.label);
    separator = ", ";
  }
  out << '\n';
  const std::vector<EventKind> kinds = mark_kinds(data);
  for (const FigureLine& line : data.lines) {
    out << "# " << line.heading << '\n';
    for (const bool unstable : {false, true}) {
      if (!has_parts(line, unstable)) continue;
      if (unstable) out << "# unstable\n";
      for (std::size_t i = 0; i < line.parts.size(); ++i) {
        if ((i < line.unstable.size() && line.unstable[i]) != unstable) continue;
        for (const Record& values : line.parts[i]) write_record(out, data, values);
        out << '\n';
      }
      out << '\n';
    }
    for (const EventKind& kind : kinds) {
      bool any = false;
      for (const FigureMark& mark : line.marks) {
        if (mark.kind == kind) {
          write_record(out, data, mark.record);
          any = true;
        }
      }
      out << (any ? "\n\n" : "");
    }
  }
  for (const Figure& figure : data.figures) {
    for (const FigureArea& area : figure.areas) {
      out << "# " << figure.x_label << ", from and to: " << results::visible(figure.y_label) << ", "
          << area.kind << '\n';
      for (const auto& strip : area.strips) {
        for (const Record& values : strip) write_record(out, values);
        out << '\n';
      }
      out << '\n';
    }
  }
}

void write_gnuplot_script(std::ostream& out, const FigureData& data, const std::string& name,
                          const std::vector<std::string>& images) {
  out << "# Made by arcslip " << results::version() << ". Draws the figures again: gnuplot -d " << name
      << ".gp\n"
      << "if (!exists('suffix')) suffix = ''\n"
      << "data = '" << name << ".dat'\n"
      << "set encoding utf8\n"
      << "set title " << single_quoted(shortened(data.title, longest_title)) << " noenhanced font ',16'\n"
      << "set border 3 back linewidth 1 linecolor rgb '#333333'\n"
      << "set tics nomirror out scale 0.8,0.4\n"
      << "set grid xtics ytics back linetype 1 linewidth 0.5 linecolor rgb '#dddddd'\n"
      << "set key outside right center vertical Left reverse samplen 3.5 spacing 1.2 noenhanced\n";
  write_key_title(out, data);
  int next_area = blocks_of_lines(data);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Figure& figure = data.figures[i];
    const std::string& image = images[i];
    const Axes axes = axes_of(data, figure);
    out << "\n# " << image << '\n';
    write_axes(out, figure, axes);
    if (figure.areas.empty()) {
      write_bands(out, data, figure);
      write_labels(out, data, figure, axes);
    } else {
      out << "unset object\nunset label\n";
    }
    out << "set terminal svg size 800,500 font 'Helvetica,15' background rgb 'white' dashlength 0.5\n"
        << "set output '" << image << ".svg'.suffix\n";
    if (figure.areas.empty())
      write_plot(out, data, figure);
    else
      write_areas(out, figure, next_area);
    next_area += static_cast<int>(figure.areas.size());
    out << "set terminal pngcairo size 1600,1000 font 'Sans,15' fontscale 1.6 linewidth 2 pointscale 2 "
           "dashlength 0.5\n"
        << "set output '" << image << ".png'.suffix\n"
        << "replot\n"
        << "unset output\n";
  }
}

}  // namespace arcslip::output
