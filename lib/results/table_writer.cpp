#include <arcslip/results/table_writer.hpp>

#include <arcslip/results/text.hpp>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <type_traits>
#include <utility>

namespace arcslip::results {
namespace {

using Row = std::vector<std::string>;

constexpr const char* no_value = "-";

std::string text_of(const Value& value, const std::string& format, double error = 0, bool doubtful = false) {
  return std::visit(
      [&](const auto& is) -> std::string {
        using Is = std::decay_t<decltype(is)>;
        if constexpr (std::is_same_v<Is, double>) {
          const double at_least = doubtful ? doubtful_error(is, error) : error;
          return std::isfinite(is) ? with_error(is, at_least, format.c_str()) : no_value;
        } else if constexpr (std::is_same_v<Is, long>) {
          return std::to_string(is);
        } else if constexpr (std::is_same_v<Is, std::string>) {
          return is;
        } else if constexpr (std::is_same_v<Is, bool>) {
          return is ? "yes" : "no";
        } else {
          return no_value;
        }
      },
      value.get());
}

const Value* find(const Object& object, std::span<const std::string> path) {
  const auto has_key = [&](const Member& member) { return member.key == path.front(); };
  const auto found = std::find_if(object.begin(), object.end(), has_key);
  if (found == object.end()) return nullptr;
  if (path.size() == 1) return &found->value;
  const auto* inner = std::get_if<Object>(&found->value.get());
  return inner ? find(*inner, path.subspan(1)) : nullptr;
}

bool is_set(const Object& object, const std::string& name) {
  const Value* flag = name.empty() ? nullptr : find(object, {&name, 1});
  return flag && std::holds_alternative<bool>(flag->get()) && std::get<bool>(flag->get());
}

bool stands_instead(const Object& object, const Shown& each) {
  const Value* word = each.instead.of.empty() ? nullptr : find(object, {&each.instead.of, 1});
  const auto* text = word ? std::get_if<std::string>(&word->get()) : nullptr;
  const auto& words = each.instead.words;
  return text && is_set(object, each.path.front()) &&
         std::find(words.begin(), words.end(), *text) != words.end();
}

bool is_doubtful(const Object& object, const std::string& name) {
  const Value* value = find(object, {&name, 1});
  const auto* number = value ? std::get_if<double>(&value->get()) : nullptr;
  return is_set(object, name) || (number && !std::isfinite(*number));
}

/// The cells of what is shown of an object, or else of the facts of its result.
Row cells(const std::vector<Shown>& shown, const Object& object, const Object& facts) {
  Row row;
  for (const Shown& each : shown) {
    const Value* value = find(object, each.path);
    if (!value) value = find(facts, each.path);
    const Value* estimate = each.error.empty() ? nullptr : find(object, each.error);
    const auto* error = estimate ? std::get_if<double>(&estimate->get()) : nullptr;
    const double size = error && std::isfinite(*error) ? *error * each.error_unit : 0;
    const bool doubtful = std::any_of(each.doubtful.begin(), each.doubtful.end(),
                                      [&](const std::string& name) { return is_doubtful(object, name); });
    row.push_back(value ? text_of(*value, each.format, size, doubtful) : no_value);
    if (row.back() == no_value && is_set(object, each.otherwise)) row.back() = each.otherwise;
    if (stands_instead(object, each)) row.back() = each.instead.text;
  }
  return row;
}

/// Of UTF-8.
std::size_t characters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

void write_aligned(std::ostream& out, std::vector<Row> rows) {
  std::vector<std::size_t> widths;
  for (Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) {
      row[i] = visible(row[i]);
      widths[i] = std::max(widths[i], characters(row[i]));
    }
  }
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i)
      out << (i > 0 ? "  " : "") << std::string(widths[i] - characters(row[i]), ' ') << row[i];
    out << '\n';
  }
}

}  // namespace

TableWriter::TableWriter(std::ostream& out) : out_(out) {}

void TableWriter::begin(const Header& /*header*/, std::span<const Schema> schemas) {
  schemas_.assign(schemas.begin(), schemas.end());
}

void TableWriter::curve(const Head& head, std::size_t schema) {
  if (schema != schema_) {
    finish();
    is_apart_ = any_;
    count_ = 0;
  }
  schema_ = schema;
  head_ = head;
  head_.facts.push_back({"id", ++count_});
  of_it_.clear();
}

void TableWriter::rows(std::size_t table, const Rows& rows) {
  const Schema& schema = schemas_[schema_];
  const Table& of = schema.tables[table];
  for (std::size_t i = 0; i < rows.count && of.key == schema.shown_table; ++i)
    of_it_.push_back(cells(schema.shown, object(of.columns, rows, i), head_.facts));
}

void TableWriter::end(const End& end) {
  const Schema& schema = schemas_[schema_];
  if (schema.shown.empty()) {
    if (!end.text.empty()) separate();
    out_ << end.text;
    return;
  }
  if (schema.shown_table.empty()) of_it_ = {cells(schema.shown, end.facts, head_.facts)};
  if (of_it_.empty()) of_it_.emplace_back(schema.shown.size(), no_value);
  for (Row& row : of_it_) {
    Row& line = lines_.emplace_back();
    for (const Column& column : schema.set) {
      const Value* value = find(head_.set, column.path);
      const auto* number = value ? std::get_if<double>(&value->get()) : nullptr;
      line.push_back(number ? shortest(*number) : no_value);
    }
    line.insert(line.end(), row.begin(), row.end());
    line.emplace_back(name(end.status));
  }
}

void TableWriter::separate() {
  if (is_apart_) out_ << '\n';
  is_apart_ = false;
  any_ = true;
}

void TableWriter::finish() {
  if (lines_.empty()) return;
  separate();
  const Schema& schema = schemas_[schema_];
  Row titles;
  for (const Column& column : schema.set) titles.push_back(with_unit(name(column), column.unit));
  for (const Shown& each : schema.shown) titles.push_back(each.title);
  titles.push_back(schema.noun);
  lines_.insert(lines_.begin(), std::move(titles));
  write_aligned(out_, std::exchange(lines_, {}));
}

void write_table(std::ostream& out, const Results& results) {
  TableWriter writer(out);
  replay(results, writer);
}

void Remarks::begin(const Header& /*header*/, std::span<const Schema> schemas) {
  for (const Schema& schema : schemas) nouns_.push_back(schema.noun);
}

void Remarks::curve(const Head& head, std::size_t schema) {
  const std::string set = assignment(head.set);
  which_ = nouns_[schema] + " " + std::to_string(++count_) + (set.empty() ? "" : " (" + set + ")");
  from_.clear();
  if (head.parent > 0)
    from_ = "from " + nouns_[schema] + " " + std::to_string(count_ - static_cast<std::size_t>(head.parent)) +
            ", ";
}

void Remarks::end(const End& end) {
  const std::string how = which_ + " " + name(end.status);
  const Value* message = find(end.stop, std::vector<std::string>{"message"});
  if (end.status != Status::complete)
    early_ends.push_back(how + ": " + (message ? text_of(*message, "") : ""));
  else if (!end.doubt.empty())
    doubts.push_back(how + ", but " + end.doubt);
  if (!end.remark.empty()) others.push_back(which_ + ": " + from_ + end.remark);
}

}  // namespace arcslip::results
