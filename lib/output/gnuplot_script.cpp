#include <arcslip/output/gnuplot_script.hpp>

#include <arcslip/results/text.hpp>
#include <arcslip/results/version.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ostream>

namespace arcslip::output {
namespace {

using results::Figure;
using results::FigureAxis;
using results::FigureCurve;
using results::FigureFill;
using results::FigureKeyEntry;
using results::FigureStretch;
using results::FigureSymbol;
using results::shortest;

constexpr int longest_title = 64;  // characters across a figure of the usual width

/// A text in single quotes for gnuplot. Characters that are invalid in XML or unsafe for a terminal are
/// escaped (results/text.hpp).
std::string single_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : results::visible(text))
    if (c == '\'')
      result += R"('."'".')";  // gnuplot takes a doubled quote at the beginning for an empty text
    else
      result += c;
  return result + "'";
}

/// The first `longest` characters (UTF-8) of a text, followed by " ..." if it is longer.
std::string shortened(const std::string& text, int longest) {
  int characters = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool starts_character = (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80;
    if (starts_character && ++characters > longest) return text.substr(0, i) + " ...";
  }
  return text;
}

/// Without the rounding of units in the last digits, so that the tick at the end of an axis is there.
std::string rounded(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.10g", value);
  return text.data();
}

std::string quoted_lines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : ".\"\\n\".") + single_quoted(line);
  return text;
}

bool has_stretch(const FigureCurve& curve, bool unstable) {
  return std::any_of(curve.stretches.begin(), curve.stretches.end(),
                     [&](const FigureStretch& stretch) { return stretch.unstable == unstable; });
}

/// Returns the values of a fill on the axis of y; infinite ends are those of the axis.
double end_of(const FigureAxis& y, double value) {
  return std::isfinite(value) ? value : (value < 0 ? y.range.lower : y.range.upper) / y.factor;
}

void write_axis(std::ostream& out, char name, const FigureAxis& axis) {
  out << (axis.logarithmic ? "set logscale " : "unset logscale ") << name
      << (axis.logarithmic ? " 10\n" : "\n") << "set " << name << "label " << single_quoted(axis.label)
      << " noenhanced\n"
      << "set " << name << "range [" << rounded(axis.range.lower) << ":" << rounded(axis.range.upper) << "]\n"
      << "set " << name << "tics (";
  const char* separator = "";
  for (const results::FigureTick& tick : axis.ticks) {
    out << separator << single_quoted(tick.label) << " " << rounded(tick.value)
        << (tick.label.empty() ? " 1" : "");
    separator = ", ";
  }
  out << ")\n";
}

/// "($1*1000)", or the column itself.
std::string column(int number, double factor) {
  return factor == 1 ? std::to_string(number) : "($" + std::to_string(number) + "*" + shortest(factor) + ")";
}

std::string point_style(const results::Mark& mark) {
  std::string text = "pointtype " + std::to_string(static_cast<int>(mark.shape));
  text += " pointsize " + shortest(mark.size);
  return mark.line_width > 0 ? text + " linewidth " + shortest(mark.line_width) : text;
}

std::string fill_style(const std::string& colour, double opacity) {
  return "fillcolor rgb '" + colour + "' fillstyle transparent solid " + shortest(opacity) + " noborder";
}

std::string key_entry(const FigureKeyEntry& entry) {
  const std::string title = " title " + single_quoted(entry.text) + " noenhanced",
                    colour = " linecolor rgb '" + entry.colour + "'";
  switch (entry.of) {
    case FigureKeyEntry::Of::curve:
      return "NaN with lines linewidth 2" + colour + title;
    case FigureKeyEntry::Of::unstable:
      return "NaN with lines linewidth 2 dashtype (8,5)" + colour + title;
    case FigureKeyEntry::Of::mark:
      return "NaN with points " + point_style(entry.kind.mark) + colour + title;
    case FigureKeyEntry::Of::fill:
      break;
  }
  return "NaN with filledcurves " + fill_style(entry.colour, entry.opacity) + title;
}

/// The plot of a figure, whose first block of data has this index. Returns that of the next figure.
int write_plot(std::ostream& out, const Figure& figure, int index) {
  const std::string point = column(1, figure.x.factor) + ":" + column(2, figure.y.factor);
  std::vector<std::string> fills, curves;
  for (const FigureCurve& curve : figure.curves)
    for (const bool unstable : {false, true})
      if (has_stretch(curve, unstable))
        curves.push_back("data index " + std::to_string(index++) + " using " + point +
                         " with lines linewidth " + shortest(curve.width) +
                         (unstable ? " dashtype (8,5)" : "") + " linecolor rgb '" + curve.colour +
                         "' notitle");
  for (const FigureSymbol& symbol : figure.symbols)
    curves.push_back("data index " + std::to_string(index++) + " using " + point + " with points " +
                     point_style(symbol.kind.mark) + " linecolor rgb '" + symbol.colour + "' notitle");
  for (const FigureFill& fill : figure.fills)
    fills.push_back("data index " + std::to_string(index++) + " using " + column(1, figure.x.factor) + ":" +
                    column(2, figure.y.factor) + ":" + column(3, figure.y.factor) + " with filledcurves " +
                    fill_style(fill.colour, fill.opacity) + " notitle");
  fills.insert(fills.end(), curves.begin(), curves.end());
  for (const FigureKeyEntry& entry : figure.key) fills.push_back(key_entry(entry));
  const char* separator = "plot ";
  for (const std::string& each : fills) {
    out << separator << each;
    separator = ", \\\n     ";
  }
  out << '\n';
  return index;
}

void write_texts(std::ostream& out, const Figure& figure) {
  for (const results::FigureText& text : figure.texts)
    out << "set label " << single_quoted(text.text) << " at " << shortest(text.x * figure.x.factor) << ","
        << shortest(text.y * figure.y.factor)
        << (text.alignment == 0 ? " center" : (text.alignment > 0 ? " left" : " right")) << " offset "
        << shortest(text.right) << "," << shortest(text.up) << " front noenhanced font ',13' textcolor rgb '"
        << text.colour << "'\n";
}

/// The characters of a title over the middle of the axes, which a wide key at their side moves to the left.
int room_for_title(const Figure& figure) {
  constexpr int across = 96, least = 24;  // characters
  constexpr double of_key = 1.3;          // of a title, for a character of the key
  std::size_t longest = 0;
  for (const FigureKeyEntry& entry : figure.key) longest = std::max(longest, entry.text.size());
  const int room = across - static_cast<int>(of_key * static_cast<double>(longest + 6));
  return std::clamp(room, least, longest_title);
}

/// The names of the parameters, one a line, and room for the longest: gnuplot reserves none for the title of
/// a key.
void write_key_title(std::ostream& out, const Figure& figure) {
  std::size_t longest_entry = 0, longest_name = 0;
  for (const FigureKeyEntry& entry : figure.key) longest_entry = std::max(longest_entry, entry.text.size());
  for (const std::string& name : figure.key_title) longest_name = std::max(longest_name, name.size());
  const std::size_t entry = longest_entry + 4;  // with its piece of line
  if (figure.key_title.empty())
    out << "set key title ''\nset key width 1\n";  // off the edge
  else
    out << "set key title " << quoted_lines(figure.key_title) << " noenhanced left\nset key width "
        << (longest_name > entry ? longest_name - entry : 0) << '\n';
}

/// Returns how an image of a format begins.
std::string terminal(const std::string& format, const results::FigureStyle& style) {
  constexpr double finer = 1.5, points = 72.0 / 96;
  const auto size = [&](double factor, const char* unit) {
    return shortest(factor * style.width) + unit + "," + shortest(factor * style.height) + unit;
  };
  if (format == "pdf") return "pdfcairo size " + size(points / 72, "in") + " font 'Sans,11' dashlength 0.5";
  if (format == "png")
    return "pngcairo size " + size(finer, "") +
           " font 'Sans,15' fontscale 1.2 linewidth 1.5 pointscale 1.5 dashlength 0.5";
  return "svg size " + size(1, "") + " font 'Helvetica,15' background rgb 'white' dashlength 0.5";
}

void write_record(std::ostream& out, std::initializer_list<double> values) {
  const char* separator = "";
  for (const double value : values) {
    out << separator << shortest(value);
    separator = " ";
  }
  out << '\n';
}

void write_curve(std::ostream& out, const FigureCurve& curve) {
  out << "# " << results::visible(curve.heading) << '\n';
  for (const bool unstable : {false, true}) {
    if (!has_stretch(curve, unstable)) continue;
    if (unstable) out << "# unstable\n";
    for (const FigureStretch& stretch : curve.stretches) {
      if (stretch.unstable != unstable) continue;
      for (std::size_t i = stretch.first; i < stretch.first + stretch.count; ++i)
        write_record(out, {curve.x[i], curve.y[i]});
      out << '\n';
    }
    out << '\n';
  }
}

}  // namespace

void write_figure_data(std::ostream& out, std::span<const Figure> figures) {
  for (const Figure& figure : figures) {
    out << "# " << figure.name << ": " << figure.y.label << " over " << figure.x.label
        << ", both without the prefixes of their units\n";
    for (const FigureCurve& curve : figure.curves) write_curve(out, curve);
    for (const FigureSymbol& symbol : figure.symbols) {
      out << "# " << symbol.kind.words << '\n';
      write_record(out, {symbol.x, symbol.y});
      out << "\n\n";
    }
    for (const FigureFill& fill : figure.fills) {
      out << "# from and to: " << results::visible(fill.name) << '\n';
      for (const auto& strip : fill.strips) {
        for (const auto& at : strip)
          write_record(out, {at[0], end_of(figure.y, at[1]), end_of(figure.y, at[2])});
        out << '\n';
      }
      out << '\n';
    }
  }
}

void write_gnuplot_script(std::ostream& out, std::span<const Figure> figures, const std::string& name,
                          const std::vector<std::string>& images, const std::vector<std::string>& formats,
                          const results::FigureStyle& style) {
  out << "# Made by arcslip " << results::version() << ". Draws the figures again: gnuplot -d " << name
      << ".gp\n"
      << "if (!exists('suffix')) suffix = ''\n"
      << "data = '" << name << ".dat'\n"
      << "set encoding utf8\n"
      << "set border 3 back linewidth 1 linecolor rgb '#333333'\n"
      << "set tics nomirror out scale 0.8,0.4\n"
      << "set grid xtics ytics back linetype 1 linewidth 0.5 linecolor rgb '#dddddd'\n"
      << "set key outside right center vertical Left reverse samplen 3.5 spacing 1.2 noenhanced\n";
  int index = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Figure& figure = figures[i];
    out << "\n# " << images[i] << '\n';
    std::vector<std::string> title = {shortened(figure.title, room_for_title(figure))};
    if (!figure.note.empty()) title.push_back(figure.note);
    out << "set title " << quoted_lines(title) << " noenhanced font ',16'\n";
    write_key_title(out, figure);
    write_axis(out, 'x', figure.x);
    write_axis(out, 'y', figure.y);
    out << "unset label\n";
    write_texts(out, figure);
    int next = index;
    for (const std::string& format : formats) {
      out << "set terminal " << terminal(format, style) << "\nset output '" << images[i] << "." << format
          << "'.suffix\n";
      if (&format == &formats.front())
        next = write_plot(out, figure, index);
      else
        out << "replot\n";
      out << "unset output\n";
    }
    index = next;
  }
}

}  // namespace arcslip::output
