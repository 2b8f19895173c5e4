// What reaches a terminal, and a spreadsheet: no name, key, path or word commands it.

#include "catch.hpp"
#include "program.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace app_test;
using Json = nlohmann::json;

namespace {

/// One mass and one damper of this name, as JSON writes it.
std::string scene_named(const std::string& damper, const std::string& rest = "") {
  return R"({"format": "arcslip-scene-1", "title": "bad \uffff \u009b31m", "structure": {"dofs": ["a"],
    "masses": [{"name": "m", "at": "a", "value": 1}], "springs": [{"name": "k", "at": "a", "value": 4000}],
    "dampers": [{"name": "c", "at": "a", "value": 1}]},
    "elements": [{"name": ")" +
         damper + R"(", "type": "jenkins", "at": "a", "stiffness": 1000, "friction_coefficient": 0.5,
                  "normal_load": 3}],
    "excitation": [{"name": "f", "at": "a", "cosine": 5}], "harmonics": {"order": 3}, "response": {"at": "a"},
    "studies": [{"name": "frf", "kind": "frf", "from": 5, "to": 16, "for_each": {")" +
         damper + R"(.normal_load": [1, 2]}},
      {"name": "best", "kind": "optimum", "over": [")" +
         damper +
         R"(.normal_load"], "bounds": [[1, 30]], "frequency": [5, 16], "for_each": {"k.value": [4000, 4100]}}])" +
         rest + "}";
}

/// No control character but line breaks, of C0 or of C1.
bool is_harmless(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
    if ((byte < 0x20 && byte != '\n') || byte == 0x7f || (byte == 0xc2 && next < 0xa0)) return false;
  }
  return true;
}

/// The cells of a line of CSV (RFC 4180).
std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> all(1);
  bool quoted = false;
  for (const char c : line)
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      all.emplace_back();
    else if (c != '\r')
      all.back() += c;
  return all;
}

std::vector<std::vector<std::string>> table(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t begin = 0; begin < csv.size();) {
    const std::size_t end = csv.find("\r\n", begin);
    rows.push_back(cells(csv.substr(begin, end - begin)));
    begin = end + 2;
  }
  return rows;
}

}  // namespace

TEST_CASE("names, keys, verbs and paths reach the terminal with their control characters escaped") {
  const Workplace place;
  place.write("name.json", scene_named("\\u009b31md"));
  place.write("key.json", scene_named("d", ", \"\\u001b]0;owned\\u0007\\u009b2J\\u202e\\u001b[31mX\\n\": 1"));
  place.write("red\x1b[31m\xc2\x9b.json", scene_named("d", ", \"unknown\": 1"));
  const std::vector<std::vector<std::string>> calls{
      {"frf", "name.json"},
      {"frf", "name.json", "--json", "-"},
      {"frf", "name.json", "--csv", "-"},
      {"optimize", "name.json"},
      {"optimize", "name.json", "--json", "-"},
      {"optimize", "name.json", "--csv", "-"},
      {"check", "name.json"},
      {"frf", "name.json", "--set", "\xc2\x9b.normal_load=3"},
      {"frf", "name.json", "--json", "no\x1b[31mwhere/\xc2\x9b"},
      {"frf", "name.json", "--out", "name.json/\x1b[31m"},
      {"check", "key.json"},
      {"check", "red\x1b[31m\xc2\x9b.json"},
      {"check", "\x1b[31mnot there"},
      {"\x1b[31mfry\xc2\x9b", "name.json"},
      {"frf", "name.json", "--\x1b[31m"},
      {"frf", "name.json", "--from", "\x1b[31m"},
  };
  for (const auto& call : calls) {
    CAPTURE(call);
    const Ended ended = run(place, call);
    CHECK(is_harmless(ended.err));
    CHECK((is_harmless(ended.out) || call.back() == "-"));
    std::string out = ended.out;
    std::erase(out, '\r');  // of CSV
    CHECK(is_harmless(out));
  }
  const Ended fault = run(place, {"check", "key.json"});
  CHECK(fault.err.find("key.json: /\\u001b]0;owned\\u0007\\u009b2J\\u202e\\u001b[31mX\\u000a: found") == 0);
}

TEST_CASE("what JSON escapes it still holds") {
  const Workplace place;
  place.write("name.json", scene_named("\\u009b31md"));
  const Json results = Json::parse(run(place, {"frf", "name.json", "--json", "-"}).out);
  CHECK(results["title"] ==
        "bad \xef\xbf\xbf \xc2\x9b"
        "31m");
  CHECK(
      results["branches"][0]["set"].contains("\xc2\x9b"
                                             "31md.normal_load"));
  const Ended first = run(place, {"check", "name.json"});
  place.write("again.json", first.out);
  CHECK(run(place, {"check", "again.json"}).out == first.out);
}

TEST_CASE("a name with a comma is one column, and one that begins like a formula is none") {
  for (const auto& [written, shown] :
       std::vector<std::pair<std::string, std::string>>{{"d,1", "d,1.normal_load (N)"},
                                                        {"@SUM(1+9)*cmd|", "'@SUM(1+9)*cmd|.normal_load (N)"},
                                                        {"+1", "'+1.normal_load (N)"},
                                                        {"-1", "'-1.normal_load (N)"}}) {
    CAPTURE(written);
    const Workplace place;
    place.write("name.json", scene_named(written));
    for (const auto& [verb, column] : {std::pair{"frf", 1}, std::pair{"optimize", 3}}) {
      CAPTURE(verb);
      const Ended ended = run(place, {verb, "name.json", "--csv", "-"});
      CHECK(ended.exit_code == 0);
      const auto rows = table(ended.out);
      REQUIRE(rows.size() > 2);
      CHECK(rows[0].at(static_cast<std::size_t>(column)) == shown);
      for (const auto& row : rows) CHECK(row.size() == rows[0].size());
    }
    const Ended curve = run(place, {"optimize", "name.json", "--along", "f.cosine=5:6", "--csv", "-"});
    const auto rows = table(curve.out);
    REQUIRE(rows.size() > 2);
    CHECK(rows[0].at(4) == shown);
    for (const auto& row : rows) CHECK(row.size() == rows[0].size());
  }
}

TEST_CASE("optima of several studies stand in one table, each value under its own parameter") {
  const Workplace place;
  Json scene = Json::parse(scene_named("d"));
  Json other = scene["studies"][1];
  other["name"] = "=stiff";
  other["over"] = {"d.friction_coefficient"};
  other["bounds"] = {{0.1, 3}};
  other.erase("for_each");
  scene["studies"] = {scene["studies"][1], other};
  place.write("two.json", scene.dump());
  const Ended ended = run(place, {"run", "two.json", "--csv", "-", "--out", "o"}, {{"PATH", "/nonexistent"}});
  CHECK(ended.exit_code == 0);
  const auto rows = table(ended.out);
  CHECK(rows.at(0) == std::vector<std::string>{"study", "k.value (N/m)", "search", "d.normal_load (N)",
                                               "amplitude (m)", "d.friction_coefficient (-)"});
  for (const auto& row : rows) REQUIRE(row.size() == rows[0].size());
  CHECK(rows[1][0] == "best");
  CHECK(rows[1][5].empty());
  CHECK(rows.back()[0] == "'=stiff");
  CHECK(rows.back()[3].empty());
}

TEST_CASE("a figure is XML whatever its title") {
  const Workplace place;
  place.write("name.json", scene_named("\\u009b31m\\ufffed"));
  const Ended ended = run(place, {"frf", "name.json", "--out", "o"});
  CHECK(ended.exit_code == 0);
  if (ended.err.find("gnuplot") != std::string::npos) {
    WARN("gnuplot is not there");
    return;
  }
  const std::string svg = place.read("o/frf_amplitude.svg");
  CHECK(svg.find("bad \\uffff \\u009b31m") != std::string::npos);
  CHECK(svg.find("\xef\xbf\xbf") == std::string::npos);
  CHECK(svg.find("\xef\xbf\xbe") == std::string::npos);
  std::string lines = svg;
  std::replace(lines.begin(), lines.end(), '\t', ' ');
  CHECK(is_harmless(lines));
}
