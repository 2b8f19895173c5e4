#pragma once
// Results of nothing: two kinds with every type of cell, and a sink that is fed in parts.

#include <arcslip/results/table_of.hpp>

#include <optional>
#include <string>
#include <vector>

namespace made_up {

using namespace arcslip::results;

struct Item {
  double number = 0;
  long whole = 0;
  bool flag = false;
  std::string text{};
  std::vector<double> list{};
  std::optional<double> inner{};
};

inline TableOf<Item> table() {
  TableOf<Item> table;
  table.add({"x"}, "m", "a number", [](const Item& item) { return item.number; });
  table.add({"i"}, "", "a whole number", [](const Item& item) { return item.whole; });
  table.add({"yes"}, "", "a flag", [](const Item& item) { return item.flag; });
  table.add({"word"}, "", "a text", [](const Item& item) { return item.text; });
  table.add({"list"}, "", "a list", [](const Item& item) { return item.list; });
  table.add({"elements", "d", "load"}, "N", "within", [](const Item& item) { return item.inner; });
  table.add({"elements", "d", "deep", "er"}, "", "within", [](const Item& item) { return item.inner; });
  table.add({"last"}, "", "behind a group", [](const Item& item) { return 2 * item.number; });
  return table;
}

/// Results of two studies: things with two tables, and others that are written by columns.
inline Results results() {
  Results all{{"program 1", "hash", "A \"title\"\n", "Hz"}, {}, {}};
  all.schemas.push_back(
      {.format = "things-1",
       .list = "things",
       .noun = "thing",
       .tables = {{"rows", table().columns(), {"elements"}}, {"marks", table().columns(), {"elements"}}},
       .set = {{{"load"}, Type::number, "N"}},
       .nearby = {"best", "stop"}});
  all.schemas.push_back({.format = "others-1",
                         .list = "others",
                         .noun = "other",
                         .tables = {{"rows", {table().columns()[0], table().columns()[5]}, {}, true}}});
  const std::vector<Item> items{{0.1, 1, true, "=a, \"b\"", {1, 0.5}, 3.0}, {-0.0, -2, false, "", {}, {}}};
  all.results.push_back(
      {0,
       {"first", "kind", {{"load", 2.5, "N"}}, {{"over", "x"}}},
       {table().rows(items), table().rows(std::vector{items[1]})},
       {Status::complete, {{"reason", "end"}, {"value", 1.0}}, {{"best", Object{{"x", 1.5, "m"}}}}}});
  TableOf<Item> some;
  some.add({"x"}, "m", "", [](const Item& item) { return item.number; });
  some.add({"elements", "d", "load"}, "N", "", [](const Item& item) { return item.inner.value_or(7); });
  all.results.push_back({1, {}, {some.rows(items)}, {Status::failed, {{"reason", "other"}}}});
  return all;
}

}  // namespace made_up
