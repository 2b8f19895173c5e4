#include <arcslip/results/table_writer.hpp>

#include <arcslip/results/shown.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

namespace arcslip::results {
namespace {

using Row = std::vector<std::string>;

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
    of_it_.push_back(shown_cells(schema.shown, object(of.columns, rows, i), head_.facts));
}

void TableWriter::end(const End& end) {
  const Schema& schema = schemas_[schema_];
  if (schema.shown.empty()) {
    if (!end.text.empty()) separate();
    out_ << end.text;
    return;
  }
  if (schema.shown_table.empty()) of_it_ = {shown_cells(schema.shown, end.facts, head_.facts)};
  if (of_it_.empty()) of_it_.emplace_back(schema.shown.size(), ShownCell{"-"});
  for (const std::vector<ShownCell>& row : of_it_) {
    std::vector<ShownCell>& line = lines_.emplace_back();
    for (std::string& cell : set_cells(schema, head_.set)) line.push_back({std::move(cell)});
    line.insert(line.end(), row.begin(), row.end());
    line.push_back({name(end.status)});
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
  write_aligned(out_, text_rows(schemas_[schema_], std::exchange(lines_, {})));
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
  if (end.status != Status::complete)
    early_ends.push_back(how + ": " + text_in(end.stop, "message"));
  else if (!end.doubt.empty())
    doubts.push_back(how + ", but " + end.doubt);
  if (!end.remark.empty()) others.push_back(which_ + ": " + from_ + end.remark);
}

}  // namespace arcslip::results
