#include "result_file.hpp"

#include "interrupt.hpp"
#include "output/message.hpp"
#include "output/standard_output.hpp"

#include <arcslip/results/table_writer.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/scene/keys/json_tree.hpp>
#include <arcslip/scene/keys/read_text.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/presentation/selection.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <map>
#include <memory>
#include <ostream>
#include <sstream>
#include <utility>
#include <vector>

namespace arcslip::app {
namespace {

using results::Column;
using results::Value;
using scene::file::Node;

constexpr std::size_t facts_shown = 8;

const Node* member(const Node::Object& object, std::string_view key) {
  for (const auto& each : object)
    if (each.key == key) return &each.value;
  return nullptr;
}

std::string text_at(const Node::Object& object, std::string_view key) {
  const Node* node = member(object, key);
  const auto* text = node != nullptr ? node->get<std::string>() : nullptr;
  return text != nullptr ? *text : "";
}

results::Object object_of(const Node::Object& object);

Value value_of(const Node& node) {
  if (const auto* flag = node.get<bool>()) return {*flag};
  if (const auto* number = node.get<double>()) return {*number};
  if (const auto* text = node.get<std::string>()) return {*text};
  if (const auto* object = node.get<Node::Object>()) return {object_of(*object)};
  const auto* list = node.get<Node::List>();
  if (list == nullptr) return {};
  const bool are_numbers =
      std::all_of(list->begin(), list->end(), [](const Node& each) { return each.get<double>() != nullptr; });
  if (are_numbers && !list->empty()) {
    Value::Numbers numbers;
    for (const Node& each : *list) numbers.push_back(*each.get<double>());
    return {std::move(numbers)};
  }
  Value::List values;
  for (const Node& each : *list) values.push_back(value_of(each));
  return {std::move(values)};
}

results::Object object_of(const Node::Object& object) {
  results::Object all;
  for (const auto& each : object) all.push_back({each.key, value_of(each.value)});
  return all;
}

/// Rows of a JSON table, as values by the paths of their columns.
class TableOfFile {
 public:
  explicit TableOfFile(const Node::Object* units) : units_(units) {}

  void add_row(const Node::Object& row) {
    add({}, row);
    ++rows_;
  }
  /// A table by columns: lists by name.
  void add_lists(const Node::Object& lists, const std::vector<std::string>& path = {}) {
    for (const auto& each : lists) {
      std::vector<std::string> at = path;
      at.push_back(each.key);
      if (const auto* inner = each.value.get<Node::Object>()) add_lists(*inner, at);
      const auto* list = each.value.get<Node::List>();
      for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
        put(at, i, value_of((*list)[i]));
        rows_ = std::max(rows_, i + 1);
      }
    }
  }
  const std::vector<Column>& columns() const { return columns_; }
  /// All rows, in the columns of the list.
  results::Rows rows(const std::vector<Column>& of) const {
    results::Rows all{rows_, {}};
    for (const Column& column : of) {
      std::vector<Value> values(rows_);
      results::Cells cells;
      cells.absent.assign(rows_, true);
      if (const auto found = cells_.find(column.path); found != cells_.end())
        for (const auto& [row, value] : found->second) {
          values[row] = value;
          cells.absent[row] = false;
        }
      cells.of = std::move(values);
      all.columns.push_back(std::move(cells));
    }
    return all;
  }

 private:
  void add(const std::vector<std::string>& path, const Node::Object& row) {
    for (const auto& each : row) {
      std::vector<std::string> at = path;
      at.push_back(each.key);
      if (const auto* inner = each.value.get<Node::Object>())
        add(at, *inner);
      else
        put(at, rows_, value_of(each.value));
    }
  }

  void put(const std::vector<std::string>& path, std::size_t row, Value value) {
    auto [found, is_new] = cells_.try_emplace(path);
    if (is_new) {
      Column column{path, results::Type::value};
      if (units_ != nullptr) column.unit = text_at(*units_, results::name(column));
      columns_.push_back(std::move(column));
    }
    found->second.emplace_back(row, std::move(value));
  }

  const Node::Object* units_;
  std::size_t rows_ = 0;
  std::vector<Column> columns_;
  std::map<std::vector<std::string>, std::vector<std::pair<std::size_t, Value>>> cells_;
};

const Node::Object* object_at(const Node::Object* object, std::string_view key) {
  const Node* node = object != nullptr ? member(*object, key) : nullptr;
  return node != nullptr ? node->get<Node::Object>() : nullptr;
}

bool is_table(const Node& node) {
  const auto* list = node.get<Node::List>();
  return list != nullptr && !list->empty() && list->front().get<Node::Object>() != nullptr;
}

/// A result, with its tables apart.
struct ResultOfFile {
  results::Result result;
  std::map<std::string, TableOfFile> tables;
};

ResultOfFile result_of(const Node::Object& object, const Node::Object* units) {
  ResultOfFile read;
  results::Result& result = read.result;
  for (const auto& each : object) {
    if (each.key == "study")
      result.head.study = text_at(object, "study");
    else if (each.key == "kind")
      result.head.kind = text_at(object, "kind");
    else if (each.key == "set" && each.value.get<Node::Object>() != nullptr) {
      for (const auto& value : *each.value.get<Node::Object>()) {
        const Node::Object* of_set = object_at(units, "set");
        result.head.set.push_back(
            {value.key, value_of(value.value), of_set ? text_at(*of_set, value.key) : ""});
      }
    } else if (each.key == "status") {
      const std::string status = text_at(object, "status");
      result.end.status = status == "complete"  ? results::Status::complete
                          : status == "stopped" ? results::Status::stopped
                                                : results::Status::failed;
    } else if (each.key == "stop" && each.value.get<Node::Object>() != nullptr) {
      result.end.stop = object_of(*each.value.get<Node::Object>());
    } else if (each.key == "doubt") {
      result.end.doubt = text_at(object, "doubt");
    } else if (is_table(each.value)) {
      TableOfFile& table = read.tables.try_emplace(each.key, object_at(units, each.key)).first->second;
      for (const Node& row : *each.value.get<Node::List>())
        if (const auto* members = row.get<Node::Object>()) table.add_row(*members);
    } else if (each.key != "id" && each.key != "parent") {
      result.end.facts.push_back({each.key, value_of(each.value)});
    }
  }
  return read;
}

void add_columns(const std::vector<Column>& from, std::vector<Column>& to) {
  for (const Column& column : from)
    if (std::none_of(to.begin(), to.end(), [&](const Column& known) { return known.path == column.path; }))
      to.push_back(column);
}

/// The unit of a fact: that of a column of its name in any table, or that of quantities of responses.
std::string unit_of_fact(const std::string& name, const Node::Object* units, const std::string& frequency) {
  if (units != nullptr)
    for (const auto& table : *units)
      if (const auto* columns = table.value.get<Node::Object>(); columns != nullptr)
        if (const std::string unit = text_at(*columns, name); !unit.empty()) return unit;
  if (name == "frequency") return frequency;
  if (name == "amplitude" || name == "truncation_estimate") return "m";
  if (name == "omega") return "rad/s";
  if (name == "phase") return "rad";
  return name.starts_with("energy_") ? "J" : "";
}

/// The first facts: numbers of the optimum, then others that are numbers or texts.
std::vector<results::Shown> shown_facts(const results::Object& facts, const Node::Object* units,
                                        const std::string& frequency) {
  std::vector<results::Shown> shown;
  const auto add = [&](const std::string& title, std::vector<std::string> path) {
    if (shown.size() < facts_shown)
      shown.push_back(
          {.title = title, .path = std::move(path), .unit = unit_of_fact(title, units, frequency)});
  };
  for (const results::Member& fact : facts) {
    const auto* optimum = std::get_if<results::Object>(&fact.value.get());
    if (optimum == nullptr || fact.key != "optimum") continue;
    for (const results::Member& each : *optimum)
      if (std::holds_alternative<double>(each.value.get())) add(each.key, {fact.key, each.key});
  }
  for (const results::Member& fact : facts)
    if (std::holds_alternative<double>(fact.value.get()) ||
        std::holds_alternative<std::string>(fact.value.get()))
      add(fact.key, {fact.key});
  return shown;
}

/// The parameter that curves are over: the first column of their points, if it is none of a response.
std::string parameter_over(const results::Schema& schema) {
  for (const results::Table& table : schema.tables)
    if (table.key == "points" && !table.columns.empty())
      if (const std::string first = results::name(table.columns.front());
          first != "omega" && first != "frequency")
        return first;
  return "";
}

/// What people are shown of events.
std::vector<results::Shown> shown_in(const results::Schema& schema) {
  std::vector<results::Shown> shown;
  const std::string over = parameter_over(schema);
  for (const results::Table& table : schema.tables)
    for (const Column& column : table.columns) {
      const std::string name = results::name(column);
      const bool is_usual = name == over || name == "kind" || name == "frequency" || name == "amplitude" ||
                            name == "stable" || name == "damping_ratio" || name.ends_with(".stick_percent");
      if (table.key == schema.shown_table && is_usual)
        shown.push_back({.title = studies::name_in_tables(column), .path = column.path, .unit = column.unit});
    }
  return shown;
}

/// Adds the results of a list, with a schema of all columns that any of them has.
void add_list(const std::string& list, const Node::List& objects, const Node::Object* units,
              results::Results& to) {
  std::vector<ResultOfFile> read;
  results::Schema schema{
      .format = "", .list = list, .noun = list == "branches" ? "branch" : "result", .tables = {}};
  for (const Node& each : objects)
    if (const auto* object = each.get<Node::Object>())
      read.push_back(result_of(*object, object_at(units, list)));
  for (const ResultOfFile& each : read) {
    for (const auto& [key, table] : each.tables) {
      auto known = std::find_if(schema.tables.begin(), schema.tables.end(),
                                [&](const results::Table& is) { return is.key == key; });
      if (known == schema.tables.end()) known = schema.tables.insert(known, {key, {}});
      add_columns(table.columns(), known->columns);
      if (key == "events") schema.shown_table = key;
    }
    for (const results::Member& set : each.result.head.set)
      add_columns({{{set.key}, results::Type::number, set.unit}}, schema.set);
  }
  if (schema.shown_table.empty() && !read.empty())
    schema.shown =
        shown_facts(read.front().result.end.facts, object_at(units, list), to.header.frequency_unit);
  else
    schema.shown = shown_in(schema);
  for (ResultOfFile& each : read) {
    each.result.schema = to.schemas.size();
    for (const results::Table& table : schema.tables) {
      const auto found = each.tables.find(table.key);
      each.result.tables.push_back(found != each.tables.end() ? found->second.rows(table.columns)
                                                              : TableOfFile(nullptr).rows(table.columns));
    }
    to.results.push_back(std::move(each.result));
  }
  to.schemas.push_back(std::move(schema));
}

}  // namespace

bool is_ensemble(const std::string& path) {
  constexpr std::string_view begins = "SQLite format 3";
  std::array<char, begins.size()> head{};
  std::ifstream in(path, std::ios::binary);
  return in.read(head.data(), head.size()) && std::string_view(head.data(), head.size()) == begins;
}

results::Results read_results(const std::string& path) {
  if (is_ensemble(path))
    throw UsageError(
        results::visible(path) +
        " is the file of an ensemble: arcslip plot draws its histograms, and arcslip ensemble with "
        "--csv writes its samples");
  const auto refuse = [&](const std::string& why) {
    throw UsageError(results::visible(path) + " holds no results of arcslip" + why +
                     ": give a JSON file that --json or a folder of results has");
  };
  Node root;
  try {
    root = scene::file::read_tree(scene::file::read_text(path, by_signal(), "file of results"), by_signal());
  } catch (const scene::SceneError& error) {
    refuse(" (" + error.faults().front().message + ")");
  }
  const auto* object = root.get<Node::Object>();
  if (object == nullptr || !text_at(*object, "format").starts_with("arcslip-") ||
      member(*object, "scene_hash") == nullptr)
    refuse("");
  results::Results all;
  all.header = {text_at(*object, "program"), text_at(*object, "scene_hash"), text_at(*object, "title"),
                text_at(*object, "frequency_unit")};
  const Node::Object* units = object_at(object, "units");
  for (const auto& each : *object) {
    const auto* list = each.value.get<Node::List>();
    if (list == nullptr || list->empty()) continue;
    const auto* first = list->front().get<Node::Object>();
    if (first != nullptr && member(*first, "status") != nullptr) add_list(each.key, *list, units, all);
  }
  return all;
}

ExitCode show_results(const CommandOptions& options) {
  const results::Results all = read_results(options.files[0]);
  const studies::Selection selection{options.columns, options.events};
  studies::check_selection(selection, all.schemas, "--");
  std::ostringstream tables;
  if (!all.header.title.empty()) tables << all.header.title << '\n';
  tables << all.header.program << ", scene " << all.header.scene_hash << "\n\n";
  studies::Selected table(std::make_unique<results::TableWriter>(tables), selection, false);
  results::replay(all, table);
  results::Remarks remarks;
  results::replay(all, remarks);
  for (const auto* sentences : {&remarks.early_ends, &remarks.doubts})
    for (const std::string& sentence : *sentences) tell(sentence);
  StandardOutput screen;
  screen.write_lines([&](std::ostream& out) { out << tables.str(); });
  screen.finish();
  return ExitCode::done;
}

}  // namespace arcslip::app
