// Histograms of the quantities of an ensemble as data of figures.
#include <arcslip/ensemble/ensemble.hpp>
#include <arcslip/ensemble/ensemble_file.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>

namespace arcslip::ensemble {
namespace {

/// Returns the outline of the bins, from the axis to the axis.
std::vector<results::Record> outline(Database& database, const std::string& quantity) {
  Statement select(database, "SELECT lower, upper, count FROM histograms WHERE name = ? ORDER BY lower");
  select.bind(0, quantity);
  std::vector<results::Record> line;
  while (select.step()) {
    const double lower = select.number(0), upper = select.number(1), count = select.number(2);
    if (line.empty()) line.push_back({lower, 0});
    line.push_back({lower, count});
    line.push_back({upper, count});
  }
  if (!line.empty()) line.push_back({line.back()[0], 0});
  return line;
}

/// Returns nothing for a quantity that is the same in all samples.
std::optional<results::FigureData> histogram(Database& database, const std::string& title,
                                             const std::string& quantity, const std::string& unit) {
  Statement select(database, "SELECT q05, q25, q75, q95, least, largest FROM statistics WHERE name = ?");
  select.bind(0, quantity);
  if (!select.step() || !(select.number(4) < select.number(5))) return std::nullopt;
  results::FigureData data{.name = quantity, .title = title};
  data.columns = {{.words = quantity, .unit = unit}, {.words = "samples"}};
  data.lines = {{.parts = {outline(database, quantity)},
                 .bands = {{"5 to 95 % of the samples", {select.number(0), select.number(3)}},
                           {"25 to 75 %", {select.number(1), select.number(2)}}}}};
  for (std::size_t c = 0; c < data.columns.size(); ++c) data.columns[c].range = results::full_range(data, c);
  data.figures = {{.name = "histogram"}};
  return data;
}

}  // namespace

std::vector<results::FigureData> histograms(const std::string& path) {
  Database database(path, Database::Access::read);
  const Contents contents = contents_of(database);
  const Cell there =
      database.value("SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = 'histograms'");
  if (there == Cell(0L))
    throw FileFault(results::visible(path) +
                    ": found no statistics, which come with the last sample: arcslip ensemble goes on");
  const auto is_own = [](const TableColumn& column) {
    return std::any_of(sample_columns().begin(), sample_columns().end(),
                       [&](const TableColumn& own) { return own.name == column.name; });
  };
  // The parameters stand before them.
  auto quantity = std::find_if(contents.columns.begin(), contents.columns.end(), is_own);
  std::vector<results::FigureData> all;
  for (; quantity != contents.columns.end(); ++quantity) {
    if (is_own(*quantity)) continue;
    if (auto data = histogram(database, fact_in(contents.facts, "title"), quantity->name, quantity->unit))
      all.push_back(std::move(*data));
  }
  return all;
}

}  // namespace arcslip::ensemble
