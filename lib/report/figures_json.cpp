#include <arcslip/figures/layout.hpp>
#include <arcslip/report/parts.hpp>

#include <arcslip/results/json_writer.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

namespace arcslip::report {
namespace {

using results::FigureData;
using results::FigureLine;
using results::FigureMark;
using results::json_quoted;
using results::Record;

constexpr int drawn_digits = 7;  // of what is drawn: more than a zoom shows
constexpr int area_digits = 4;   // of areas, whose ends are degrees
constexpr int point_digits = 3;  // of what is shown at a point alone

std::string number(double value, int most) {
  return std::isfinite(value) ? results::to_digits(value, most) : "null";
}

/// "[a,b,c]", each by write(item).
template <class List, class Write>
std::string list_of(const List& all, const Write& write) {
  std::string text = "[";
  for (const auto& each : all) (text += text.size() > 1 ? "," : "") += write(each);
  return text + "]";
}

/// The columns of some records, each a list.
std::string columns_of(const std::vector<Record>& records, const std::vector<int>& digits_of) {
  std::string text = "[";
  for (std::size_t c = 0; c < digits_of.size(); ++c)
    (text += c > 0 ? "," : "") +=
        list_of(records, [&](const Record& each) { return number(each[c], digits_of[c]); });
  return text + "]";
}

const char* name(results::Scale scale) {
  return scale == results::Scale::linear        ? "linear"
         : scale == results::Scale::logarithmic ? "logarithmic"
                                                : "percent";
}

std::string column_json(const results::FigureColumn& column) {
  const results::PrefixedUnit in = figures::unit_of(column);
  return "{\"label\":" + json_quoted(results::with_unit(column.words, in.unit)) +
         (in.factor != 1 ? ",\"factor\":" + results::shortest(in.factor) : "") + ",\"scale\":\"" +
         name(column.scale) + "\",\"lower\":" + number(column.range.lower, drawn_digits) +
         ",\"upper\":" + number(column.range.upper, drawn_digits) +
         (column.has_axis ? "" : ",\"pointOnly\":true") + (column.is_frequency ? ",\"frequency\":true" : "") +
         "}";
}

/// The rows of the table of a study, by the numbers in them.
class RowsOfMarks {
 public:
  explicit RowsOfMarks(const std::vector<TableRow>& rows) : rows_(rows) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (const double number : rows[i].numbers) by_number_.emplace(number, i);
  }

  /// The row that a mark stands for; none: -1.
  int of(const FigureMark& mark) const {
    const auto places = std::span(mark.record).first(2);
    const auto known =
        std::find_if(places.begin(), places.end(), [](double at) { return std::isfinite(at); });
    if (known == places.end()) return -1;
    const auto [first, last] = by_number_.equal_range(*known);
    for (auto each = first; each != last; ++each) {
      const TableRow& row = rows_[each->second];
      const auto has = [&](double value) {
        return !std::isfinite(value) ||
               std::find(row.numbers.begin(), row.numbers.end(), value) != row.numbers.end();
      };
      if (row.kind == mark.kind.name && std::all_of(places.begin(), places.end(), has))
        return static_cast<int>(each->second);
    }
    return -1;
  }

 private:
  const std::vector<TableRow>& rows_;
  std::multimap<double, std::size_t> by_number_;
};

std::string mark_json(const FigureMark& mark, const std::vector<results::EventKind>& kinds,
                      const RowsOfMarks& rows) {
  const auto kind = std::find(kinds.begin(), kinds.end(), mark.kind) - kinds.begin();
  return "{\"kind\":" + std::to_string(kind) +
         ",\"values\":" + list_of(mark.record, [](double value) { return number(value, drawn_digits); }) +
         ",\"row\":" + std::to_string(rows.of(mark)) +
         (mark.label.empty() ? "" : ",\"label\":" + json_quoted(mark.label)) + "}";
}

constexpr std::string_view digits_of_64 = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Numbers as two digits each, of 64, in 4096 steps from -largest to largest.
std::string packed(const std::vector<double>& values, double largest) {
  constexpr int base = 64, steps = base * base - 1;
  std::string text;
  for (const double value : values) {
    const double share = largest > 0 && std::isfinite(value) ? value / largest : 0;
    const long step = std::lround((share + 1) / 2 * steps);
    text += digits_of_64[static_cast<std::size_t>(step / base)];
    text += digits_of_64[static_cast<std::size_t>(step % base)];
  }
  return text;
}

/// {"most": 0.01, "of": "..."}
std::string series_json(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return "{\"most\":" + number(largest, point_digits + 1) +
         ",\"of\":" + json_quoted(packed(values, largest)) + "}";
}

std::string motion_json(const results::FigureMotion& motion, const std::vector<int>& digits_of) {
  std::string at;
  for (std::size_t c = 0; c < digits_of.size(); ++c)
    at += (c > 0 ? "," : "") + number(motion.record[c], digits_of[c]);
  return "{\"at\":[" + at + "],\"words\":" + json_quoted(motion.words) +
         ",\"period\":" + number(motion.period, drawn_digits) + ",\"x\":" + series_json(motion.displacement) +
         ",\"loops\":" +
         list_of(motion.loops,
                 [&](const results::FigureLoop& loop) {
                   const bool is_response = loop.displacement == motion.displacement;  // is there already
                   return "{\"name\":" + json_quoted(loop.name) +
                          (is_response ? "" : ",\"q\":" + series_json(loop.displacement)) +
                          ",\"f\":" + series_json(loop.force) + "}";
                 }) +
         "}";
}

std::string line_json(const FigureLine& line, const std::vector<int>& digits_of,
                      const std::vector<results::EventKind>& kinds, const RowsOfMarks& rows) {
  std::string parts = "[";
  for (std::size_t i = 0; i < line.parts.size(); ++i)
    (parts += i > 0 ? "," : "") +=
        "{\"unstable\":" + std::string(i < line.unstable.size() && line.unstable[i] ? "true" : "false") +
        ",\"columns\":" + columns_of(line.parts[i], digits_of) + "}";
  return "{\"label\":" + json_quoted(line.label) + ",\"heading\":" + json_quoted(line.heading) +
         (line.is_main ? ",\"main\":true" : "") +
         ",\"set\":" + list_of(line.set, [](const auto& value) { return results::shortest(value.second); }) +
         ",\"parts\":" + parts + "],\"marks\":" +
         list_of(line.marks, [&](const FigureMark& mark) { return mark_json(mark, kinds, rows); }) +
         ",\"motions\":" +
         list_of(line.motions,
                 [&](const results::FigureMotion& motion) { return motion_json(motion, digits_of); }) +
         ",\"bands\":" +
         list_of(line.bands,
                 [](const results::FigureBand& band) {
                   return "{\"label\":" + json_quoted(band.label) +
                          ",\"lower\":" + number(band.range.lower, drawn_digits) +
                          ",\"upper\":" + number(band.range.upper, drawn_digits) + "}";
                 }) +
         "}";
}

std::string area_json(const results::Figure& figure, const results::FigureFill& area) {
  return "{\"kind\":" + json_quoted(area.name) + ",\"class\":" + json_quoted(area_class(figure, area.line)) +
         ",\"strips\":" +
         list_of(
             area.strips,
             [](const auto& strip) { return columns_of(strip, {area_digits, area_digits, area_digits}); }) +
         "}";
}

/// The areas of a figure, as it is drawn.
std::string areas_json(const FigureData& data, const results::FigureView& view) {
  if (view.areas.empty() && view.tiles.empty()) return "[]";
  const results::Figure figure = figures::figure_of(data, view);
  return list_of(figure.fills, [&](const auto& area) { return area_json(figure, area); });
}

std::string figure_json(const FigureData& data, const results::FigureView& figure) {
  const std::string x_unit = figures::unit_of(data.columns[figure.x]).unit,
                    y_unit = figure.areas.empty() ? figures::unit_of(data.columns[figure.y]).unit
                                                  : results::y_unit(data, figure);
  return "{\"x\":" + std::to_string(figure.x) + ",\"y\":" + std::to_string(figure.y) +
         ",\"xLabel\":" + json_quoted(results::with_unit(results::x_words(data, figure), x_unit)) +
         ",\"yLabel\":" + json_quoted(results::with_unit(results::y_words(data, figure), y_unit)) +
         ",\"caption\":" + json_quoted(results::caption(data, figure)) +
         (figure.areas.empty() ? "" : ",\"turn\":true") + ",\"areas\":" + areas_json(data, figure) + "}";
}

std::string kind_json(const results::EventKind& kind) {
  const Outline shape = outline(kind.mark.shape);
  return "{\"words\":" + json_quoted(kind.words) + ",\"path\":" + json_quoted(shape.path) +
         ",\"filled\":" + (shape.is_filled ? "true" : "false") + "}";
}

}  // namespace

std::string figures_json(const StudyContents& study, const std::vector<FigureData>& figures) {
  const RowsOfMarks rows(study.rows);
  return list_of(figures, [&](const FigureData& data) {
    std::vector<int> digits_of;
    for (const results::FigureColumn& column : data.columns)
      digits_of.push_back(column.has_axis ? drawn_digits : point_digits);
    const std::vector<results::EventKind> kinds = figures::mark_kinds(data);
    return "{\"parameters\":" + list_of(data.parameters, json_quoted) +
           ",\"columns\":" + list_of(data.columns, column_json) + ",\"kinds\":" + list_of(kinds, kind_json) +
           ",\"lines\":" +
           list_of(data.lines,
                   [&](const FigureLine& line) { return line_json(line, digits_of, kinds, rows); }) +
           ",\"figures\":" +
           list_of(data.figures, [&](const auto& figure) { return figure_json(data, figure); }) + "}\n";
  });
}

}  // namespace arcslip::report
