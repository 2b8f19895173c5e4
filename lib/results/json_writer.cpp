#include <arcslip/results/json_writer.hpp>

#include <arcslip/results/text.hpp>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <type_traits>
#include <utility>

namespace arcslip::results {
namespace {

void append(std::string& out, bool flag) {
  out += flag ? "true" : "false";
}

void append(std::string& out, long number) {
  out += std::to_string(number);
}

/// With a decimal point or an exponent, so that it is read as a floating-point number.
void append(std::string& out, double number) {
  if (!std::isfinite(number)) {
    out += "null";
    return;
  }
  const std::size_t begin = out.size();
  append_shortest(out, number);
  if (out.find_first_of(".e", begin) == std::string::npos) out += ".0";
}

void append(std::string& out, const std::string& text) {
  out += json_quoted(text);
}

void append(std::string& out, const Value& value);

template <class List>
void append_list(std::string& out, const List& list) {
  out += '[';
  const char* separator = "";
  for (const auto& each : list) {
    out += std::exchange(separator, ",");
    append(out, each);
  }
  out += ']';
}

void append(std::string& out, const Object& object) {
  out += '{';
  const char* separator = "";
  for (const Member& member : object) {
    out += std::exchange(separator, ",");
    out += json_quoted(member.key);
    out += ':';
    append(out, member.value);
  }
  out += '}';
}

void append(std::string& out, const Value& value) {
  std::visit(
      [&](const auto& is) {
        using Is = std::decay_t<decltype(is)>;
        if constexpr (std::is_same_v<Is, std::nullptr_t>)
          out += "null";
        else if constexpr (std::is_same_v<Is, Value::Numbers> || std::is_same_v<Is, Value::List>)
          append_list(out, is);
        else
          append(out, is);
      },
      value.get());
}

/// Nested keys: an object is opened where a path enters it, and closed where it leaves it.
class Members {
 public:
  explicit Members(std::string& out) : out_(out) { out_ += '{'; }

  /// quoted: the path with each key as JSON writes it. The value is to follow.
  void key(const std::vector<std::string>& quoted) {
    std::size_t level = 0;
    while (level < groups_.size() && level + 1 < quoted.size() && *groups_[level] == quoted[level]) ++level;
    leave(level);
    for (; level + 1 < quoted.size(); ++level) {
      add(quoted[level]);
      out_ += '{';
      groups_.push_back(&quoted[level]);
    }
    add(quoted.back());
  }

  void end() {
    leave(0);
    out_ += '}';
  }

 private:
  void leave(std::size_t level) {
    for (; groups_.size() > level; groups_.pop_back()) out_ += '}';
  }

  void add(const std::string& key) {
    if (out_.back() != '{') out_ += ',';
    (out_ += key) += ':';
  }

  std::string& out_;
  std::vector<const std::string*> groups_;
};

}  // namespace

std::string json(const Value& value) {
  std::string text;
  append(text, value);
  return text;
}

/// The rows of a table so far, which may be taken away.
class JsonWriter::TableText {
 public:
  explicit TableText(const Table& table) : by_columns_(table.by_columns), columns_(table.columns.size()) {
    for (const Column& column : table.columns) {
      paths_.emplace_back();
      for (const std::string& key : column.path) paths_.back().push_back(json_quoted(key));
    }
    for (const std::string& key : table.objects) {
      objects_.push_back({{json_quoted(key)}, {}});
      for (std::size_t c = 0; c < table.columns.size(); ++c)
        if (table.columns[c].path.size() > 1 && table.columns[c].path.front() == key)
          objects_.back().columns.push_back(c);
    }
  }

  void add(const Rows& rows) {
    for (std::size_t i = 0; i < rows.count && !by_columns_; ++i) add_row(rows, i);
    for (std::size_t c = 0; c < rows.columns.size() && by_columns_; ++c) add_column(rows.columns[c], c);
  }

  /// All rows so far, with all brackets except the first.
  std::string rest() {
    if (!by_columns_) return take() + "]";
    std::string all;
    Members members(all);
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      members.key(paths_[c]);
      (all += columns_[c].empty() ? "[" : columns_[c]) += ']';
    }
    members.end();
    return all;
  }

  std::string take() { return std::exchange(text_, {}); }
  bool by_columns() const { return by_columns_; }

 private:
  void add_row(const Rows& rows, std::size_t i) {
    text_ += std::exchange(separator_, ",\n");
    Members members(text_);
    const auto has = [&](std::size_t c) {
      return rows.columns[c].absent.empty() || !rows.columns[c].absent[i];
    };
    for (std::size_t c = 0; c < rows.columns.size(); ++c) {
      if (!has(c)) continue;
      members.key(paths_[c]);
      std::visit([&](const auto& of) { append_cell(of, i); }, rows.columns[c].of);
    }
    for (const auto& [key, columns] : objects_) {
      if (std::any_of(columns.begin(), columns.end(), has)) continue;
      members.key(key);
      text_ += "{}";
    }
    members.end();
  }

  void add_column(const Cells& cells, std::size_t c) {
    std::visit(
        [&](const auto& of) {
          for (std::size_t i = 0; i < of.size(); ++i) {
            if (!cells.absent.empty() && cells.absent[i]) continue;
            columns_[c] += columns_[c].empty() ? '[' : ',';
            std::swap(text_, columns_[c]);
            append_cell(of, i);
            std::swap(text_, columns_[c]);
          }
        },
        cells.of);
  }

  template <class Of>
  void append_cell(const Of& of, std::size_t i) {
    append(text_, static_cast<typename Of::value_type>(of[i]));
  }

  struct Group {
    std::vector<std::string> key;      // quoted
    std::vector<std::size_t> columns;  // in it
  };

  bool by_columns_;
  std::vector<std::vector<std::string>> paths_;
  std::vector<Group> objects_;
  std::vector<std::string> columns_;
  std::string text_;
  const char* separator_ = "\n";
};

namespace {

Object units_of(std::span<const Column> columns) {
  Object units;
  for (const Column& column : columns)
    if (!column.unit.empty() && column.unit != "-") units.push_back({name(column), column.unit});
  return units;
}

/// By list, table and column; of several schemas of one list together.
Object units_of(std::span<const Schema> schemas) {
  Object lists;
  const auto add = [](Object to, const Object& more) {
    for (const Member& each : more)
      if (std::none_of(to.begin(), to.end(), [&](const Member& is) { return is.key == each.key; }))
        to.push_back(each);
    return to;
  };
  const auto at = [](Object& of, const std::string& key) -> Object& {
    auto found = std::find_if(of.begin(), of.end(), [&](const Member& member) { return member.key == key; });
    if (found == of.end()) found = of.insert(of.end(), {key, Object()});
    return found->value.members();
  };
  for (const Schema& schema : schemas) {
    if (Object set = units_of(schema.set); !set.empty()) {
      Object& known = at(at(lists, schema.list), "set");
      known = add(known, set);
    }
    for (const Table& table : schema.tables)
      if (Object units = units_of(table.columns); !units.empty()) {
        Object& known = at(at(lists, schema.list), table.key);
        known = add(known, units);
      }
  }
  return lists;
}

}  // namespace

JsonWriter::JsonWriter(std::ostream& out) : out_(out) {}
JsonWriter::~JsonWriter() = default;

void JsonWriter::begin(const Header& header, std::span<const Schema> schemas) {
  schemas_.assign(schemas.begin(), schemas.end());
  const bool one = std::all_of(schemas.begin(), schemas.end(),
                               [&](const Schema& schema) { return schema.list == schemas.front().list; });
  out_ << "{\"format\": "
       << json_quoted(one && !schemas.empty() ? schemas.front().format : "arcslip-results-1")
       << ",\n\"program\": " << json_quoted(header.program)
       << ",\n\"scene_hash\": " << json_quoted(header.scene_hash)
       << ",\n\"title\": " << json_quoted(header.title)
       << ",\n\"frequency_unit\": " << json_quoted(header.frequency_unit);
  if (!header.notes.empty())
    out_ << ",\n\"notes\": " << json(Value::List(header.notes.begin(), header.notes.end()));
  if (const Object units = units_of(schemas_); !units.empty()) out_ << ",\n\"units\": " << json(units);
  if (!header.reduction.empty()) out_ << ",\n\"reduction\": " << json(header.reduction);
}

void JsonWriter::open(const std::string& list) {
  if (list == list_) return;
  close();
  out_ << ",\n" << json_quoted(list) << ": [";
  list_ = list;
  in_list_ = 0;
  written_.push_back(list);
}

void JsonWriter::close() {
  if (list_.empty()) return;
  out_ << ']';
  if (in_list_ == 1) out_ << nearby_;
  list_.clear();
}

void JsonWriter::curve(const Head& head, std::size_t schema) {
  schema_ = &schemas_.at(schema);
  open(schema_->list);
  out_ << (in_list_++ > 0 ? ",\n{" : "\n{");
  if (!head.study.empty() || !head.kind.empty())
    out_ << "\"study\": " << json_quoted(head.study) << ", \"kind\": " << json_quoted(head.kind) << ",\n";
  out_ << "\"id\": " << in_list_;
  if (head.parent > 0) out_ << ", \"parent\": " << in_list_ - head.parent;
  out_ << ",\n";
  for (const Member& fact : head.facts) out_ << json_quoted(fact.key) << ": " << json(fact.value) << ",\n";
  out_ << "\"set\": " << json(head.set);
  tables_.clear();
  for (const Table& table : schema_->tables) tables_.push_back(std::make_unique<TableText>(table));
  if (!tables_.empty() && !tables_.front()->by_columns())
    out_ << ",\n" << json_quoted(schema_->tables.front().key) << ": [";
}

void JsonWriter::rows(std::size_t table, const Rows& rows) {
  tables_.at(table)->add(rows);
  if (table == 0 && !tables_.front()->by_columns()) out_ << tables_.front()->take();
}

void JsonWriter::end(const End& end) {
  for (std::size_t t = 0; t < tables_.size(); ++t) {
    const bool by_columns = tables_[t]->by_columns();
    if (t > 0 || by_columns)
      out_ << ",\n" << json_quoted(schema_->tables[t].key) << (by_columns ? ": " : ": [");
    out_ << tables_[t]->rest();
  }
  Object all{{"status", name(end.status)}, {"stop", end.stop}};
  if (!end.doubt.empty()) all.push_back({"doubt", end.doubt});
  all.insert(all.end(), end.facts.begin(), end.facts.end());
  if (in_list_ == 1) nearby_.clear();
  for (const Member& fact : all) {
    const std::string text = json(fact.value);
    out_ << ",\n" << json_quoted(fact.key) << ": " << text;
    if (in_list_ == 1 && std::count(schema_->nearby.begin(), schema_->nearby.end(), fact.key) > 0)
      nearby_ += ",\n" + json_quoted(fact.key) + ": " + text;
  }
  out_ << '}';
  schema_ = nullptr;
}

void JsonWriter::finish() {
  close();
  for (const Schema& schema : schemas_) {
    if (std::find(written_.begin(), written_.end(), schema.list) != written_.end()) continue;
    open(schema.list);
    close();
  }
  out_ << "}\n";
}

void write_json(std::ostream& out, const Results& results) {
  JsonWriter writer(out);
  replay(results, writer);
}

}  // namespace arcslip::results
