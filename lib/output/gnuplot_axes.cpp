#include <arcslip/output/gnuplot_axes.hpp>

#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <vector>

namespace arcslip::output {

std::string single_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : results::visible(text))
    if (c == '\'')
      result += R"('."'".')";  // gnuplot takes a doubled quote at the beginning for an empty text
    else
      result += c;
  return result + "'";
}

std::string shortened(const std::string& text, int longest) {
  int characters = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool starts_character = (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80;
    if (starts_character && ++characters > longest) return text.substr(0, i) + " ...";
  }
  return text;
}

std::string line_colour(std::size_t line, std::size_t lines) {
  constexpr std::array<std::array<int, 3>, 7> anchors{{{13, 8, 135},
                                                       {84, 2, 163},
                                                       {139, 10, 165},
                                                       {185, 50, 137},
                                                       {219, 92, 104},
                                                       {228, 112, 72},
                                                       {226, 138, 24}}};
  const double place = lines > 1 ? static_cast<double>(line) / static_cast<double>(lines - 1) *
                                       static_cast<double>(anchors.size() - 1)
                                 : 0.0;
  const auto lower = std::min(static_cast<std::size_t>(place), anchors.size() - 2);
  const double share = place - static_cast<double>(lower);
  std::array<char, 8> text{};
  std::array<unsigned, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i) {
    rgb[i] =
        static_cast<unsigned>(std::lround((1 - share) * anchors[lower][i] + share * anchors[lower + 1][i])) &
        0xffu;
  }
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", rgb[0], rgb[1], rgb[2]);
  return text.data();
}

std::string line_dash(std::size_t line) {
  constexpr std::array<const char*, 4> dashes{"solid", "(14,5)", "(4,4)", "(14,4,3,4)"};
  return dashes[line % dashes.size()];
}

namespace {

/// Without the rounding of units in the last digits, so that the tic at the end of an axis is there.
std::string rounded(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.10g", value);
  return text.data();
}

/// Tics of a logarithmic axis: decades, or 1, 2, 5 where there are few of them.
void write_logarithmic_tics(std::ostream& out, char axis, const results::Range& range) {
  const double decades = std::log10(range.upper / range.lower);
  if (decades > 2.5) {
    out << "set " << axis << "tics " << (decades > 12 ? "1e3" : "10") << "\nset m" << axis
        << "tics 10\nset format " << axis << " '10^{%T}'\n";
    return;
  }
  const std::vector<double> fine{1, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 9};
  const std::vector<double> coarse{1, 2, 5};
  out << "set " << axis << "tics (";
  const char* separator = "";
  for (int exponent = static_cast<int>(std::floor(std::log10(range.lower)));
       exponent <= static_cast<int>(std::ceil(std::log10(range.upper))); ++exponent) {
    for (const double digit : decades > 0.7 ? coarse : fine) {
      const double value = digit * std::pow(10.0, exponent);
      if (value >= range.lower && value <= range.upper) {
        out << separator << rounded(value);
        separator = ", ";
      }
    }
  }
  out << ")\nset format " << axis << " '%g'\n";
}

/// The axis of a column: just its range, or with room at both ends, of which the upper one may hold labels,
/// and the lower one where there are minima.
Axis axis_of(const results::FigureColumn& column, bool has_room, bool has_minima = false) {
  const double parts_below = has_minima ? 2 : 1;
  if (column.scale == results::Scale::percent) return {{-3, 103}};
  const auto [lower, upper] = column.range;
  if (!(lower <= upper)) return {{-1, 1}};
  if (column.scale == results::Scale::logarithmic) {
    if (!has_room && lower < upper) return {column.range, true};
    const double spread = std::pow(upper / lower, 0.05);
    return {{lower / std::max(std::pow(spread, parts_below), 1.05), upper * std::max(spread * spread, 1.15)},
            true};
  }
  if (upper - lower <= 1e-8 * std::max(std::abs(lower), std::abs(upper))) {  // but for rounding one value
    const double width = lower == 0 ? 1 : std::max(std::abs(lower), 1e-300) / 10;
    return {{lower - width, upper + width}};
  }
  const double room = has_room ? 0.05 * (upper - lower) : 0;
  return {{lower - parts_below * room, upper + 2 * room}};
}

void write_axis(std::ostream& out, char name, const std::string& label, const Axis& axis) {
  out << (axis.logarithmic ? "set logscale " : "unset logscale ") << name
      << (axis.logarithmic ? " 10\n" : "\n") << "set " << name << "label " << single_quoted(label)
      << " noenhanced\n"
      << "set " << name << "range [" << rounded(axis.range.lower) << ":" << rounded(axis.range.upper)
      << "]\n";
  if (axis.logarithmic)
    write_logarithmic_tics(out, name, axis.range);
  else
    out << "set " << name << "tics autofreq\nunset m" << name << "tics\nset format " << name << " '%g'\n";
}

}  // namespace

bool Axis::shows(double value) const {
  return std::isfinite(value) && !(logarithmic && value <= 0);
}

double Axis::place(double value) const {
  return logarithmic ? std::log(value / range.lower) / std::log(range.upper / range.lower)
                     : (value - range.lower) / (range.upper - range.lower);
}

bool Axes::shows(const results::Record& values, const results::Figure& figure) const {
  return x.shows(values[figure.x]) && y.shows(values[figure.y]);
}

Position Axes::place(const results::Record& values, const results::Figure& figure) const {
  return {x.place(values[figure.x]), y.place(values[figure.y])};
}

Axes axes_of(const results::FigureData& data, const results::Figure& figure) {
  const auto has_minimum = [](const results::FigureLine& line) {
    return std::any_of(line.marks.begin(), line.marks.end(), [](const results::FigureMark& mark) {
      return mark.kind == observables::event_kinds::minimum;
    });
  };
  const bool has_minima = std::any_of(data.lines.begin(), data.lines.end(), has_minimum);
  if (!figure.areas.empty()) return {axis_of(data.columns[figure.x], false), {{0, 360}}};
  // What a study goes over fills its axis; in a curve of folds it is the result that the frequency shows.
  return {axis_of(data.columns[figure.x], figure.x != 0), axis_of(data.columns[figure.y], true, has_minima)};
}

void write_axes(std::ostream& out, const results::Figure& figure, const Axes& axes) {
  write_axis(out, 'x', figure.x_label, axes.x);
  write_axis(out, 'y', figure.y_label, axes.y);
  if (!figure.areas.empty()) out << "set ytics 90\n";
}

}  // namespace arcslip::output
