// Running the studies of a scene: what a sink is given, and when.
#include "catch.hpp"
#include "controls.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/figures/layout.hpp>
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

scene::Study time_study(const char* name) {
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
  studies::run(s, {.control = controls::reporting([&](const control::Progress& now) {
                     std::size_t& then = ended.at(static_cast<std::size_t>(now.branch));
                     if (then == 99) then = recorder.ended;
                     return true;
                   })},
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
  s.studies = {frf("a", {}), time_study("b"), frf("c", {})};
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
  s.studies = {frf("a", {}), time_study("b")};
  const results::Results all = studies::run(s, {.points = false});
  CHECK(all.results.at(0).tables.at(0).count == 0);
  CHECK(all.results[0].tables.at(1).count == 1);
  CHECK(all.results.at(1).tables.at(0).count == 0);
}

TEST_CASE("after a stop by the callback no further combination and no further study is begun") {
  scene::Scene s = scenes::paper(1);
  s.studies = {frf("a", {{"damper.normal_load", {1, 2, 3}}}), frf("b", {})};
  const results::Results all = studies::run(
      s, {.control = controls::reporting([](const control::Progress& now) { return now.branch < 1; })});
  REQUIRE(all.results.size() == 2);
  CHECK(all.results[0].end.status == results::Status::complete);
  CHECK(all.results[1].end.status == results::Status::stopped);
}

TEST_CASE("whenever a study is stopped, its last result says so") {
  scene::Scene s = scenes::paper(1);
  const std::vector<double> loads{1, 2, 3, 4, 5, 6, 7, 8};
  s.studies = {{"a",
                &studies::frf(),
                scene::Settings::of(observables::FrequencyRange{19.9, 20.1}),
                {{"damper.normal_load", loads}}}};
  // Stopped by its reports, and, in one thread, at each question.
  for (const auto& [threads, by_poll] : {std::pair(1, false), {1, true}, {3, false}}) {
    long of_first = 0;
    bool first = true;
    const auto count = [&](const control::Progress& now) {
      first = now.branch == 0;
      of_first += first && !by_poll;
      return true;
    };
    const auto count_question = [&] {
      of_first += first && by_poll;
      return true;
    };
    studies::run(s, {.control = controls::reporting(count, controls::polled(count_question))});
    REQUIRE(of_first > 100);
    for (long last = by_poll ? 2 : 1;  // at the first question no study is begun
         last < 2 * of_first; last += last < of_first - 3 || last > of_first + 3 ? 7 : 1) {
      CAPTURE(threads, last, of_first);
      long calls = 0;
      studies::RunOptions options;
      options.threads = threads;
      const auto go = [&] { return ++calls < last; };
      options.control = by_poll ? controls::polled(go)
                                : controls::reporting([&](const control::Progress&) { return go(); });
      const results::Results all = studies::run(s, options);
      REQUIRE(!all.results.empty());
      CHECK(all.results.size() < loads.size());
      CHECK(all.results.back().end.status == results::Status::stopped);
    }
  }
}

TEST_CASE(
    "a study over rows has the results of its rows, each as if it were alone, with their values as columns") {
  scene::Scene s = scenes::paper(1);
  scene::Study rows = frf("a", {{"damper.normal_load", {1, 3, 2}}, {"c.value", {0.1, 0.1, 0.3}}});
  rows.in_rows = true;
  s.studies = {rows};
  const results::Results all = studies::run(s);
  REQUIRE(all.results.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    scene::Scene alone = s;
    scene::set(alone, "damper.normal_load", rows.for_each[0].second[k]);
    scene::set(alone, "c.value", rows.for_each[1].second[k]);
    const results::Results one = studies::run(alone);
    REQUIRE(one.results.size() == 1);
    Json of_rows = without_seconds(Json::parse(json(all)))["branches"][k];
    Json of_one = without_seconds(Json::parse(json(one)))["branches"][0];
    CHECK(of_rows["set"]["damper.normal_load"] == rows.for_each[0].second[k]);
    CHECK(of_rows["set"]["c.value"] == rows.for_each[1].second[k]);
    CHECK(of_rows["points"] == of_one["points"]);
    CHECK(of_rows["events"] == of_one["events"]);
  }
}

TEST_CASE("axes of figures have the labels of the scene, and the names of quantities where it has none") {
  scene::Scene s = scenes::paper(1);
  const auto figures = [&](scene::Study study) {
    results::Collector collector;
    studies::RunOptions options;
    options.figures = true;
    collector.begin({}, std::vector{studies::kind_of(*study.type).schema(s, study, options)});
    return studies::kind_of(*study.type).run(s, study, options, 0, collector).at(0);
  };
  const auto x_axis = [](const results::FigureData& data, std::size_t i) {
    return figures::figure_of(data, data.figures[i]).x.label;
  };
  const auto y_axis = [](const results::FigureData& data, std::size_t i) {
    return figures::figure_of(data, data.figures[i]).y.label;
  };
  const scene::Study over_load = {
      "p",
      &studies::peaks(),
      scene::Settings::of(observables::CurveRange{"damper.normal_load", 3, 4, 19, 21}),
      {}};
  CHECK(x_axis(figures(frf("a", {})), 0) == "frequency (Hz)");
  CHECK(y_axis(figures(over_load), 0) == "peak amplitude (mm)");
  s.labels = {{"frequency", "excitation frequency"},
              {"amplitude", "tip"},
              {"damper.normal_load", "normal load F_n"},
              {"displacement", "tip of the blade"}};
  const results::FigureData responses =
      figures(frf("a", {{"damper.normal_load", {1, 3}}, {"c.value", {0.1}}}));
  CHECK(x_axis(responses, 0) == "excitation frequency (Hz)");
  CHECK(y_axis(responses, 0) == "tip (mm)");
  CHECK(responses.parameters == std::vector<std::string>{"normal load F_n", "c"});
  CHECK(responses.lines[0].heading == "damper.normal_load = 1 N, c.value = 0.1 N s/m");
  const results::FigureData peaks = figures(over_load);
  CHECK(x_axis(peaks, 0) == "normal load F_n (N)");
  CHECK(y_axis(peaks, 0) == "tip (mm)");
  CHECK(y_axis(peaks, 1) == "excitation frequency (Hz)");
  CHECK(y_axis(figures(time_study("t")), 0) == "tip of the blade (mm)");
  // What would take the room of the figure is numbered.
  const results::FigureData numbered = figures(
      frf("a", {{"damper.normal_load", {1, 3}}, {"c.value", {0.123456789}}, {"k.value", {17890.12345}}}));
  CHECK(numbered.parameters == std::vector<std::string>{"setting"});
  CHECK(numbered.lines[0].label == "1");
  CHECK(numbered.lines[1].label == "2");
  CHECK(numbered.lines[1].heading ==
        "damper.normal_load = 3 N, c.value = 0.123456789 N s/m, k.value = 17890.12345 N/m");
}

TEST_CASE("figures are made where they are asked for") {
  scene::Scene s = scenes::paper(1);
  const scene::Study study = frf("a", {{"damper.normal_load", {1, 3}}});
  results::Collector collector;
  const auto run = [&](bool figures) {
    studies::RunOptions options;
    options.figures = figures;
    collector.begin({}, std::vector{studies::kind_of(*study.type).schema(s, study, options)});
    return studies::kind_of(*study.type).run(s, study, options, 0, collector);
  };
  CHECK(run(false).empty());
  const auto figures = run(true);
  REQUIRE(figures.size() == 1);
  CHECK(figures[0].lines.size() == 2);
  CHECK(collector.results.results.size() == 2);
}
