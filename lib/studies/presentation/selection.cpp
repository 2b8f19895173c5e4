#include <arcslip/studies/presentation/selection.hpp>

#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/scene/scene.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace arcslip::studies {
namespace {

namespace kinds = observables::event_kinds;

constexpr const char* no_events = "none";
constexpr const char* kind_column = "kind";

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_selected(const Selection& selection, const results::Column& column) {
  if (selection.columns.empty()) return !column.is_detail;
  return has(selection.columns, name_in_tables(column)) || has(selection.columns, results::name(column));
}

/// In the order in which the user gave them.
std::vector<results::Shown> shown_of(const Selection& selection, const results::Schema& schema) {
  if (selection.columns.empty() || schema.shown_table.empty()) return schema.shown;
  std::vector<results::Shown> shown;
  for (const std::string& name : selection.columns)
    for (const results::Table& table : schema.tables) {
      if (table.key != schema.shown_table) continue;
      for (const results::Column& column : table.columns) {
        if (name != name_in_tables(column) && name != results::name(column)) continue;
        const auto known = std::find_if(schema.shown.begin(), schema.shown.end(),
                                        [&](const auto& each) { return each.path == column.path; });
        shown.push_back(
            known != schema.shown.end()
                ? *known
                : results::Shown{results::with_unit(name_in_tables(column), column.unit), column.path});
      }
    }
  return shown;
}

template <class Kept>
results::Cells cells_of(const results::Cells& all, const Kept& kept) {
  results::Cells some;
  std::visit(
      [&](const auto& values) {
        auto& to = some.of.emplace<std::decay_t<decltype(values)>>();
        for (const std::size_t i : kept) to.push_back(values[i]);
      },
      all.of);
  if (!all.absent.empty())
    for (const std::size_t i : kept) some.absent.push_back(all.absent[i]);
  return some;
}

/// The text of a cell, in columns of texts and of values of any type; "" if it is none.
std::string text_in(const results::Cells& cells, std::size_t row) {
  if (const auto* texts = std::get_if<std::vector<std::string>>(&cells.of)) return (*texts)[row];
  const auto* values = std::get_if<std::vector<results::Value>>(&cells.of);
  const auto* text = values != nullptr ? std::get_if<std::string>(&(*values)[row].get()) : nullptr;
  return text != nullptr ? *text : "";
}

/// The rows whose kind is selected; those of a table without kinds.
std::vector<std::size_t> rows_of(const Selection& selection, const results::Table& table,
                                 const results::Rows& rows) {
  std::vector<std::size_t> kept;
  const auto column = std::find_if(table.columns.begin(), table.columns.end(), [](const auto& each) {
    return each.path == std::vector<std::string>{kind_column};
  });
  const auto at = static_cast<std::size_t>(column - table.columns.begin());
  const bool all = selection.events.empty() || column == table.columns.end() || at >= rows.columns.size();
  for (std::size_t i = 0; i < rows.count; ++i)
    if (all || has(selection.events, text_in(rows.columns[at], i))) kept.push_back(i);
  return kept;
}

}  // namespace

std::string name_in_tables(const results::Column& column) {
  const std::string name = results::name(column), elements = "elements.";
  return name.starts_with(elements) ? name.substr(elements.size()) : name;
}

void check_selection(const Selection& selection, std::span<const results::Schema> schemas,
                     const std::string& prefix) {
  std::vector<std::string> known, names_too;  // also with "elements"
  for (const results::Schema& schema : schemas)
    for (const results::Table& table : schema.tables)
      for (const results::Column& column : table.columns)
        if (const std::string name = name_in_tables(column); !has(known, name)) {
          known.push_back(name);
          names_too.push_back(results::name(column));
        }
  const auto check = [&](const char* of, const std::string& word, const std::vector<std::string>& all) {
    if (has(all, word)) return;
    std::string text;
    for (const std::string& name : all) text += (text.empty() ? "" : ", ") + results::visible(name);
    std::string near = scene::nearest(word, all);
    const auto longer =
        std::find_if(all.begin(), all.end(), [&](const auto& name) { return name.starts_with(word); });
    if (near.empty() && longer != all.end() && !word.empty()) near = *longer;
    throw std::invalid_argument(prefix + of + " " + results::visible(word) + ": must be of " + text +
                                (near.empty() ? "" : "; did you mean " + results::visible(near) + "?"));
  };
  for (const std::string& column : selection.columns)
    if (!has(names_too, column)) check("columns", column, known);
  std::vector<std::string> names{no_events};
  for (const auto& kind : kinds::all) names.emplace_back(kind.name);
  for (const std::string& event : selection.events) check("events", event, names);
}

Selected::Selected(std::unique_ptr<results::Sink> to, Selection selection, bool of_tables)
    : to_(std::move(to)), selection_(std::move(selection)), of_tables_(of_tables) {}

void Selected::begin(const results::Header& header, std::span<const results::Schema> schemas) {
  all_.assign(schemas.begin(), schemas.end());
  std::vector<results::Schema> some = all_;
  for (results::Schema& schema : some) {
    schema.shown = shown_of(selection_, schema);
    for (results::Table& table : schema.tables)
      if (of_tables_)
        std::erase_if(table.columns, [&](const auto& column) { return !is_selected(selection_, column); });
  }
  to_->begin(header, some);
}

void Selected::curve(const results::Head& head, std::size_t schema) {
  schema_ = schema;
  to_->curve(head, schema);
}

void Selected::rows(std::size_t table, const results::Rows& rows) {
  const results::Table& of = all_[schema_].tables[table];
  const std::vector<std::size_t> kept = rows_of(selection_, of, rows);
  results::Rows some{kept.size(), {}};
  for (std::size_t c = 0; c < rows.columns.size(); ++c)
    if (!of_tables_ || is_selected(selection_, of.columns[c]))
      some.columns.push_back(cells_of(rows.columns[c], kept));
  to_->rows(table, some);
}

}  // namespace arcslip::studies
