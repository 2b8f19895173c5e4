#include <arcslip/report/report.hpp>

#include <arcslip/report/contents.hpp>
#include <arcslip/report/parts.hpp>
#include <arcslip/results/shown.hpp>
#include <arcslip/scene/study_type.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <variant>

namespace arcslip::report {
namespace {

using results::Object;
using results::Rows;
using results::Schema;

/// The numbers of a row, in any order.
std::vector<double> numbers_of(const Rows& rows, std::size_t row) {
  std::vector<double> all;
  for (const results::Cells& cells : rows.columns) {
    const auto* numbers = std::get_if<std::vector<double>>(&cells.of);
    const bool is_there = cells.absent.empty() || !cells.absent[row];
    if (numbers && is_there && std::isfinite((*numbers)[row])) all.push_back((*numbers)[row]);
  }
  return all;
}

/// "branch 3 (k.value = 2 N/m)"
std::string name_of(const StudyContents& study, const results::Head& head) {
  const std::string set = results::assignment(head.set);
  return study.schema.noun + " " + std::to_string(study.results) + (set.empty() ? "" : " (" + set + ")");
}

void add_doubt(const results::Head& head, const results::End& end, StudyContents& study) {
  const bool is_complete = end.status == results::Status::complete;
  if (is_complete && end.doubt.empty()) return;
  if (study.doubts.size() == most_results) {
    ++study.doubts_left_out;
    return;
  }
  study.doubts.push_back({name_of(study, head),
                          is_complete ? end.doubt : results::text_in(end.stop, "message"),
                          results::text_in(end.stop, "reason"), is_complete});
}

}  // namespace

Report::Report(const scene::Scene& scene, std::span<const scene::Study> studies)
    : contents_(std::make_unique<Contents>(Contents{scene})) {
  for (const scene::Study& study : studies)
    contents_->studies.push_back({.name = study.name,
                                  .kind = std::string(study.type->name()),
                                  .help = std::string(study.type->help())});
}

Report::~Report() = default;

void Report::begin(const results::Header& header, std::span<const Schema> schemas) {
  contents_->header = header;
  for (std::size_t i = 0; i < std::min(schemas.size(), contents_->studies.size()); ++i)
    contents_->studies[i].schema = schemas[i];
}

void Report::curve(const results::Head& head, std::size_t schema) {
  contents_->study = schema;
  StudyContents& study = contents_->studies.at(schema);
  ++study.results;
  contents_->head = head;
  contents_->head.facts.push_back({"id", study.results});
  contents_->rows.clear();
}

void Report::rows(std::size_t table, const Rows& rows) {
  const StudyContents& study = contents_->studies[contents_->study];
  const Schema& schema = study.schema;
  const results::Table& of = schema.tables[table];
  if (schema.shown.empty() || of.key != schema.shown_table || study.results > most_results) return;
  for (std::size_t i = 0; i < rows.count; ++i) {
    const Object object = results::object(of.columns, rows, i);
    contents_->rows.push_back({results::shown_cells(schema.shown, object, contents_->head.facts),
                               results::text_in(object, "kind"), numbers_of(rows, i)});
  }
}

void Report::end(const results::End& end) {
  const results::Head& head = contents_->head;
  StudyContents& study = contents_->studies[contents_->study];
  add_doubt(head, end, study);
  if (study.results > most_results) {
    ++study.left_out;
    return;
  }
  if (!end.remark.empty()) study.remarks.push_back(name_of(study, head) + ": " + end.remark);
  if (study.schema.shown.empty()) {
    study.searches.push_back({results::assignment(head.set), end.status, end.facts, end.text});
    return;
  }
  std::vector<TableRow> rows = std::exchange(contents_->rows, {});
  if (study.schema.shown_table.empty())
    rows = {{results::shown_cells(study.schema.shown, end.facts, head.facts)}};
  if (rows.empty()) rows.push_back({std::vector<results::ShownCell>(study.schema.shown.size(), {"-"})});
  for (TableRow& row : rows) {
    std::vector<results::ShownCell> cells;
    for (std::string& cell : results::set_cells(study.schema, head.set)) cells.push_back({std::move(cell)});
    std::move(row.cells.begin(), row.cells.end(), std::back_inserter(cells));
    cells.push_back({results::name(end.status)});
    row.cells = std::move(cells);
    study.rows.push_back(std::move(row));
  }
}

void Report::add_figures(std::size_t study, std::vector<results::FigureData> figures) {
  contents_->studies.at(study).figures = std::move(figures);
}

void Report::write(std::ostream& out) const {
  write_page(out, *contents_);
}

}  // namespace arcslip::report
