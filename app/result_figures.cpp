#include "output/results.hpp"
#include "output/standard_output.hpp"
#include "result_file.hpp"

#include "output/message.hpp"

#include <arcslip/ensemble/ensemble.hpp>
#include <arcslip/results/figure_data.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/scene/scene.hpp>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::app {
namespace {

using results::Column;
using results::Value;

/// The table with the points of the curves: the longest that has both columns.
struct Axes {
  std::size_t table, x, y;
};

std::optional<std::size_t> column_of(const results::Table& table, const std::string& name) {
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const std::string full = results::name(table.columns[c]);
    if (full == name || full == "elements." + name) return c;
  }
  return {};
}

/// The parameter that a curve is over: the first column of a table, if it is none of a response.
std::string usual_x(const results::Table& table) {
  const std::string first = table.columns.empty() ? "" : results::name(table.columns.front());
  return first == "omega" || first == "frequency" || first.empty() ? "frequency" : first;
}

std::optional<Axes> axes_of(const results::Schema& schema, const CommandOptions& options) {
  for (std::size_t t = 0; t < schema.tables.size(); ++t) {
    const results::Table& table = schema.tables[t];
    if (table.key == "events") continue;
    const auto x = column_of(table, options.x.empty() ? usual_x(table) : options.x);
    const auto y = column_of(table, options.y.empty() ? "amplitude" : options.y);
    if (x && y) return Axes{t, *x, *y};
  }
  return {};
}

double number_in(const results::Cells& cells, std::size_t row) {
  const auto* values = std::get_if<std::vector<Value>>(&cells.of);
  const auto* number = values != nullptr ? std::get_if<double>(&(*values)[row].get()) : nullptr;
  return number != nullptr ? *number : std::numeric_limits<double>::quiet_NaN();
}

bool is_unstable(const results::Table& table, const results::Rows& rows, std::size_t row) {
  const auto stable = column_of(table, "stable");
  const auto* values = stable ? std::get_if<std::vector<Value>>(&rows.columns[*stable].of) : nullptr;
  const auto* flag = values != nullptr ? std::get_if<bool>(&(*values)[row].get()) : nullptr;
  return flag != nullptr && !*flag;
}

/// Parts of equal stability, which share the point where it changes.
void add_parts(const results::Table& table, const results::Rows& rows, const Axes& axes,
               results::FigureLine& line) {
  for (std::size_t i = 0; i < rows.count; ++i) {
    const results::Record record{number_in(rows.columns[axes.x], i), number_in(rows.columns[axes.y], i)};
    const bool unstable = is_unstable(table, rows, i);
    if (line.parts.empty() || line.unstable.back() != unstable) {
      std::vector<results::Record> part;
      if (!line.parts.empty()) part.push_back(line.parts.back().back());
      line.parts.push_back(std::move(part));
      line.unstable.push_back(unstable);
    }
    line.parts.back().push_back(record);
  }
}

/// "3 N" of one parameter, whose name the key has.
std::string label_of(const results::Object& set) {
  const auto* value = set.size() == 1 ? std::get_if<double>(&set.front().value.get()) : nullptr;
  return value != nullptr ? results::quantity(*value, set.front().unit) : results::assignment(set);
}

results::FigureColumn axis_of(const Column& column) {
  return {.words = results::name(column), .unit = column.unit};
}

std::optional<results::FigureData> figure_of(const results::Results& all, std::size_t schema,
                                             const CommandOptions& options) {
  const auto axes = axes_of(all.schemas[schema], options);
  if (!axes) return {};
  const results::Table& table = all.schemas[schema].tables[axes->table];
  results::FigureData data{.name = "", .title = all.header.title};
  data.columns = {axis_of(table.columns[axes->x]), axis_of(table.columns[axes->y])};
  for (const Column& column : all.schemas[schema].set) data.parameters.push_back(results::name(column));
  for (const results::Result& result : all.results) {
    if (result.schema != schema) continue;
    results::FigureLine line{.label = label_of(result.head.set),
                             .heading = results::assignment(result.head.set)};
    add_parts(table, result.tables[axes->table], *axes, line);
    if (!line.parts.empty()) data.lines.push_back(std::move(line));
  }
  for (std::size_t c = 0; c < data.columns.size(); ++c) data.columns[c].range = results::full_range(data, c);
  data.figures = {{.name = results::name(table.columns[axes->y])}};
  return data;
}

/// The files of a list, by the columns that are chosen: other columns have other files.
std::string name_of(const results::Results& all, std::size_t schema, const std::string& file,
                    const CommandOptions& options) {
  std::string name = file + "_plot";
  if (!options.y.empty()) name += "_" + options.y;
  if (!options.x.empty()) name += "_over_" + options.x;
  name = output::file_name(name);
  return all.schemas.size() > 1 ? name + "_" + all.schemas[schema].list : name;
}

/// Figures, and the name that their files begin with.
using Plots = std::vector<std::pair<std::string, std::vector<results::FigureData>>>;

Plots plots_of_results(const std::string& path, const CommandOptions& options) {
  const results::Results all = read_results(path);
  const std::string file = std::filesystem::path(path).stem().string();
  Plots plots;
  for (std::size_t schema = 0; schema < all.schemas.size(); ++schema)
    if (auto data = figure_of(all, schema, options); data && !data->lines.empty())
      plots.push_back({name_of(all, schema, file, options), {std::move(*data)}});
  if (plots.empty())
    throw UsageError(
        results::visible(path) +
        " has no table with these columns: give --x and --y, of those that arcslip show --columns "
        "names");
  return plots;
}

Plots plots_of_ensemble(const std::string& path, const CommandOptions& options) {
  if (!options.x.empty() || !options.y.empty())
    throw UsageError(results::visible(path) +
                     " is an ensemble, whose figures are histograms without --x and --y");
  return {{output::file_name(std::filesystem::path(path).stem().string()), ensemble::histograms(path)}};
}

}  // namespace

ExitCode plot_results(const CommandOptions& options) {
  const std::string& path = options.files[0];
  const Plots plots = is_ensemble(path) ? plots_of_ensemble(path, options) : plots_of_results(path, options);
  const std::string folder =
      options.out.empty() ? std::filesystem::path(path).parent_path().string() : options.out;
  if (!options.out.empty()) std::filesystem::create_directories(folder);
  Writing writing;
  std::string places;
  for (const auto& [name, data] : plots) {
    const DrawnFigures drawn =
        FiguresOfStudy({folder.empty() ? "." : folder, name}, data, options.figures, writing).finish(writing);
    if (!drawn.problem.empty()) tell(drawn.problem);
    for (const std::string& each : drawn.paths) places += results::visible(each) + "\n";
  }
  StandardOutput screen;
  screen.write_lines([&](std::ostream& out) { out << places; });
  screen.finish();
  return writing.code(ExitCode::done);
}

}  // namespace arcslip::app
