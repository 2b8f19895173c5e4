#include "catch.hpp"
#include "lib/results/made_up.hpp"

#include <arcslip/results/table_writer.hpp>

#include <cmath>
#include <sstream>

using namespace arcslip::results;

namespace {

std::string printed(const Results& results) {
  std::ostringstream text;
  write_table(text, results);
  return text.str();
}

Results shown() {
  Results results = made_up::results();
  results.schemas[0].shown = {
      {"x (m)", {"x"}, "%.2f", "yes"}, {"word", {"word"}}, {"load", {"elements", "d", "load"}}};
  results.schemas[0].shown_table = "rows";
  return results;
}

}  // namespace

TEST_CASE("people see the rows of a table in aligned columns, with what is set and how each result ended") {
  CHECK(printed(shown()) ==
        "load (N)  x (m)     word  load     thing\n"
        "     2.5   0.10  =a, \"b\"     3  complete\n"
        "     2.5  -0.00              -  complete\n");
}

TEST_CASE("where there is no value a flag that is true stands in its place") {
  Results results = shown();
  std::get<std::vector<double>>(results.results[0].tables[0].columns[0].of) = {HUGE_VAL, std::nan("")};
  CHECK(printed(results).find("     2.5    yes  =a, \"b\"     3  complete\n") != std::string::npos);
  CHECK(printed(results).find("     2.5      -              -  complete\n") != std::string::npos);
}

TEST_CASE("a number has the digits that its estimated error leaves, in its own unit") {
  Results results = shown();
  results.schemas[0].shown[0].error = {"error"};
  results.schemas[0].shown[0].error_unit = 0.1;
  results.schemas[0].shown[0].format = "%.6f";
  auto& table = results.schemas[0].tables[0];
  table.columns.push_back({{"error"}, Type::number});
  results.results[0].tables[0].columns.push_back({std::vector<double>{0.003, std::nan("")}});
  CHECK(printed(results).find("     2.5      0.100  =a, \"b\"     3  complete\n") != std::string::npos);
  CHECK(printed(results).find("     2.5  -0.000000              -  complete\n") != std::string::npos);
}

TEST_CASE("where the error of a number may be too low three digits are shown at most") {
  Results results = shown();
  results.schemas[0].shown[0] = {.title = "x (m)", .path = {"x"}, .format = "%.8f", .doubtful = {"yes"}};
  std::get<std::vector<double>>(results.results[0].tables[0].columns[0].of) = {3.14159265, 3.14159265};
  CHECK(printed(results).find("     2.5        3.14  =a, ") != std::string::npos);
  CHECK(printed(results).find("     2.5  3.14159265 ") != std::string::npos);
}

TEST_CASE("without an estimate a number is as doubtful as its flag says") {
  Results results = shown();
  results.schemas[0].shown[0] = {
      .title = "x (m)", .path = {"x"}, .format = "%.8f", .error = {"error"}, .doubtful = {"yes"}};
  std::get<std::vector<double>>(results.results[0].tables[0].columns[0].of) = {3.14159265, 3.14159265};
  results.schemas[0].tables[0].columns.push_back({{"error"}, Type::number});
  results.results[0].tables[0].columns.push_back({std::vector<double>{std::nan(""), std::nan("")}});
  CHECK(printed(results).find("     2.5        3.14  =a, ") != std::string::npos);
  CHECK(printed(results).find("     2.5  3.14159265 ") != std::string::npos);  // not flagged
}

TEST_CASE("a number is doubtful where an estimate is not known") {
  Results results = shown();
  results.schemas[0].shown[0] = {
      .title = "x (m)", .path = {"x"}, .format = "%.8f", .doubtful = {"yes", "error"}};
  std::get<std::vector<double>>(results.results[0].tables[0].columns[0].of) = {1.41421356, 3.14159265};
  results.schemas[0].tables[0].columns.push_back({{"error"}, Type::number});
  auto& errors = results.results[0].tables[0].columns;
  errors.push_back({std::vector<double>{0, std::nan("")}});
  CHECK(printed(results).find("     2.5   1.41  =a, ") != std::string::npos);  // flagged
  CHECK(printed(results).find("     2.5   3.14 ") != std::string::npos);
  errors.back() = {std::vector<double>{0, 0}};
  CHECK(printed(results).find("     2.5  3.14159265 ") != std::string::npos);
}

TEST_CASE("a column with a unit has one prefix, by the largest of its numbers, and the digits that errors leave") {
  Results results = shown();
  results.schemas[0].shown[0] = {
      .title = "x", .path = {"x"}, .format = "%.8e", .error = {"error"}, .unit = "m"};
  std::get<std::vector<double>>(results.results[0].tables[0].columns[0].of) = {6.943436e-4, 8.3423774e-3};
  results.schemas[0].tables[0].columns.push_back({{"error"}, Type::number});
  auto& columns = results.results[0].tables[0].columns;
  columns.push_back({std::vector<double>{0, 4e-8}});
  CHECK(printed(results) ==
        "load (N)    x (mm)     word  load     thing\n"
        "     2.5  0.694344  =a, \"b\"     3  complete\n"
        "     2.5    8.3424              -  complete\n");
  std::get<std::vector<double>>(columns[0].of) = {std::nan(""), 42};
  CHECK(printed(results) ==
        "load (N)      x (m)     word  load     thing\n"
        "     2.5          -  =a, \"b\"     3  complete\n"
        "     2.5  42.000000              -  complete\n");
}

TEST_CASE("a result without rows has one that says so, and results of one kind share a table") {
  Results results = shown();
  results.results[1] = results.results[0];
  results.results[1].tables.clear();
  results.results[1].end.status = Status::failed;
  results.results[1].head.set[0].value = 10.0;
  CHECK(printed(results) ==
        "load (N)  x (m)     word  load     thing\n"
        "     2.5   0.10  =a, \"b\"     3  complete\n"
        "     2.5  -0.00              -  complete\n"
        "      10      -        -     -    failed\n");
}

TEST_CASE("people see facts of each result, a row for each, or its own text") {
  Results results = made_up::results();
  results.schemas[0].shown = {{"best", {"best", "x"}, "%.3f"}, {"none", {"nothing"}}};
  results.results[1].end.text = "in its own words\n";
  CHECK(printed(results) ==
        "load (N)   best  none     thing\n     2.5  1.500     -  complete\n\nin its own words\n");
}

TEST_CASE("what commands a terminal is escaped in a table") {
  Results results = shown();
  std::get<std::vector<std::string>>(results.results[0].tables[0].columns[3].of)[0] = "\x1b[31m";
  CHECK(printed(results).find("\\u001b[31m") != std::string::npos);
}

TEST_CASE(
    "what ended early, and what is complete but doubtful, is determined by its number and what it sets") {
  Results results = made_up::results();
  results.results[1].head.set = {{"load", 3.0, "N"}, {"share", 0.5}};
  results.results[1].end.stop = {{"message", "it broke"}};
  results.results[0].end.doubt = "hardly so";
  results.results[1].end.doubt = "and doubtful";  // but the failure is reported already
  Remarks remarks;
  replay(results, remarks);
  CHECK(remarks.early_ends == std::vector<std::string>{"other 2 (load = 3 N, share = 0.5) failed: it broke"});
  CHECK(remarks.doubts == std::vector<std::string>{"thing 1 (load = 2.5 N) complete, but hardly so"});
}
