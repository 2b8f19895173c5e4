#include "catch.hpp"
#include "lib/results/made_up.hpp"

#include <arcslip/results/csv_writer.hpp>

#include <sstream>
#include <string>
#include <vector>

using namespace arcslip::results;

namespace {

std::vector<std::string> lines(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> all;
  for (std::string line; std::getline(in, line);) {
    REQUIRE(line.ends_with('\r'));
    all.push_back(line.substr(0, line.size() - 1));
  }
  return all;
}

std::vector<std::string> csv_lines(const Results& results, const std::string& table) {
  std::ostringstream text;
  write_csv(text, results, table);
  return lines(text.str());
}

std::vector<std::string> summary(const Results& results) {
  std::ostringstream text;
  write_csv_summary(text, results);
  return lines(text.str());
}

}  // namespace

TEST_CASE("a table as CSV has the study, what is set, the number of the result, and its columns with units") {
  Results results = made_up::results();
  results.schemas.pop_back();
  results.results.pop_back();
  CHECK(csv_lines(results, "rows") ==
        std::vector<std::string>{"study,load (N),thing,x (m),i,yes,word,list,d.load (N),d.deep.er,last",
                                 "first,2.5,1,0.1,1,true,\"'=a, \"\"b\"\"\",\"[1.0,0.5]\",3,3,0.2",
                                 "first,2.5,1,-0,-2,false,,[],,,-0"});
  CHECK(csv_lines(results, "marks").size() == 2);
  CHECK_THROWS_WITH(csv_lines(results, "none"), "the results have no table \"none\", but: rows, marks");
}

TEST_CASE("a table as CSV that several kinds have holds the columns of all") {
  CHECK(csv_lines(made_up::results(), "rows")[3] == ",,,1,0.1,,,,,3,,");
}

TEST_CASE("a parameter that one study sets and another is over is one column") {
  Results results = made_up::results();
  results.schemas[1].tables[0].columns[0] = {{"load"}, Type::number, "N"};
  const auto rows = csv_lines(results, "rows");
  CHECK(rows[0] == "study,thing,other,x (m),i,yes,word,list,d.load (N),d.deep.er,last,load (N)");
  CHECK(rows[2].ends_with(",2.5"));
  CHECK(rows[3].ends_with(",0.1"));
}

TEST_CASE("the summary as CSV has a row for each result, with all facts that are not lists") {
  CHECK(summary(made_up::results()) ==
        std::vector<std::string>{
            "study,kind,load (N),thing,other,over,status,stop.reason,stop.value,best.x (m)",
            "first,kind,2.5,1,,x,complete,end,1,1.5", ",,,,1,,failed,other,,"});
  Results doubtful = made_up::results();
  doubtful.results[0].end.doubt = "hardly, so";
  CHECK(summary(doubtful)[0] ==
        "study,kind,load (N),thing,other,over,status,stop.reason,stop.value,doubt,best.x (m)");
  CHECK(summary(doubtful)[1] == "first,kind,2.5,1,,x,complete,end,1,\"hardly, so\",1.5");
}

TEST_CASE("what is not finite is an empty cell") {
  Results results = made_up::results();
  const std::vector<made_up::Item> items{{HUGE_VAL, 1, true, "", {}, -HUGE_VAL}};
  results.results[0].tables[0] = made_up::table().rows(items);
  for (const std::string& row : csv_lines(results, "rows")) CHECK(row.find("inf") == std::string::npos);
}
