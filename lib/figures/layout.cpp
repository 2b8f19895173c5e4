#include <arcslip/figures/layout.hpp>
#include <arcslip/figures/parts.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace arcslip::figures {
namespace {

namespace event_kinds = observables::event_kinds;

using results::EventKind;
using results::Figure;
using results::FigureCurve;
using results::FigureData;
using results::FigureKeyEntry;
using results::FigureLine;
using results::FigureMark;
using results::FigureStyle;
using results::FigureSymbol;
using results::FigureView;
using results::Record;

constexpr std::size_t most_in_key = 24;          // lines that a key has room for
constexpr const char* main_colour = "#111111";   // of a main curve
constexpr const char* other_colour = "#444444";  // in the key, of what lines of several colours have
constexpr double band_opacity = 0.12;
constexpr double rounding_of_ticks = 1e-9;

/// Colours of the areas, in the order of area_kinds: alike where two kinds never meet.
constexpr std::array<const char*, results::area_kinds.size()> area_colours = {
    "#46039f", "#ed7953", "#ed7953", "#fdb42f", "#ececec", "#46039f", "#7e03a8", "#cc4778"};

std::string colour_of(const FigureData& data, std::size_t line, const FigureStyle& style) {
  return data.lines[line].is_main ? main_colour : line_colour(line, data.lines.size(), style.is_grey);
}

void set_axes(const FigureData& data, const FigureView& view, Figure& figure) {
  const auto has_minimum = [](const FigureLine& line) {
    return std::any_of(line.marks.begin(), line.marks.end(),
                       [](const FigureMark& mark) { return mark.kind == event_kinds::minimum; });
  };
  const bool has_minima = std::any_of(data.lines.begin(), data.lines.end(), has_minimum);
  // What a study goes over fills its axis; in a curve of folds it is the result that the frequency shows.
  figure.x = axis_of(data.columns[view.x], results::x_words(data, view), figure.are_areas || view.x == 0);
  figure.y = !view.areas.empty()
                 ? angle_axis(results::y_words(data, view))
                 : axis_of(data.columns[view.y], results::y_words(data, view), figure.are_areas, has_minima);
}

void add_areas(const FigureView& view, Figure& figure) {
  for (const results::FigureArea& area : view.areas) {
    const auto* const kind = std::find(results::area_kinds.begin(), results::area_kinds.end(), area.kind);
    const auto rank = static_cast<std::size_t>(kind - results::area_kinds.begin());
    figure.fills.push_back({area.kind, area_colours.at(rank), 1, rank, area.strips});
    figure.key.push_back(
        {.of = FigureKeyEntry::Of::fill, .text = area.kind, .colour = area_colours.at(rank), .line = rank});
  }
}

/// Tiles in classes of their values, from tick to tick of an axis of these.
void add_tiles(const FigureView& view, const FigureStyle& style, Figure& figure) {
  const results::FigureAxis axis = axis_of(view.value, view.value.words, true);
  const auto label = [&](double value) { return results::to_digits(value, 6); };
  const double step =
      axis.ticks.size() > 1 ? axis.ticks[1].value - axis.ticks[0].value : axis.range.upper - axis.range.lower;
  const double first = step * std::floor(axis.factor * view.value.range.lower / step + rounding_of_ticks);
  const auto classes = static_cast<std::size_t>(
      std::max(1.0, std::ceil((axis.factor * view.value.range.upper - first) / step - rounding_of_ticks)));
  figure.classes = classes;
  figure.key_title = {axis.label};
  figure.note = view.note;
  for (std::size_t k = 0; k < classes; ++k) {
    const double from = first + static_cast<double>(k) * step;
    results::FigureFill fill{
        label(from) + " to " + label(from + step), line_colour(k, classes, style.is_grey), 1, k, {}};
    for (const results::FigureTile& tile : view.tiles) {
      const double place = std::floor((axis.factor * tile.value - first) / step);
      if (std::clamp(place, 0.0, static_cast<double>(classes - 1)) == static_cast<double>(k))
        fill.strips.push_back({{tile.left, tile.lower, tile.upper}, {tile.right, tile.lower, tile.upper}});
    }
    figure.key.push_back(
        {.of = FigureKeyEntry::Of::fill, .text = fill.name, .colour = fill.colour, .line = k});
    if (!fill.strips.empty()) figure.fills.push_back(std::move(fill));
  }
}

/// The curve of a line; without points where none of them is on the axes.
FigureCurve curve_of(const FigureData& data, const FigureView& view, std::size_t i, const FigureStyle& style,
                     const Figure& figure) {
  constexpr double usual_width = 2, main_width = 3;
  const FigureLine& line = data.lines[i];
  FigureCurve curve{.name = line.label + (line.unbounded && !line.label.empty() ? " (unbounded)" : ""),
                    .heading = line.heading,
                    .colour = colour_of(data, i, style),
                    .width = line.is_main ? main_width : usual_width,
                    .line = i};
  bool any = false;
  for (std::size_t p = 0; p < line.parts.size(); ++p) {
    const bool unstable = p < line.unstable.size() && line.unstable[p];
    curve.stretches.push_back({curve.x.size(), line.parts[p].size(), unstable});
    for (const Record& record : line.parts[p]) {
      curve.x.push_back(record[view.x]);
      curve.y.push_back(record[view.y]);
      any = any || (figure.x.shows(record[view.x]) && figure.y.shows(record[view.y]));
    }
  }
  if (!any) curve.x.clear(), curve.y.clear(), curve.stretches.clear();
  return curve;
}

/// Marks of one kind on a line that would cover each other are one.
void add_symbols(const FigureData& data, const FigureView& view, std::size_t i, const std::string& colour,
                 Figure& figure) {
  constexpr double close = 0.014;  // of the axes
  const std::size_t first = figure.symbols.size();
  for (const FigureMark& mark : data.lines[i].marks) {
    const double x = mark.record[view.x], y = mark.record[view.y];
    if (mark.kind.mark.shape == results::Shape::none || !figure.x.shows(x) || !figure.y.shows(y)) continue;
    const auto covers = [&](const FigureSymbol& other) {
      return other.kind == mark.kind && std::abs(figure.x.place(x) - figure.x.place(other.x)) < close &&
             std::abs(figure.y.place(y) - figure.y.place(other.y)) < 1.6 * close;
    };
    const auto other = std::find_if(figure.symbols.begin() + static_cast<std::ptrdiff_t>(first),
                                    figure.symbols.end(), covers);
    if (other == figure.symbols.end())
      figure.symbols.push_back({mark.kind, colour, i, x, y, 1, mark.label});
    else
      ++other->count;
  }
}

/// Bands over the axis of x, narrower ones over wider ones, with entries of one line for the key, as all
/// lines have the same.
std::vector<FigureKeyEntry> add_bands(const FigureData& data, const FigureStyle& style, Figure& figure) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<FigureKeyEntry> key;
  for (std::size_t i = 0; i < data.lines.size(); ++i) {
    const bool is_first = key.empty();
    const auto& bands = data.lines[i].bands;
    for (std::size_t k = 0; k < bands.size(); ++k) {
      const auto [lower, upper] = bands[k].range;
      figure.fills.push_back({bands[k].label,
                              colour_of(data, i, style),
                              band_opacity,
                              i,
                              {{{lower, -infinity, infinity}, {upper, -infinity, infinity}}}});
      if (is_first)
        key.insert(key.begin(), {.of = FigureKeyEntry::Of::fill,
                                 .text = bands[k].label,
                                 .colour = data.lines.size() == 1 ? colour_of(data, 0, style) : other_colour,
                                 .opacity = 1 - std::pow(1 - band_opacity, static_cast<double>(k + 1))});
    }
  }
  return key;
}

void add_lines(const FigureData& data, const FigureView& view, const FigureStyle& style, Figure& figure) {
  const std::size_t count = data.lines.size(), step = (count + most_in_key - 1) / most_in_key,
                    every = (count + most_curves - 1) / most_curves;
  bool any_unstable = false;
  const std::vector<FigureKeyEntry> bands =
      view.x == 0 ? add_bands(data, style, figure) : std::vector<FigureKeyEntry>();
  const auto add = [&](std::size_t i) {
    FigureCurve curve = curve_of(data, view, i, style, figure);
    add_symbols(data, view, i, curve.colour, figure);
    if (curve.x.empty()) return;
    any_unstable = any_unstable || std::any_of(curve.stretches.begin(), curve.stretches.end(),
                                               [](const auto& stretch) { return stretch.unstable; });
    if (!curve.name.empty() && (i % step == 0 || data.lines[i].is_main))
      figure.key.push_back(
          {.of = FigureKeyEntry::Of::curve, .text = curve.name, .colour = curve.colour, .line = i});
    figure.curves.push_back(std::move(curve));
  };
  for (const bool is_main : {false, true})
    for (std::size_t i = 0; i < count; i += every)
      if (data.lines[i].is_main == is_main) add(i);
  if (every > 1)
    figure.note = std::to_string(figure.curves.size()) + " of " + std::to_string(count) + " curves";
  if (any_unstable)
    figure.key.push_back({.of = FigureKeyEntry::Of::unstable, .text = "unstable", .colour = other_colour});
  for (const EventKind& kind : mark_kinds(data))
    if (std::any_of(figure.symbols.begin(), figure.symbols.end(),
                    [&](const FigureSymbol& symbol) { return symbol.kind == kind; }))
      figure.key.push_back({.of = FigureKeyEntry::Of::mark,
                            .text = std::string(kind.words),
                            .colour = other_colour,
                            .kind = kind});
  figure.key.insert(figure.key.end(), bands.begin(), bands.end());
}

}  // namespace

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

Figure figure_of(const FigureData& data, const FigureView& view, const FigureStyle& style) {
  Figure figure{
      .name = view.name, .title = data.title, .are_areas = !view.areas.empty() || !view.tiles.empty()};
  set_axes(data, view, figure);
  if (!view.tiles.empty()) {
    add_tiles(view, style, figure);
    return figure;
  }
  if (figure.are_areas) {
    add_areas(view, figure);
    return figure;
  }
  if (data.lines.size() > most_curves && view.x == 0) {
    add_quantiles(data, view, style, figure);
    return figure;
  }
  figure.key_title = data.parameters;
  add_lines(data, view, style, figure);
  add_texts(style, figure);
  return figure;
}

std::vector<Figure> figures_of(const FigureData& data, const FigureStyle& style) {
  std::vector<Figure> all;
  for (const FigureView& view : data.figures)
    if (results::is_drawn(data, view)) all.push_back(figure_of(data, view, style));
  return all;
}

}  // namespace arcslip::figures
