// Running the studies of a scene: what a sink is given, and when.
#include "catch.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/observables/time_study.hpp>
#include <arcslip/results/csv_writer.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <nlohmann/json.hpp>

#include <sstream>

using namespace arcslip;
using Json = nlohmann::json;

namespace {

/// Notes what it is given.
struct Recorder : results::Sink {
  std::vector<results::Schema> schemas;
  std::vector<std::size_t> of_schema;  // of each curve
  std::size_t rows_given = 0, ended = 0, finished = 0;

  void begin(const results::Header& /*header*/, std::span<const results::Schema> all) override {
    schemas.assign(all.begin(), all.end());
  }
  void curve(const results::Head& /*head*/, std::size_t schema) override { of_schema.push_back(schema); }
  void rows(std::size_t /*table*/, const results::Rows& rows) override { rows_given += rows.count; }
  void end(const results::End& /*end*/) override { ++ended; }
  void finish() override { ++finished; }
};

scene::Study frf(const char* name, scene::ValueLists lists) {
  return {name, &studies::frf(), scene::Settings::of(observables::FrequencyRange{19, 21}), std::move(lists)};
}

scene::Study motion(const char* name) {
  return {name, &studies::time(), scene::Settings::of(observables::TimeSettings{20}), {}};
}

std::string json(const results::Results& all) {
  std::ostringstream text;
  results::write_json(text, all);
  return text.str();
}

/// Without what the clock says.
Json without_seconds(Json all) {
  for (Json& branch : all["branches"]) branch["solver"].erase("seconds");
  for (Json& motion : all["motions"]) motion.erase("seconds");
  return all;
}

}  // namespace

TEST_CASE("a sink has each result as soon as it is computed") {
  scene::Scene s = scenes::paper(1);
  s.studies = {frf("a", {{"damper.normal_load", {1, 2, 3}}})};
  Recorder recorder;
  std::vector<std::size_t> ended(3, 99);  // when a combination began
  studies::run(s,
               {.progress =
                    [&](const results::Progress& now) {
                      std::size_t& then = ended.at(static_cast<std::size_t>(now.branch));
                      if (then == 99) then = recorder.ended;
                      return true;
                    }},
               recorder);
  CHECK(ended == std::vector<std::size_t>{0, 1, 2});
  CHECK(recorder.of_schema == std::vector<std::size_t>{0, 0, 0});
  CHECK(recorder.ended == 3);
  CHECK(recorder.finished == 1);
  CHECK(recorder.rows_given > 300);
  CHECK(recorder.schemas.at(0).set.at(0).path == std::vector<std::string>{"damper.normal_load"});
  CHECK(recorder.schemas[0].set[0].unit == "N");
}

TEST_CASE("results of one list of a document come one after the other") {
  scene::Scene s = scenes::paper(1);
  s.studies = {frf("a", {}), motion("b"), frf("c", {})};
  Recorder recorder;
  studies::run(s, {.points = false}, recorder);
  CHECK(recorder.of_schema == std::vector<std::size_t>{0, 2, 1});
  std::ostringstream text;
  results::JsonWriter writer(text);
  studies::run(s, {}, writer);
  const Json document = Json::parse(text.str());
  CHECK(document["branches"].size() == 2);
  CHECK(document["branches"][1]["study"] == "c");
  CHECK(document["motions"].size() == 1);
  const Json collected = without_seconds(Json::parse(json(studies::run(s))));
  CHECK(Json::diff(without_seconds(document), collected).dump() == "[]");
}

TEST_CASE("branches have numbers, and those that they go on from") {
  scene::Scene s = scenes::paper(7, 0);
  scene::set(s, "c.value", 0);
  scene::Study study = frf("a", {{"damper.normal_load", {0, 3, 1}}});  // unbounded, bounded, unbounded
  s.studies = {study, frf("b", {})};
  const auto all = studies::run(s);
  const Json found = Json::parse(json(all));
  const std::vector<int> parents{0, 1, 0, 0, 4, 0, 6};
  REQUIRE(found["branches"].size() == parents.size());
  for (std::size_t i = 0; i < parents.size(); ++i) {
    CAPTURE(i);
    CHECK(found["branches"][i]["id"] == i + 1);
    CHECK(found["branches"][i].value("parent", 0) == parents[i]);
  }
  std::ostringstream summary;
  results::write_csv_summary(summary, all);
  std::istringstream lines(summary.str());
  std::size_t column = 0, row = 0;
  for (std::string line; std::getline(lines, line); ++row) {
    std::vector<std::string> cells{""};
    bool quoted = false;
    for (const char c : line) {
      if (c == '"') quoted = !quoted;
      if (c == ',' && !quoted)
        cells.emplace_back();
      else if (c != '\r')
        cells.back() += c;
    }
    if (row == 0)
      column = static_cast<std::size_t>(std::find(cells.begin(), cells.end(), "parent") - cells.begin());
    else
      CHECK(cells.at(column) == (parents[row - 1] > 0 ? std::to_string(parents[row - 1]) : ""));
  }
  CHECK(row == parents.size() + 1);
}

TEST_CASE("without points a study has events and facts, and no rows of points") {
  scene::Scene s = scenes::paper(1);
  s.studies = {frf("a", {}), motion("b")};
  const results::Results all = studies::run(s, {.points = false});
  CHECK(all.results.at(0).tables.at(0).count == 0);
  CHECK(all.results[0].tables.at(1).count == 1);
  CHECK(all.results.at(1).tables.at(0).count == 0);
}

TEST_CASE("after a stop by the callback no further combination and no further study is begun") {
  scene::Scene s = scenes::paper(1);
  s.studies = {frf("a", {{"damper.normal_load", {1, 2, 3}}}), frf("b", {})};
  const results::Results all =
      studies::run(s, {.progress = [](const results::Progress& now) { return now.branch < 1; }});
  REQUIRE(all.results.size() == 2);
  CHECK(all.results[0].end.status == results::Status::complete);
  CHECK(all.results[1].end.status == results::Status::stopped);
}

TEST_CASE("figures are made where they are asked for") {
  scene::Scene s = scenes::paper(1);
  const scene::Study study = frf("a", {{"damper.normal_load", {1, 3}}});
  results::Collector collector;
  const auto run = [&](bool figures) {
    scene::RunOptions options;
    options.figures = figures;
    collector.begin({}, std::vector{study.type->schema(s, study, options)});
    return study.type->run(s, study, options, 0, collector);
  };
  CHECK(run(false).empty());
  const auto figures = run(true);
  REQUIRE(figures.size() == 1);
  CHECK(figures[0].lines.size() == 2);
  CHECK(collector.results.results.size() == 2);
}
