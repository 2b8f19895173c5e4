#include <arcslip/ensemble/kept.hpp>

#include <arcslip/ensemble/ensemble.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/results/shown.hpp>
#include <arcslip/scene/faults.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::ensemble {
namespace {

using results::Schema;
using results::Table;

/// Returns the index of the table of events; none: results have no events.
std::optional<std::size_t> events_of(const Schema& schema) {
  for (std::size_t i = 0; i < schema.tables.size(); ++i)
    if (!schema.shown_table.empty() && schema.tables[i].key == schema.shown_table) return i;
  return std::nullopt;
}

std::string short_name(const results::Column& column) {
  const std::string whole = name(column);
  for (const std::string_view group : {"elements.", "patches."})
    if (whole.starts_with(group)) return whole.substr(group.size());
  return whole;
}

std::optional<std::size_t> column_named(const Table& table, const std::string& wanted) {
  for (const bool is_short : {false, true})
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      if ((is_short ? short_name(table.columns[c]) : name(table.columns[c])) == wanted) return c;
  return std::nullopt;
}

std::vector<std::string> split_at(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

[[noreturn]] void refuse(const std::string& name, const std::vector<std::string>& known) {
  throw UnknownQuantity("found the unknown quantity " + scene::file::shown(name) + ", must be one of " +
                        scene::file::listed(known) + scene::file::hint(name, known));
}

/// Returns the names of quantities and tables, those first that the command shows.
std::vector<std::string> names_in(const Schema& schema, const Table& events) {
  std::vector<std::string> known;
  const auto add = [&](const std::string& name) {
    if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
  };
  for (const results::Shown& each : schema.shown)
    for (const results::Column& column : events.columns)
      if (column.path == each.path && column.type != results::Type::text) add(short_name(column));
  for (const Table& table : schema.tables) add(table.key);
  for (const results::Column& column : events.columns)
    if (is_scalar(column)) add(short_name(column));
  return known;
}

Quantity quantity_of_events(const std::string& wanted, const Schema& schema, const Table& events) {
  std::string kind, of_event = wanted;
  auto column = column_named(events, wanted);
  if (const std::size_t dot = wanted.find('.'); !column && dot != std::string::npos) {
    kind = wanted.substr(0, dot);
    of_event = wanted.substr(dot + 1);
    const auto& kinds = observables::event_kinds::all;
    if (std::any_of(kinds.begin(), kinds.end(), [&](const auto& each) { return each.name == kind; }))
      column = column_named(events, of_event);
  }
  std::vector<std::string> known = names_in(schema, events);
  if (!column) {
    for (const std::string& each : names_in(schema, events)) known.push_back(kind + "." + each);
    refuse(wanted, known);
  }
  const results::Column& found = events.columns[*column];
  if (!is_scalar(found))
    throw UnknownQuantity("found " + scene::file::shown(wanted) +
                          ", a list, must be a number: keep the table \"" + events.key + "\", which has it");
  return {wanted, found.unit, found.help, kind, found.path, column};
}

bool is_table(const std::string& name, const Schema& schema, Kept& kept) {
  for (std::size_t i = 0; i < schema.tables.size(); ++i)
    if (schema.tables[i].key == name) {
      kept.tables.push_back(i);
      return true;
    }
  return false;
}

/// Adds the numbers that the command shows.
void add_defaults(const Schema& schema, const Table* events, Kept& kept) {
  kept.by_default = true;
  for (const results::Shown& each : schema.shown) {
    if (events == nullptr) {
      std::string name;
      for (const std::string& key : each.path) name += (name.empty() || key.empty() ? "" : ".") + key;
      kept.quantities.push_back({.name = name, .help = each.title, .path = each.path});
      continue;
    }
    for (const results::Column& column : events->columns)
      if (column.path == each.path && column.type != results::Type::text)
        kept.quantities.push_back(quantity_of_events(short_name(column), schema, *events));
  }
}

double number_in(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  return -std::numeric_limits<double>::infinity();
}

Cell scalar_of(const results::Value& value) {
  const auto& is = value.get();
  if (const auto* number = std::get_if<double>(&is)) return std::isfinite(*number) ? Cell(*number) : Cell();
  if (const auto* whole = std::get_if<long>(&is)) return *whole;
  if (const auto* flag = std::get_if<bool>(&is)) return static_cast<long>(*flag);
  if (const auto* text = std::get_if<std::string>(&is)) return *text;
  if (std::holds_alternative<std::nullptr_t>(is)) return {};
  return results::json(value);
}

/// An event of a sample.
struct EventAt {
  const results::Rows* rows = nullptr;
  std::size_t row = 0;
};

/// Returns the event of a kind with the largest amplitude, or the first one where none has an amplitude.
EventAt largest_event(const std::string& kind, const Table& table, std::size_t index,
                      std::span<const results::Result> all) {
  const auto amplitude = column_named(table, "amplitude"), kinds = column_named(table, "kind");
  EventAt found;
  double largest = 0;
  for (const results::Result& result : all) {
    if (result.tables.size() <= index) continue;
    const results::Rows& rows = result.tables[index];
    for (std::size_t row = 0; row < rows.count; ++row) {
      if (!kind.empty() && (!kinds || cell_of(rows.columns[*kinds], row) != Cell(kind))) continue;
      const double size = amplitude ? number_in(cell_of(rows.columns[*amplitude], row)) : 0;
      if (found.rows != nullptr && !(size > largest)) continue;
      found = {&rows, row};
      largest = size;
    }
  }
  return found;
}

const results::Result* largest_result(std::span<const results::Result> all) {
  const std::vector<std::string> amplitude = {"amplitude"};
  const results::Result* found = nullptr;
  double largest = 0;
  for (const results::Result& result : all) {
    const results::Value* value = results::find(result.end.facts, amplitude);
    const double size = value != nullptr ? number_in(scalar_of(*value)) : 0;
    if (found != nullptr && !(size > largest)) continue;
    found = &result;
    largest = size;
  }
  return found;
}

/// Returns a fact of the end of a result, or of its head.
const results::Value* fact_of(const results::Result& result, const std::vector<std::string>& path) {
  for (const results::Object* facts : {&result.end.facts, &result.head.facts}) {
    if (const results::Value* value = results::find(*facts, path)) return value;
    std::vector<std::string> in_group{"elements"};
    in_group.insert(in_group.end(), path.begin(), path.end());
    if (const results::Value* value = results::find(*facts, in_group)) return value;
  }
  return nullptr;
}

/// Adds the names of the numbers among facts.
void add_names(const results::Object& facts, const std::string& before, std::vector<std::string>& names) {
  for (const results::Member& member : facts) {
    const auto* object = std::get_if<results::Object>(&member.value.get());
    if (object != nullptr)
      add_names(*object, before + member.key + ".", names);
    else
      names.push_back(before + member.key);
  }
}

std::string unit_of(const results::Object& facts, const std::vector<std::string>& path) {
  const results::Object* group = &facts;
  for (const std::string& key : path) {
    const auto at = std::find_if(group->begin(), group->end(),
                                 [&](const results::Member& member) { return member.key == key; });
    if (at == group->end()) return {};
    if (&key == &path.back()) return at->unit;
    group = std::get_if<results::Object>(&at->value.get());
    if (group == nullptr) return {};
  }
  return {};
}

}  // namespace

bool is_scalar(const results::Column& column) {
  return column.type != results::Type::value;
}

Cell cell_of(const results::Cells& cells, std::size_t row) {
  if (!cells.absent.empty() && cells.absent[row]) return {};
  return std::visit(
      [&](const auto& list) {
        using Item = typename std::decay_t<decltype(list)>::value_type;
        if constexpr (std::is_same_v<Item, results::Value>)
          return scalar_of(list[row]);
        else
          return scalar_of(results::Value(static_cast<Item>(list[row])));
      },
      cells.of);
}

Kept read_kept(const std::string& list, const Schema& schema) {
  Kept kept;
  const auto events = events_of(schema);
  const Table* table = events ? &schema.tables[*events] : nullptr;
  if (list.empty()) add_defaults(schema, table, kept);
  for (const std::string& name : list.empty() ? std::vector<std::string>() : split_at(list, ',')) {
    if (name.empty())
      throw UnknownQuantity("found " + scene::file::shown(list) +
                            ", must be names of quantities or tables, parted by commas");
    const bool is_again = std::any_of(kept.quantities.begin(), kept.quantities.end(),
                                      [&](const Quantity& other) { return other.name == name; });
    if (is_again || is_table(name, schema, kept)) continue;
    if (table != nullptr)
      kept.quantities.push_back(quantity_of_events(name, schema, *table));
    else
      kept.quantities.push_back({.name = name, .path = split_at(name, '.')});
  }
  return kept;
}

std::vector<Cell> quantities_of(const Kept& kept, const Schema& schema,
                                std::span<const results::Result> all) {
  std::vector<Cell> cells;
  const auto events = events_of(schema);
  const results::Result* largest = largest_result(all);
  std::optional<std::pair<std::string, EventAt>> last;
  for (const Quantity& quantity : kept.quantities) {
    if (quantity.column) {
      if (!last || last->first != quantity.kind)
        last.emplace(quantity.kind, largest_event(quantity.kind, schema.tables[*events], *events, all));
      const EventAt& at = last->second;
      cells.push_back(at.rows == nullptr ? Cell() : cell_of(at.rows->columns[*quantity.column], at.row));
      continue;
    }
    const results::Value* value = largest == nullptr ? nullptr : fact_of(*largest, quantity.path);
    cells.push_back(value == nullptr ? Cell() : scalar_of(*value));
  }
  return cells;
}

void check_facts(Kept& kept, const results::Result& result) {
  for (Quantity& quantity : kept.quantities) {
    if (quantity.column) continue;
    quantity.unit = unit_of(result.end.facts, quantity.path);
    if (kept.by_default || fact_of(result, quantity.path) != nullptr) continue;
    std::vector<std::string> known;
    add_names(result.end.facts, "", known);
    refuse(quantity.name, known);
  }
}

}  // namespace arcslip::ensemble
