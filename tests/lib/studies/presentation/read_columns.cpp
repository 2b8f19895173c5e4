// Only what is read of branches is computed, and it is the same as with all else.
#include "catch.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/observables/quantities.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <array>
#include <cmath>
#include <map>
#include <set>

using namespace arcslip;

namespace {

// Two masses with a contact whose normal load varies, wear and named responses.
scene::Scene with_every_quantity(const std::string& study) {
  return scenes::parse(R"({"format": "arcslip-scene-2", "frequency_unit": "rad/s",
    "structure": {"dofs": ["a", "b", "n"],
      "masses": [{"name": "m", "at": "a", "value": 1}, {"name": "M", "at": "b", "value": 2},
                 {"name": "o", "at": "n", "value": 1}],
      "springs": [{"name": "k", "between": ["a", "ground"], "value": 1},
                  {"name": "l", "between": ["a", "b"], "value": 1},
                  {"name": "v", "between": ["n", "ground"], "value": 9}],
      "dampers": [{"name": "c", "between": ["a", "ground"], "value": 0.05},
                  {"name": "d", "between": ["n", "ground"], "value": 0.3}]},
    "elements": [
      {"name": "pad", "type": "contact_2d", "tangential": {"at": "b"}, "normal": {"at": "n"},
       "tangential_stiffness": 1, "normal_stiffness": 2, "friction_coefficient": 0.4, "normal_load": 1,
       "wear_coefficient": 1e-12},
      {"name": "cubic", "type": "cubic_spring", "between": ["a", "ground"], "stiffness": 0.05}],
    "excitation": [{"name": "f", "at": "a", "harmonic": 1, "cosine": 0.5},
                   {"name": "g", "at": "n", "harmonic": 1, "cosine": 2}],
    "harmonics": {"order": 4}, "response": [{"at": "b", "name": "first"}, {"at": "a", "name": "second"}],
    "studies": [)" + study +
                       "]}");
}

results::Results run(const scene::Scene& scene, const std::vector<std::string>& columns) {
  return studies::run(scene, {.point_columns = columns, .event_columns = columns, .coefficients = true});
}

// All rows of one column.
std::vector<std::string> texts(const results::Results& all, std::size_t table, std::size_t column) {
  const results::Column& of = all.schemas.front().tables[table].columns[column];
  std::vector<std::string> texts;
  for (const results::Result& result : all.results) {
    const results::Rows& rows = result.tables.at(table);
    const results::Rows one{rows.count, {rows.columns.at(column)}};
    for (std::size_t row = 0; row < rows.count; ++row)
      texts.push_back(results::json(results::object({&of, 1}, one, row)));
  }
  return texts;
}

}  // namespace

TEST_CASE("columns that are read alone have the numbers that they have with all others") {
  std::vector<scene::Scene> scenes{
      scenes::paper(5), with_every_quantity(R"({"name": "s", "kind": "frf", "from": 0.4, "to": 1.6})"),
      with_every_quantity(R"({"name": "s", "kind": "frf", "from": 0.4, "to": 1.6, "stability": true})"),
      with_every_quantity(
          R"({"name": "s", "kind": "trace", "over": "pad.normal_load", "from": 0.2, "to": 3, "frequency": 0.8})")};
  scenes.front().studies.resize(1);
  scenes.front().studies.front().for_each.clear();
  std::size_t events = 0;
  for (const scene::Scene& scene : scenes) {
    const results::Results all = run(scene, {});
    REQUIRE(all.results.front().tables.at(0).count > 30);
    events += all.results.front().tables.at(1).count;
    const auto& tables = all.schemas.front().tables;
    std::set<std::string> names;
    for (const results::Table& table : tables)
      for (const results::Column& column : table.columns) names.insert(results::name(column));
    std::map<std::array<bool, 3>, results::Results> by_needs;
    for (const std::string& name : names) {
      INFO(name);
      const auto needs = observables::needed_by({&name, 1});
      const auto [at, is_new] = by_needs.try_emplace({needs.estimates, needs.motion, needs.maxima});
      if (is_new) at->second = run(scene, {name});
      const results::Results& alone = at->second;
      for (std::size_t t = 0; t < tables.size(); ++t)
        for (std::size_t c = 0; c < tables[t].columns.size(); ++c)
          if (results::name(tables[t].columns[c]) == name) CHECK(texts(alone, t, c) == texts(all, t, c));
    }
    CHECK(by_needs.size() == 5);
  }
  CHECK(events > 3);
}

TEST_CASE("what is not read is not computed") {
  scene::Scene scene = scenes::paper(5);
  observables::FrequencyRange range = scenes::window(scene);
  const auto whole = observables::frequency_response(scene, range);
  range.points = range.events = observables::solution_alone;
  const auto alone = observables::frequency_response(scene, range);
  REQUIRE(alone.size() == 1);
  REQUIRE(alone[0].points.size() == whole[0].points.size());
  for (std::size_t i = 0; i < alone[0].points.size(); ++i) {
    const observables::ResponsePoint &point = alone[0].points[i], &full = whole[0].points[i];
    CHECK(point.unknowns == full.unknowns);
    CHECK(point.amplitude == full.amplitude);
    CHECK(point.elements.empty());
    CHECK(point.coefficients == full.coefficients);
    CHECK(std::isnan(point.rms));
    CHECK(std::isnan(point.truncation_change));
    CHECK(full.elements.size() == 1);
  }
  REQUIRE(alone[0].events.size() == whole[0].events.size());
  for (std::size_t i = 0; i < alone[0].events.size(); ++i) {
    CHECK(alone[0].events[i].point.amplitude == whole[0].events[i].point.amplitude);
    CHECK(std::isnan(alone[0].events[i].point.maxima.velocity));
  }
}

TEST_CASE("the parts that columns need") {
  using observables::Observed;
  const auto needed = [](const char* column) {
    const std::string name = column;
    return observables::needed_by({&name, 1});
  };
  for (const char* column : {"frequency", "omega", "amplitude", "kind"})
    CHECK(needed(column) == observables::solution_alone);
  CHECK(needed("truncation_estimate") == Observed{.estimates = true, .motion = false});
  CHECK(needed("pad.stick_percent") == Observed{.estimates = false, .motion = true});
  CHECK(needed("pad_estimate.stick_percent") == Observed{.estimates = false, .motion = true});
  CHECK(needed("elements.pad.stick_estimate") == observables::everything);
  CHECK(needed("maxima.velocity") == Observed{.estimates = false, .motion = true, .maxima = true});
  CHECK(needed("responses.second.amplitude") == Observed{.estimates = false, .motion = true});
}
