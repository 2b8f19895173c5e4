// Sweeps as results: columns, documentation, figures.
#include "catch.hpp"
#include "environment.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/results/csv_writer.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <nlohmann/json.hpp>

#include <fstream>
#include <sstream>

using namespace arcslip;
using Json = nlohmann::json;

namespace {

// A Duffing oscillator across both folds.
scene::Scene swept(const std::string& more = R"(, "points": 25)") {
  scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.05}]},
    "elements": [{"name": "s", "type": "bilinear_spring", "at": "x", "stiffness": 0, "stiffness_beyond": 1,
      "corner": 1}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.15}], "response": {"at": "x"},
    "studies": [{"kind": "sweep", "from": 1.0, "to": 1.6)" +
                                 more + "}]}");
  return s;
}

std::string rows(const results::Table& table) {
  std::string text;
  for (const results::Column& column : table.columns) {
    const std::string unit =
        column.unit == "rad/s" && column.path[0] != "omega" ? "the scene's" : column.unit;
    text += "| `" + results::name(column) + "` | " + unit + " | " + column.help + " |\n";
  }
  return text;
}

}  // namespace

TEST_CASE("sweeps in JSON and CSV have their points and jumps, and the documentation has their columns") {
  const scene::Scene s = swept();
  const results::Results all = studies::run(s);
  REQUIRE(all.schemas.size() == 1);
  std::ifstream file(source_folder() + "/docs/results.md");
  std::stringstream documented;
  documented << file.rdbuf();
  for (const results::Table& table : all.schemas[0].tables) {
    INFO("the table of " << table.key << " is to be:\n" << rows(table));
    CHECK(documented.str().find("|---|---|---|\n" + rows(table) + "\n") != std::string::npos);
  }
  std::ostringstream text;
  results::write_json(text, all);
  const Json json = Json::parse(text.str());
  CHECK(json["format"] == "arcslip-sweeps-1");
  REQUIRE(json["sweeps"].size() == 2);
  const Json &up = json["sweeps"][0], &down = json["sweeps"][1];
  CHECK(up["kind"] == "sweep");
  CHECK(up["direction"] == "up");
  CHECK_FALSE(up.contains("parent"));
  CHECK(down["direction"] == "down");
  CHECK(down["parent"] == up["id"]);
  CHECK(up["stop"]["reason"] == "swept");
  CHECK(up["integrator"] == "event-driven");
  REQUIRE(up["points"].size() == 25);
  CHECK(up["points"][0]["frequency"] == 1.0);
  CHECK(down["points"][0]["frequency"] == 1.6);
  REQUIRE(up["events"].size() == 1);
  REQUIRE(down["events"].size() == 1);
  CHECK(up["events"][0]["kind"] == "jump");
  CHECK(up["events"][0]["amplitude"] > up["events"][0]["amplitude_after"]);
  CHECK(down["events"][0]["amplitude"] < down["events"][0]["amplitude_after"]);
  CHECK(up["events"][0]["frequency"] > down["events"][0]["frequency"]);

  std::ostringstream csv;
  results::write_csv(csv, all, "points");
  CHECK(csv.str().find("study,sweep,omega (rad/s),frequency (rad/s),direction,amplitude (m),settled,") == 0);
  CHECK(csv.str().find("\r\nsweep,2,1.6,1.6,down,") != std::string::npos);
}

TEST_CASE("figures of sweeps have a line for each direction, broken and marked at jumps") {
  const scene::Scene s = swept();
  std::vector<results::FigureData> figures;
  results::Collector collector;
  const studies::StudyKind& kind = studies::kind_of(*s.studies[0].type);
  collector.begin({}, std::vector{kind.schema(s, s.studies[0], {})});
  figures = kind.run(s, s.studies[0], {.figures = true}, 0, collector);
  REQUIRE(figures.size() == 1);
  REQUIRE(figures[0].lines.size() == 2);
  CHECK(figures[0].lines[0].label == "up");
  CHECK(figures[0].lines[1].label == "down");
  for (const auto& line : figures[0].lines) {
    CHECK(line.parts.size() == 2);
    REQUIRE(line.marks.size() == 2);
    CHECK(line.marks[0].kind == "jump");
    CHECK(line.parts[0].back()[0] == line.marks[0].record[0]);
    CHECK(line.parts[1].front()[1] == line.marks[1].record[1]);
  }
  CHECK(figures[0].columns[1].scale == results::Scale::logarithmic);
}

TEST_CASE("keys of a sweep that contradict each other are faults") {
  const auto fault = [](const std::string& more) {
    try {
      swept(more);
    } catch (const scene::SceneError& error) {
      REQUIRE(error.faults().size() == 1);
      return error.faults().front().pointer + ": " + error.faults().front().message;
    }
    return std::string();
  };
  CHECK(fault(R"(, "spacing": 1e-9)") ==
        "/studies/0/spacing: found 1e-09, which makes more than 1000000 frequencies");
  CHECK(fault(R"(, "spacing": 0.1)").empty());
  CHECK(fault(R"(, "spacing": 0.1, "points": 7)") ==
        "/studies/0/points: found next to \"spacing\", which takes its place: give one of them");
  const auto of_time = [](const std::string& more) {
    Json json = Json::parse(scene::write(swept()));
    json["studies"] = Json::parse(R"([{"kind": "time", "frequency": 1, )" + more + "}]");
    try {
      scenes::parse(json.dump());
    } catch (const scene::SceneError& error) {
      return error.faults().front().pointer + ": " + error.faults().front().message;
    }
    return std::string();
  };
  CHECK(
      of_time(R"("perturbation": 0.1)") ==
      R"(/studies/0/perturbation: found next to no "start", must be with one: a transient from rest is not disturbed)");
  CHECK(
      of_time(R"("perturbation": 0.1, "start": 1)") ==
      R"(/studies/0/perturbation: found next to a method of shooting, must be with "newmark" or "event-driven")");
  CHECK(of_time(R"("perturbation": 0.1, "start": 1, "method": "newmark")").empty());
}
