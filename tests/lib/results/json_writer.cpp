#include "catch.hpp"
#include "lib/results/made_up.hpp"

#include <arcslip/results/json_writer.hpp>
#include <arcslip/results/text.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <sstream>

using namespace arcslip::results;
using Json = nlohmann::json;

namespace {

Json written_json(const Results& results) {
  std::ostringstream text;
  write_json(text, results);
  return Json::parse(text.str());
}

}  // namespace

TEST_CASE("JSON has a list for each kind of results, and the format of several") {
  const Json json = written_json(made_up::results());
  CHECK(json["format"] == "arcslip-results-1");
  CHECK(json["program"] == "program 1");
  CHECK(json["title"] == "A \"title\"\n");
  CHECK(json["things"].size() == 1);
  CHECK(json["others"].size() == 1);
  CHECK(json["best"] == Json{{"x", 1.5}});  // next to the list, since there is one
  CHECK(json["stop"]["reason"] == "end");
}

TEST_CASE("a result in JSON has its head, a list of rows for each table, and its end") {
  const Json json = written_json(made_up::results())["things"][0];
  const Json second = {{"x", -0.0},
                       {"i", -2},
                       {"yes", false},
                       {"word", ""},
                       {"list", Json::array()},
                       {"elements", Json::object()},
                       {"last", -0.0}};
  CHECK(json == Json{{"study", "first"},
                     {"kind", "kind"},
                     {"id", 1},
                     {"over", "x"},
                     {"set", {{"load", 2.5}}},
                     {"rows",
                      {{{"x", 0.1},
                        {"i", 1},
                        {"yes", true},
                        {"word", "=a, \"b\""},
                        {"list", {1.0, 0.5}},
                        {"elements", {{"d", {{"load", 3.0}, {"deep", {{"er", 3.0}}}}}}},
                        {"last", 0.2}},
                       second}},
                     {"marks", Json::array({second})},
                     {"status", "complete"},
                     {"stop", {{"reason", "end"}, {"value", 1.0}}},
                     {"best", {{"x", 1.5}}}});
}

TEST_CASE("JSON has the reduction of the structure, and the doubt about a result, where there is one") {
  Results results = made_up::results();
  CHECK_FALSE(written_json(results).contains("reduction"));
  CHECK_FALSE(written_json(results)["things"][0].contains("doubt"));
  results.header.reduction = {{"rows", 5}, {"error", 1.5e-12}};
  results.results[0].end.doubt = "hardly \"so\"";
  const Json json = written_json(results);
  CHECK(json["reduction"] == Json{{"rows", 5}, {"error", 1.5e-12}});
  CHECK(json["things"][0]["doubt"] == "hardly \"so\"");
}

TEST_CASE("a table by columns is an object of lists") {
  const Json json = written_json(made_up::results())["others"][0];
  CHECK(json["rows"] == Json{{"x", {0.1, -0.0}}, {"elements", {{"d", {{"load", {3.0, 7.0}}}}}}});
  CHECK_FALSE(json.contains("study"));
}

TEST_CASE("lists without results stand in JSON, and one kind has its own format") {
  Results results = made_up::results();
  results.results.clear();
  CHECK(written_json(results)["things"] == Json::array());
  CHECK(written_json(results)["others"] == Json::array());
  CHECK_FALSE(written_json(results).contains("best"));
  results.schemas.pop_back();
  CHECK(written_json(results)["format"] == "things-1");
  results = made_up::results();
  results.results.push_back(results.results[0]);
  CHECK(written_json(results)["things"].size() == 2);  // one list, though another kind came between
  CHECK_FALSE(written_json(results).contains("best"));
}

TEST_CASE("rows may come in parts, those of several tables in turn") {
  const Results whole = made_up::results();
  std::ostringstream text;
  JsonWriter writer(text);
  writer.begin(whole.header, whole.schemas);
  writer.curve(whole.results[0].head, 0);
  writer.rows(1, whole.results[0].tables[1]);
  writer.rows(0, whole.results[0].tables[0]);
  writer.rows(1, whole.results[0].tables[1]);
  writer.rows(0, whole.results[0].tables[0]);
  writer.end(whole.results[0].end);
  writer.curve(whole.results[1].head, 1);
  writer.rows(0, whole.results[1].tables[0]);
  writer.rows(0, whole.results[1].tables[0]);
  writer.end(whole.results[1].end);
  writer.finish();
  const Json json = Json::parse(text.str());
  CHECK(json["things"][0]["rows"].size() == 4);
  CHECK(json["things"][0]["marks"].size() == 2);
  CHECK(json["others"][0]["rows"]["x"] == Json{0.1, -0.0, 0.1, -0.0});
}

TEST_CASE("numbers in JSON read back exactly, and what is not finite is null") {
  for (const double number : {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, 1e22, -3.0})
    CHECK(Json::parse(json(number)).get<double>() == number);
  CHECK(json(3.0) == "3.0");
  CHECK(json(3) == "3");
  CHECK(std::signbit(Json::parse(json(-0.0)).get<double>()));
  for (const double number : {std::nan(""), HUGE_VAL, -HUGE_VAL}) CHECK(json(number) == "null");
}

TEST_CASE("texts in JSON read back, and none commands a terminal") {
  for (const std::string text : {"", "a \"b\" \\ / \b\f\n\r\t", "\x01\x1f\x7f", "\u00e9\u20ac\U0001f600",
                                 "\u009b31m", "\u202e\ufffe\U0001ffff"}) {
    const std::string quoted = json(text);
    CAPTURE(quoted);
    CHECK(Json::parse(quoted) == text);
    CHECK(visible(quoted) == quoted);
  }
  CHECK(json("\xff\xed\xa0\x80z") == "\"\ufffd\ufffdz\"");  // bytes that are not UTF-8, a surrogate
}
