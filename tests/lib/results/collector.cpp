#include "catch.hpp"
#include "lib/results/made_up.hpp"

#include <arcslip/results/json_writer.hpp>

#include <sstream>
#include <variant>

using namespace arcslip::results;

namespace {

Rows row_of(const Rows& rows, std::size_t i) {
  Rows one{1, {}};
  for (const Cells& column : rows.columns) {
    Cells& cell = one.columns.emplace_back();
    std::visit([&](const auto& list) { cell.of = std::decay_t<decltype(list)>(1, list[i]); }, column.of);
    if (!column.absent.empty() && column.absent[i]) cell.absent = {true};
  }
  return one;
}

}  // namespace

TEST_CASE("a collector keeps what it is given, rows in as many parts as one likes") {
  const Results all = made_up::results();
  Collector collector;
  collector.begin(all.header, all.schemas);
  std::size_t parts = 0;
  for (const Result& result : all.results) {
    collector.curve(result.head, result.schema);
    for (std::size_t t = 0; t < result.tables.size(); ++t)
      for (std::size_t i = 0; i < result.tables[t].count; ++i) {
        collector.rows(t, row_of(result.tables[t], i));
        ++parts;
      }
    collector.end(result.end);
  }
  collector.finish();
  CHECK(parts > 2);
  std::ostringstream a, b;
  write_json(a, all);
  write_json(b, collector.results);
  CHECK(a.str() == b.str());
}
