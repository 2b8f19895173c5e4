#include <arcslip/results/result.hpp>

#include <arcslip/results/text.hpp>

#include <algorithm>
#include <utility>

namespace arcslip::results {

std::string name(const Column& column) {
  std::string all;
  for (const std::string& key : column.path) all += (all.empty() ? "" : ".") + key;
  return all;
}

std::string assignment(const Object& set) {
  std::string text;
  for (const Member& member : set) {
    const auto* number = std::get_if<double>(&member.value.get());
    text.append(text.empty() ? "" : ", ").append(visible(member.key)).append(" = ");
    text += number ? quantity(*number, member.unit) : "-";
  }
  return text;
}

Object object(std::span<const Column> columns, const Rows& rows, std::size_t row) {
  Object all;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const Cells& cells = rows.columns[c];
    if (!cells.absent.empty() && cells.absent[row]) continue;
    Object* group = &all;
    const std::vector<std::string>& path = columns[c].path;
    for (std::size_t level = 0; level + 1 < path.size(); ++level) {
      if (group->empty() || group->back().key != path[level]) group->push_back({path[level], Object()});
      group = &group->back().value.members();
    }
    std::visit(
        [&](const auto& list) {
          using Cell = typename std::decay_t<decltype(list)>::value_type;
          group->push_back({path.back(), Value(static_cast<Cell>(list[row])), columns[c].unit});
        },
        cells.of);
  }
  return all;
}

namespace {

// Appends rows of the same columns.
void append_rows(const Rows& more, Rows& all) {
  for (std::size_t c = 0; c < all.columns.size(); ++c) {
    Cells& to = all.columns[c];
    const Cells& from = more.columns[c];
    if (!to.absent.empty() || !from.absent.empty()) {
      to.absent.resize(all.count, false);
      to.absent.insert(to.absent.end(), from.absent.begin(), from.absent.end());
      to.absent.resize(all.count + more.count, false);
    }
    std::visit(
        [&](auto& list) {
          const auto& others = std::get<std::decay_t<decltype(list)>>(from.of);
          list.insert(list.end(), others.begin(), others.end());
        },
        to.of);
  }
  all.count += more.count;
}

}  // namespace

void hand(const Result& result, std::size_t schema, Sink& sink) {
  sink.curve(result.head, schema);
  for (std::size_t t = 0; t < result.tables.size(); ++t) sink.rows(t, result.tables[t]);
  sink.end(result.end);
}

void replay(const Results& results, Sink& sink) {
  sink.begin(results.header, results.schemas);
  for (auto schema = results.schemas.begin(); schema != results.schemas.end(); ++schema) {
    const auto in_list = [&](const Schema& other) { return other.list == schema->list; };
    if (std::find_if(results.schemas.begin(), schema, in_list) != schema)
      continue;  // done with the first of them
    for (const Result& result : results.results)
      if (in_list(results.schemas[result.schema])) hand(result, result.schema, sink);
  }
  sink.finish();
}

void Collector::begin(const Header& header, std::span<const Schema> schemas) {
  results = {header, {schemas.begin(), schemas.end()}, {}};
}

void Collector::curve(const Head& head, std::size_t schema) {
  results.results.push_back({schema, head, {}, {}});
  results.results.back().tables.resize(results.schemas[schema].tables.size());
}

void Collector::rows(std::size_t table, const Rows& rows) {
  Rows& all = results.results.back().tables[table];
  if (all.count == 0)
    all = rows;
  else
    append_rows(rows, all);
}

void Collector::end(const End& end) {
  results.results.back().end = end;
}

}  // namespace arcslip::results
