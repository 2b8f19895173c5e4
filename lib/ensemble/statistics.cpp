// Statistics of the samples of a file: of the complete ones, in memory that does not grow with their number.
#include <arcslip/ensemble/ensemble.hpp>
#include <arcslip/ensemble/ensemble_file.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

namespace arcslip::ensemble {
namespace {

constexpr std::array<double, 7> probabilities = {0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99};
constexpr std::size_t bins = 20;
constexpr std::size_t most_shown = 12;

const char* const complete = " WHERE status = 'complete'";

/// Mean, variance and covariance of the pairs that have both numbers (Welford 1962).
struct Pair {
  long count = 0;
  double mean_x = 0, mean_y = 0, xx = 0, yy = 0, xy = 0;

  void add(double x, double y) {
    ++count;
    const double n = static_cast<double>(count), dx = x - mean_x, dy = y - mean_y;
    mean_x += dx / n;
    mean_y += dy / n;
    xx += dx * (x - mean_x);
    yy += dy * (y - mean_y);
    xy += dx * (y - mean_y);
  }
  double deviation() const { return count > 1 ? std::sqrt(xx / static_cast<double>(count - 1)) : 0; }
  double correlation() const { return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : std::nan(""); }
};

struct Summary {
  std::string name, unit;
  Pair moments{};
  double least = 0, largest = 0;
  std::array<double, probabilities.size()> quantiles{};
  std::array<long, bins> histogram{};
};

/// The columns of a file that have numbers.
struct Numbers {
  std::vector<TableColumn> parameters, quantities;
};

Numbers numbers_of(Database& database) {
  Numbers numbers;
  bool is_parameter = true;
  for (const TableColumn& column : contents_of(database).columns) {
    const auto own = sample_columns();
    const bool is_own =
        std::any_of(own.begin(), own.end(), [&](const auto& each) { return each.name == column.name; });
    if (is_own) is_parameter = false;
    if (is_own || column.type == "TEXT") continue;
    (is_parameter ? numbers.parameters : numbers.quantities).push_back(column);
  }
  return numbers;
}

std::string is_number(const std::string& name) {
  return " AND typeof(" + quoted_name(name) + ") IN ('real', 'integer')";
}

/// Fills in what the order of the values decides.
void add_order(Database& database, Summary& of) {
  const long count = of.moments.count;
  Statement select(database, "SELECT " + quoted_name(of.name) + " FROM samples" + complete +
                                 is_number(of.name) + " ORDER BY 1");
  double last = 0;
  std::size_t next = 0;
  for (long i = 0; select.step(); ++i) {
    const double value = select.number(0);
    // Between the values i - 1 and i, linearly.
    for (; next < probabilities.size(); ++next) {
      const double place = probabilities[next] * static_cast<double>(count - 1);
      if (place > static_cast<double>(i)) break;
      const double share = place - static_cast<double>(i - 1);
      of.quantiles[next] = i == 0 ? value : last + share * (value - last);
    }
    if (of.largest > of.least) {
      const double bin = (value - of.least) / (of.largest - of.least) * static_cast<double>(bins);
      ++of.histogram[std::min(static_cast<std::size_t>(bin), bins - 1)];
    }
    last = value;
  }
  if (!(of.largest > of.least)) of.histogram.front() = count;
}

std::optional<Summary> summary_of(Database& database, const TableColumn& column) {
  Summary of{.name = column.name, .unit = column.unit};
  Statement select(database,
                   "SELECT " + quoted_name(of.name) + " FROM samples" + complete + is_number(of.name));
  while (select.step()) {
    const double value = select.number(0);
    of.least = of.moments.count == 0 ? value : std::min(of.least, value);
    of.largest = of.moments.count == 0 ? value : std::max(of.largest, value);
    of.moments.add(value, value);
  }
  if (of.moments.count == 0) return std::nullopt;
  add_order(database, of);
  return of;
}

/// Of each quantity with each parameter and quantity.
std::vector<std::vector<Pair>> correlations(Database& database, const std::vector<Summary>& quantities,
                                            const std::vector<Summary>& others) {
  std::vector<std::vector<Pair>> all(quantities.size(), std::vector<Pair>(others.size()));
  if (quantities.empty()) return all;
  std::string names;
  for (const auto* list : {&quantities, &others})
    for (const Summary& of : *list) names += (names.empty() ? "" : ", ") + quoted_name(of.name);
  Statement select(database, "SELECT " + names + " FROM samples" + complete);
  while (select.step())
    for (std::size_t q = 0; q < quantities.size(); ++q)
      for (std::size_t o = 0; o < others.size() && !select.is_null(q); ++o)
        if (const std::size_t at = quantities.size() + o; !select.is_null(at))
          all[q][o].add(select.number(q), select.number(at));
  return all;
}

void write_summaries(Database& database, const std::vector<Summary>& all) {
  database.execute("DROP TABLE IF EXISTS statistics");
  database.execute("DROP TABLE IF EXISTS histograms");
  database.execute(
      "CREATE TABLE statistics(name TEXT, unit TEXT, count INTEGER, mean REAL, standard_deviation REAL, "
      "least REAL, q01 REAL, q05 REAL, q25 REAL, median REAL, q75 REAL, q95 REAL, q99 REAL, largest REAL)");
  database.execute("CREATE TABLE histograms(name TEXT, lower REAL, upper REAL, count INTEGER)");
  Statement insert(database, "INSERT INTO statistics VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  Statement bin(database, "INSERT INTO histograms VALUES (?, ?, ?, ?)");
  for (const Summary& of : all) {
    std::size_t at = 0;
    const auto put = [&](const Cell& cell) { insert.bind(at++, cell); };
    for (const std::string& text : {of.name, of.unit}) put(text);
    put(of.moments.count);
    for (const double number : {of.moments.mean_x, of.moments.deviation(), of.least}) put(number);
    for (const double number : of.quantiles) put(number);
    put(of.largest);
    insert.run();
    const double width = (of.largest - of.least) / static_cast<double>(bins);
    for (std::size_t i = 0; i < (width > 0 ? bins : 1); ++i) {
      bin.bind(0, of.name);
      bin.bind(1, of.least + width * static_cast<double>(i));
      bin.bind(2, i + 1 == bins ? of.largest : of.least + width * static_cast<double>(i + 1));
      bin.bind(3, of.histogram[i]);
      bin.run();
    }
  }
}

void write_correlations(Database& database, const std::vector<Summary>& quantities,
                        const std::vector<Summary>& others, const std::vector<std::vector<Pair>>& pairs) {
  database.execute("DROP TABLE IF EXISTS correlations");
  database.execute("CREATE TABLE correlations(name TEXT, other TEXT, count INTEGER, coefficient REAL)");
  Statement insert(database, "INSERT INTO correlations VALUES (?, ?, ?, ?)");
  for (std::size_t q = 0; q < quantities.size(); ++q)
    for (std::size_t o = 0; o < others.size(); ++o) {
      const double coefficient = pairs[q][o].correlation();
      insert.bind(0, quantities[q].name);
      insert.bind(1, others[o].name);
      insert.bind(2, pairs[q][o].count);
      insert.bind(3, std::isnan(coefficient) ? Cell() : Cell(coefficient));
      insert.run();
    }
}

/// Returns rows of cells as aligned columns, the first one to the left.
std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) {
      widths.resize(std::max(widths.size(), c + 1));
      widths[c] = std::max(widths[c], row[c].size());
    }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string space(widths[c] - row[c].size(), ' ');
      text += c == 0 ? row[c] + space : "   " + space + row[c];
    }
    text += '\n';
  }
  return text;
}

std::string digits(double value) {
  return std::isnan(value) ? "-" : results::to_digits(value, 5);
}

/// The unit with the prefix that suits the numbers of a summary.
results::PrefixedUnit unit_of(const Summary& of) {
  return results::prefixed(of.unit, std::max(std::abs(of.least), std::abs(of.largest)));
}

std::string summaries_text(const std::vector<Summary>& all) {
  std::vector<std::vector<std::string>> rows = {
      {"quantity", "mean", "deviation", "least", "5 %", "median", "95 %", "largest"}};
  for (const Summary& of : all) {
    std::vector<std::string>& row = rows.emplace_back();
    const results::PrefixedUnit in = unit_of(of);
    row.push_back(results::with_unit(of.name, in.unit));
    for (const double value : {of.moments.mean_x, of.moments.deviation(), of.least, of.quantiles[1],
                               of.quantiles[3], of.quantiles[5], of.largest})
      row.push_back(digits(in.factor * value));
  }
  return aligned(rows);
}

std::string histogram_text(const Summary& of) {
  constexpr long widest = 50;
  const long most = *std::max_element(of.histogram.begin(), of.histogram.end());
  const results::PrefixedUnit in = unit_of(of);
  const double width = in.factor * (of.largest - of.least) / static_cast<double>(bins),
               least = in.factor * of.least;
  std::vector<std::vector<std::string>> rows = {{results::with_unit(of.name, in.unit), "samples"}};
  for (std::size_t i = 0; width > 0 && i < bins; ++i)
    rows.push_back({digits(least + width * static_cast<double>(i)) + " to " +
                        digits(least + width * static_cast<double>(i + 1)),
                    std::to_string(of.histogram[i])});
  std::string text = aligned(rows), with_bars;
  std::size_t line = 0;
  for (const char c : text) {
    const auto bar =
        c == '\n' && line > 0 ? static_cast<std::size_t>(widest * of.histogram[line - 1] / most) : 0;
    if (bar > 0) with_bars += "  " + std::string(bar, '#');
    line += c == '\n';
    with_bars += c;
  }
  return width > 0 ? '\n' + with_bars : "";
}

std::string correlations_text(const std::vector<Summary>& quantities, const std::vector<Summary>& others,
                              const std::vector<std::vector<Pair>>& pairs) {
  std::vector<std::vector<std::string>> rows = {{"correlation"}};
  for (const Summary& of : quantities) rows.front().push_back(results::visible(of.name));
  for (std::size_t o = 0; o < others.size() && o < most_shown; ++o) {
    rows.push_back({results::visible(others[o].name)});
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      const double coefficient = pairs[q][o].correlation();
      rows.back().push_back(std::isnan(coefficient) ? "-" : results::to_digits(coefficient, 3));
    }
  }
  return '\n' + aligned(rows);
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  return quoted_name(text);
}

}  // namespace

std::string add_statistics(const std::string& path) {
  Database database(path, Database::Access::write);
  const Numbers numbers = numbers_of(database);
  std::vector<Summary> parameters, quantities;
  for (const bool is_parameter : {true, false})
    for (const TableColumn& column : is_parameter ? numbers.parameters : numbers.quantities)
      if (auto of = summary_of(database, column))
        (is_parameter ? parameters : quantities).push_back(std::move(*of));
  std::vector<Summary> all = parameters;
  all.insert(all.end(), quantities.begin(), quantities.end());
  const auto pairs = correlations(database, quantities, all);
  database.execute("BEGIN");
  write_summaries(database, all);
  write_correlations(database, quantities, all, pairs);
  database.execute("COMMIT");
  if (all.empty()) return {};
  std::string text = summaries_text(all);
  for (std::size_t q = 0; q < quantities.size() && q < most_shown; ++q) text += histogram_text(quantities[q]);
  return text + (quantities.empty() ? "" : correlations_text(quantities, all, pairs));
}

void write_csv(const std::string& path, std::ostream& out) {
  Database database(path, Database::Access::read);
  const Contents contents = contents_of(database);
  out << "sample";
  for (const TableColumn& column : contents.columns)
    out << ',' << csv_cell(results::with_unit(column.name, column.unit));
  out << '\n';
  Statement select(database, "SELECT * FROM samples ORDER BY sample");
  while (select.step()) {
    for (std::size_t c = 0; c < select.columns(); ++c) {
      const Cell cell = select.cell(c);
      if (c > 0) out << ',';
      if (const auto* number = std::get_if<double>(&cell))
        out << results::shortest(*number);
      else if (const auto* whole = std::get_if<long>(&cell))
        out << *whole;
      else if (const auto* text = std::get_if<std::string>(&cell))
        out << csv_cell(*text);
    }
    out << '\n';
  }
}

}  // namespace arcslip::ensemble
