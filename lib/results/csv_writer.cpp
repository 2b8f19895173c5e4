#include <arcslip/results/csv_writer.hpp>

#include <arcslip/results/json_writer.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

namespace arcslip::results {
namespace {

/// A field, quoted if RFC 4180 requires it.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

/// A name or another text as a field. Texts that start with =, +, - or @ are prefixed with ', so that
/// spreadsheets do not take them for formulas. Unsafe characters are escaped.
std::string text_field(const std::string& text) {
  const bool is_formula =
      !text.empty() && std::string_view("=+-@").find(text.front()) != std::string_view::npos;
  return field((is_formula ? "'" : "") + visible(text));
}

std::string cell(double value) {
  return std::isfinite(value) ? shortest(value) : "";
}

std::string cell(long value) {
  return std::to_string(value);
}

std::string cell(bool flag) {
  return flag ? "true" : "false";
}

std::string cell(const std::string& text) {
  return text_field(text);
}

std::string cell(const Value& value) {
  return std::visit(
      [&](const auto& is) -> std::string {
        using Is = std::decay_t<decltype(is)>;
        if constexpr (std::is_same_v<Is, std::nullptr_t>)
          return "";
        else if constexpr (std::is_same_v<Is, Value::Numbers> || std::is_same_v<Is, Value::List> ||
                           std::is_same_v<Is, Object>)
          return field(json(value));
        else
          return cell(is);
      },
      value.get());
}

/// "damper.stick_percent (%)", not yet a field.
std::string title(std::span<const std::string> path, const std::string& unit) {
  if (path.size() > 1 && path.front() == "elements") path = path.subspan(1);
  std::string text;
  for (const std::string& key : path) text += (text.empty() ? "" : ".") + key;
  return with_unit(text, unit);
}

/// "multipliers.1.re"
std::string title_of_pair(const Column& column, int i, const char* part) {
  return title(column.path, "") + "." + std::to_string(i + 1) + "." + part;
}

void add(const std::string& title, std::vector<std::string>& titles) {
  if (std::find(titles.begin(), titles.end(), title) == titles.end()) titles.push_back(title);
}

const Table* table_of(const Schema& schema, const std::string& key) {
  const auto is_it = [&](const Table& table) { return table.key == key; };
  const auto found = std::find_if(schema.tables.begin(), schema.tables.end(), is_it);
  return found == schema.tables.end() ? nullptr : &*found;
}

}  // namespace

CsvWriter::CsvWriter(std::ostream& out, std::string table) : out_(out), key_(std::move(table)) {}

void CsvWriter::begin(const Header& /*header*/, std::span<const Schema> schemas) {
  schemas_.assign(schemas.begin(), schemas.end());
  std::vector<std::string> nouns;
  for (const Schema& schema : schemas) {
    for (const Column& column : schema.set) add(title(column.path, column.unit), set_);
    add(schema.noun, nouns);
    if (const Table* table = table_of(schema, key_))
      for (const Column& column : table->columns) {
        add(title(column.path, column.unit), columns_);
        for (int i = 0; i < column.spread; ++i)
          for (const char* part : {"re", "im"}) add(title_of_pair(column, i, part), columns_);
      }
  }
  // The continuation parameter of one study may be set by for_each in another.
  std::erase_if(set_, [&](const std::string& name) {
    return std::find(columns_.begin(), columns_.end(), name) != columns_.end();
  });
  out_ << "study";
  for (const auto* titles : {&set_, &nouns, &columns_})
    for (const std::string& each : *titles) out_ << ',' << text_field(each);
  out_ << "\r\n";
}

void CsvWriter::curve(const Head& head, std::size_t schema) {
  schema_ = schema;
  first_ = text_field(head.study);
  head_.clear();
  for (const Member& setting : head.set)
    head_.emplace(title({&setting.key, 1}, setting.unit), cell(setting.value));
  for (const std::string& name : set_) {
    const auto found = head_.find(name);
    first_ += "," + (found == head_.end() ? "" : found->second);
  }
  const long number = ++count_[schemas_[schema].noun];
  std::vector<std::string> nouns;
  for (const Schema& each : schemas_) add(each.noun, nouns);
  for (const std::string& noun : nouns)
    first_ += "," + (noun == schemas_[schema].noun ? std::to_string(number) : "");
}

void CsvWriter::put_pairs(const Column& column, const Value& list, std::vector<std::string>& cells) const {
  const auto* pairs = std::get_if<Value::List>(&list.get());
  const auto put = [&](int i, const char* part, double value) {
    const auto found = std::find(columns_.begin(), columns_.end(), title_of_pair(column, i, part));
    cells[static_cast<std::size_t>(found - columns_.begin())] = cell(value);
  };
  for (int i = 0; pairs != nullptr && i < column.spread && i < static_cast<int>(pairs->size()); ++i)
    if (const auto* pair = std::get_if<Value::Numbers>(&(*pairs)[static_cast<std::size_t>(i)].get())) {
      put(i, "re", pair->at(0));
      put(i, "im", pair->at(1));
    }
}

void CsvWriter::rows(std::size_t table, const Rows& rows) {
  const Table& of = schemas_[schema_].tables[table];
  if (of.key != key_) return;
  std::vector<std::size_t> place(of.columns.size());  // of each column in a row
  for (std::size_t c = 0; c < place.size(); ++c)
    place[c] = static_cast<std::size_t>(
        std::find(columns_.begin(), columns_.end(), title(of.columns[c].path, of.columns[c].unit)) -
        columns_.begin());
  std::vector<std::string> cells(columns_.size());
  for (std::size_t c = 0; c < columns_.size(); ++c)
    if (const auto set = head_.find(columns_[c]); set != head_.end()) cells[c] = set->second;
  const std::vector<std::string> otherwise = cells;
  for (std::size_t i = 0; i < rows.count; ++i) {
    cells = otherwise;
    for (std::size_t c = 0; c < rows.columns.size(); ++c) {
      const Cells& column = rows.columns[c];
      if (!column.absent.empty() && column.absent[i]) continue;
      std::visit(
          [&](const auto& list) {
            using Cell = typename std::decay_t<decltype(list)>::value_type;
            cells[place[c]] = cell(static_cast<const Cell&>(list[i]));
          },
          column.of);
      if (const auto* values = std::get_if<std::vector<Value>>(&column.of);
          values && of.columns[c].spread > 0)
        put_pairs(of.columns[c], (*values)[i], cells);
    }
    out_ << first_;
    for (const std::string& each : cells) out_ << ',' << each;
    out_ << "\r\n";
  }
}

CsvSummary::CsvSummary(std::ostream& out) : out_(out) {}

void CsvSummary::begin(const Header& /*header*/, std::span<const Schema> schemas) {
  schemas_.assign(schemas.begin(), schemas.end());
  add("study", titles_);
  add("kind", titles_);
  for (const Schema& schema : schemas)
    for (const Column& column : schema.set) add(title(column.path, column.unit), titles_);
  for (const Schema& schema : schemas) add(schema.noun, titles_);
}

void CsvSummary::put(const std::string& title, std::string cell) {
  add(title, titles_);
  row_.resize(titles_.size());
  row_[static_cast<std::size_t>(std::find(titles_.begin(), titles_.end(), title) - titles_.begin())] =
      std::move(cell);
}

void CsvSummary::put(const std::string& prefix, const Object& facts) {
  for (const Member& fact : facts) {
    const std::string key = prefix + fact.key;
    if (const auto* inner = std::get_if<Object>(&fact.value.get()))
      put(key + ".", *inner);
    else if (!std::holds_alternative<Value::List>(fact.value.get()) &&
             !std::holds_alternative<Value::Numbers>(fact.value.get()))
      put(title({&key, 1}, fact.unit), cell(fact.value));
  }
}

void CsvSummary::curve(const Head& head, std::size_t schema) {
  row_.clear();
  put("study", text_field(head.study));
  put("kind", text_field(head.kind));
  put("", head.set);
  const std::string& noun = schemas_[schema].noun;
  const long number = ++count_[noun];
  put(noun, std::to_string(number));
  if (head.parent > 0) put("parent", std::to_string(number - head.parent));
  put("", head.facts);
}

void CsvSummary::end(const End& end) {
  put("status", name(end.status));
  put("stop.", end.stop);
  if (!end.doubt.empty()) put("doubt", text_field(end.doubt));
  put("", end.facts);
  Line& line = lines_.emplace_back(Line{{}, row_.size()});
  const char* separator = "";
  for (const std::string& cell : row_) line.text.append(std::exchange(separator, ",")).append(cell);
}

void CsvSummary::finish() {
  const char* separator = "";
  for (const std::string& each : titles_) out_ << std::exchange(separator, ",") << text_field(each);
  out_ << "\r\n";
  for (const Line& line : lines_)
    out_ << line.text << std::string(titles_.size() - line.cells, ',') << "\r\n";
}

std::vector<std::string> table_keys(std::span<const Schema> schemas) {
  std::vector<std::string> keys;
  for (const Schema& schema : schemas)
    for (const Table& table : schema.tables) add(table.key, keys);
  return keys;
}

void write_csv(std::ostream& out, const Results& results, const std::string& table) {
  const std::vector<std::string> keys = table_keys(results.schemas);
  if (std::find(keys.begin(), keys.end(), table) == keys.end()) {
    std::string all;
    for (const std::string& key : keys) all += (all.empty() ? "" : ", ") + key;
    throw std::invalid_argument("the results have no table \"" + table + "\", but: " + all);
  }
  CsvWriter writer(out, table);
  replay(results, writer);
}

void write_csv_summary(std::ostream& out, const Results& results) {
  CsvSummary summary(out);
  replay(results, summary);
}

}  // namespace arcslip::results
