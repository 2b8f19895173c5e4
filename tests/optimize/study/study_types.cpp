// Every kind of study that the command knows: its keys in files, in documentation and in the JSON Schema.
#include "catch.hpp"
#include "environment.hpp"
#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/curves/curves.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/optimize/studies.hpp>
#include <arcslip/optimize/study/optimum_study.hpp>
#include <arcslip/scene/format/json_schema.hpp>
#include <arcslip/scene/keys/section_keys.hpp>
#include <arcslip/scene/study_type.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

using namespace arcslip;
using Json = nlohmann::json;

namespace {

scene::Catalogue all_kinds() {
  scene::Catalogue catalogue = studies::catalogue();
  optimize::add_studies(catalogue);
  return catalogue;
}

/// What docs/scene.md says of keys.
std::string key_rows(const std::vector<scene::Key>& keys) {
  std::string text;
  for (const scene::Key& key : keys) {
    const std::string unit = key.unit == "frequency"   ? "the scene's"
                             : key.unit == "parameter" ? "the parameter's"
                             : key.unit == "-"         ? ""
                                                       : key.unit;
    text += "| `" + key.name + "` | " + unit + " | " + key.allowed + " | " +
            (key.required            ? "required"
             : key.otherwise.empty() ? "none"
                                     : "`" + key.otherwise + "`") +
            " | " + key.help + " |\n";
  }
  return text;
}

std::string allowed(const scene::Field& field) {
  if (std::isinf(field.lower)) return "any number";
  std::ostringstream text;
  text << (field.lower_open ? "above " : "at least ") << field.lower;
  if (!std::isinf(field.upper)) text << ", at most " << field.upper;
  return text.str();
}

/// What docs/scene.md says of the fields and options of a part.
std::string part_rows(const std::string& part, const scene::PartType& type) {
  std::ostringstream text;
  bool first = true;
  for (const scene::Field& field : type.fields({})) {
    text << "| " << (first ? part + " " : "") << "| `" << field.name << "` | "
         << (field.unit == "-" ? "" : std::string(field.unit) + " ") << "| " << allowed(field) << " | ";
    if (field.default_value)
      text << *field.default_value;
    else
      text << "required";
    text << " | " << field.help << " |\n";
    first = false;
  }
  for (const scene::Key& option : type.options()) {
    const std::string otherwise = option.otherwise.empty() ? "none" : option.otherwise;
    text << "| " << (first ? part + " " : "") << "| `" << option.name << "` | | " << option.allowed << " | "
         << (option.required ? "required" : otherwise) << " | " << option.help << " |\n";
    first = false;
  }
  return text.str();
}

/// A study of each kind over what a scene with one damper has.
std::string studies_of_all_kinds() {
  return R"([
    {"kind": "frf", "from": 1, "to": 2},
    {"kind": "trace", "over": "damper.normal_load", "from": 1, "to": 2, "frequency": 20},
    {"kind": "peaks", "over": "damper.normal_load", "from": 1, "to": 2, "frequency": [18, 22]},
    {"kind": "folds", "over": "damper.normal_load", "from": 1, "to": 2, "frequency": [18, 22]},
    {"kind": "bifurcations", "over": "damper.normal_load", "from": 1, "to": 2, "frequency": [18, 22]},
    {"kind": "time", "frequency": 20},
    {"kind": "optimum", "over": ["damper.normal_load"], "bounds": [[1, 2]], "frequency": [18, 22]},
    {"kind": "optimum", "over": ["damper.normal_load"], "bounds": [[1, 2]], "frequency": [18, 22],
     "along": "force.cosine", "from": 1, "to": 2, "algorithm": "G_MLSL", "local": "LN_BOBYQA"},
    {"kind": "optimum", "over": ["damper.normal_load"], "bounds": [[1, 2]], "frequency": [18, 22],
     "cases": [{"set": {"force.cosine": 2}, "weight": 0.5, "response": {"at": "blade"}}],
     "scatter": {"damper.friction_coefficient": [0.4, 0.6]},
     "constraints": [{"observable": "energy_friction", "at_most": 1},
                     {"sum": {"damper.normal_load": 1}, "at_least": 0.5}]},
    {"kind": "point", "frequency": 20},
    {"kind": "modes", "mode": 1, "amplitude": [1e-5, 1e-2]},
    {"kind": "sweep", "from": 18, "to": 22, "direction": "up"},
    {"kind": "sweep", "from": 18, "to": 22, "spacing": 0.5},
    {"kind": "accuracy", "from": 18, "to": 22, "order": 7}])";
}

scene::Scene scene_with_all_kinds() {
  Json json = Json::parse(scene::write(scenes::paper(5, 3)));
  json["studies"] = Json::parse(studies_of_all_kinds());
  std::istringstream file(json.dump());
  return scene::read(file, all_kinds());
}

}  // namespace

TEST_CASE("the documentation of scenes has a row for every key of every kind of study") {
  std::ifstream file(source_folder() + "/docs/scene.md");
  std::stringstream text;
  text << file.rdbuf();
  for (const auto& type : all_kinds().studies) {
    const std::string wanted = key_rows(type->keys());
    INFO("the table of " << type->name() << " is to be:\n" << wanted);
    CHECK(text.str().find(wanted) != std::string::npos);
    CHECK(text.str().find("### `" + std::string(type->name()) + "`") != std::string::npos);
  }
}

TEST_CASE("the documentation of scenes has a row for every key of a section with a table") {
  std::ifstream file(source_folder() + "/docs/scene.md");
  std::stringstream text;
  text << file.rdbuf();
  for (const scene::SettingsKeys* table :
       {&scene::reduction_keys(), &scene::harmonics_keys(), &scene::matrices_keys(), &scene::cyclic_keys(),
        &scene::bar_keys(true)}) {
    const std::string wanted = key_rows(table->keys());
    INFO("the table is to be:\n" << wanted);
    CHECK(text.str().find(wanted) != std::string::npos);
  }
}

TEST_CASE("the documentation of scenes has a row for every field and option of every part") {
  std::ifstream file(source_folder() + "/docs/scene.md");
  std::stringstream text;
  text << file.rdbuf();
  std::string wanted = part_rows("mass", scene::mass_type()) + part_rows("spring", scene::spring_type()) +
                       part_rows("damper", scene::damper_type());
  for (const auto& law : all_kinds().elements)
    wanted += part_rows("element of `\"type\": \"" + std::string(law->name()) + "\"`", *law);
  wanted += part_rows("force", scene::force_type());
  INFO("the table of parts is to be:\n" << wanted);
  CHECK(text.str().find(wanted) != std::string::npos);
  for (const scene::PartType* type : scene::excitation_types()) {
    if (!scene::is_base_motion(*type)) continue;
    const std::string of_base =
        part_rows("excitation of `\"type\": \"" + std::string(type->name()) + "\"`", *type);
    INFO("the table of parts is to have:\n" << of_base);
    CHECK(text.str().find(of_base) != std::string::npos);
  }
}

TEST_CASE("a study is written with the keys of its kind, in their order, and read as it was") {
  const scene::Scene scene = scene_with_all_kinds();
  std::set<const scene::StudyType*> seen;
  const auto written = nlohmann::ordered_json::parse(scene::write(scene));
  for (std::size_t i = 0; i < scene.studies.size(); ++i) {
    const scene::StudyType& type = *scene.studies[i].type;
    seen.insert(&type);
    std::vector<std::string> known{"name", "kind"};
    for (const scene::Key& key : type.keys()) known.push_back(key.name);
    known.emplace_back("for_each");
    std::size_t next = 0;
    for (const auto& [key, value] : written["studies"][i].items()) {
      CAPTURE(type.name(), key);
      const auto found = std::find(known.begin() + static_cast<std::ptrdiff_t>(next), known.end(), key);
      REQUIRE(found != known.end());
      next = static_cast<std::size_t>(found - known.begin()) + 1;
    }
    for (const scene::Key& key : type.keys())
      if (key.required) CHECK(written["studies"][i].contains(key.name));
  }
  CHECK(seen.size() == all_kinds().studies.size());
  std::istringstream again(scene::write(scene));
  CHECK(scene::read(again, all_kinds()) == scene);
}

TEST_CASE("defaults of keys are those of the settings") {
  const scene::Scene scene = scene_with_all_kinds();
  for (const auto& type : all_kinds().studies) {
    scene::file::Node::Object keys;
    type->settings().write(type->settings().defaults(), scene, keys);
    for (const scene::Key& key : type->keys()) {
      CAPTURE(type->name(), key.name);
      const auto own =
          std::find_if(keys.begin(), keys.end(), [&](const auto& member) { return member.key == key.name; });
      if (key.required || key.otherwise.empty() || own == keys.end()) continue;
      CHECK(Json::parse(scene::file::print_tree(own->value)) == Json::parse(key.otherwise));
    }
  }
}

TEST_CASE("the JSON Schema has the keys of every kind, and those that are required") {
  const Json schema = Json::parse(scene::json_schema(all_kinds()));
  const Json& kinds = schema["properties"]["studies"]["items"]["oneOf"];
  REQUIRE(kinds.size() == all_kinds().studies.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const scene::StudyType& type = *all_kinds().studies[i];
    CHECK(kinds[i]["properties"]["kind"]["const"] == type.name());
    CHECK(kinds[i]["additionalProperties"] == false);
    std::set<std::string> known{"name", "kind", "comment", "for_each"}, required{"kind"};
    for (const scene::Key& key : type.keys()) {
      known.insert(key.name);
      if (key.required) required.insert(key.name);
    }
    std::set<std::string> found;
    for (const auto& [key, value] : kinds[i]["properties"].items()) found.insert(key);
    CHECK(found == known);
    CHECK(kinds[i]["required"].get<std::set<std::string>>() == required);
  }
  const Json& time = *std::find_if(kinds.begin(), kinds.end(), [](const Json& kind) {
    return kind["properties"]["kind"]["const"] == "time";
  });
  const Json& steps = time["properties"]["steps"];
  CHECK(steps["type"] == "integer");
  CHECK(steps["minimum"] == 1);
  CHECK(steps["default"] == 1000);
  CHECK(time["properties"]["method"]["enum"].size() == 4);
  CHECK(time["properties"]["tolerance"]["maximum"] == 1);
  CHECK(kinds.back()["dependentRequired"] ==
        Json{{"along", {"from", "to"}}, {"from", {"along"}}, {"to", {"along"}}});
}

TEST_CASE("settings compare by value, and are those of their own kind alone") {
  const scene::Scene scene = scene_with_all_kinds();
  scene::Scene other = scene;
  CHECK(other == scene);
  other.studies[0].settings.as<observables::FrequencyRange>().to = 3;
  CHECK_FALSE(other == scene);
  CHECK_THROWS_AS(other.studies[0].settings.as<observables::CurveRange>(), std::bad_any_cast);
  CHECK_FALSE(scene.studies[2].settings == scene.studies[4].settings);
  CHECK(scene::Settings() == scene::Settings());
}

TEST_CASE("what a study is over, or gives values to, is reported, and only lists can be dropped") {
  const scene::Scene scene = scene_with_all_kinds();
  const auto names = [&](std::size_t i) {
    std::set<std::string> all;
    for (const scene::ParameterUse& each : scene.studies[i].type->settings().taken(scene.studies[i].settings))
      all.insert(each.parameter);
    return all;
  };
  CHECK(names(0).empty());
  CHECK(names(2) == std::set<std::string>{"damper.normal_load"});
  CHECK(names(7) == std::set<std::string>{"damper.normal_load", "force.cosine"});
  CHECK(names(8) ==
        std::set<std::string>{"damper.normal_load", "force.cosine", "damper.friction_coefficient"});
  scene::Scene dropped = scene;
  for (const char* parameter : {"damper.friction_coefficient", "force.cosine", "damper.normal_load"})
    scene::drop(dropped.studies[8], parameter);
  const auto& problem = dropped.studies[8].settings.as<optimize::OptimumSettings>().problem;
  CHECK(problem.scatter.empty());
  CHECK(problem.cases[0].set.empty());
  CHECK(problem.over.size() == 1);
}

TEST_CASE("a study that was built without its kind or its settings is a fault, and nothing breaks") {
  scene::Scene scene = scenes::paper(5, 3);
  scene.studies = {scene::Study{"a"}};
  CHECK_THROWS_WITH(scene::check(scene), "/studies/0: found no kind, must be a study of some kind");
  for (const auto& type : all_kinds().studies) {
    scene.studies = {scene::Study{"a", type.get()}};
    const auto keys = type->keys();
    if (std::any_of(keys.begin(), keys.end(), [](const scene::Key& key) { return key.required; }))
      CHECK_THROWS_AS(scene::check(scene), scene::SceneError);
    else
      CHECK_NOTHROW(scene::check(scene));
    CHECK_NOTHROW(scene::drop(scene.studies[0], "damper.normal_load"));
    CHECK(type->settings().taken({}).empty());
  }
}

TEST_CASE("a limit on what no response has is refused before the first study of a run begins") {
  const auto catalogue = all_kinds();
  const auto schema_of = [&](const std::string& observable) {
    std::istringstream text(R"({"format": "arcslip-scene-1",
      "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
                    "springs": [{"name": "k", "at": "x", "value": 1e4}],
                    "dampers": [{"name": "c", "at": "x", "value": 2}]},
      "elements": [{"name": "d", "type": "jenkins", "at": "x", "stiffness": 5e3, "friction_coefficient": 0.5,
                    "normal_load": 10}],
      "excitation": [{"name": "f", "at": "x", "cosine": 10}],
      "studies": [{"kind": "optimum", "over": ["d.normal_load"], "bounds": [[1, 100]], "frequency": [10, 25],
                   "constraints": [{"observable": ")" +
                            observable + R"(", "at_most": 1}]}]})");
    const scene::Scene s = scene::read(text, catalogue);
    return studies::kind_of(*s.studies[0].type).schema(s, s.studies[0], {}).list;
  };
  CHECK(schema_of("d.energy") == "optima");
  CHECK_THROWS_WITH(
      schema_of("d.enrgy"),
      Catch::Contains("no observable \"d.enrgy\" to limit; did you mean \"d.energy\"? Known: omega, "));
  CHECK_THROWS_WITH(schema_of("nonsense"),
                    Catch::Contains("no observable \"nonsense\" to limit. Known: omega, "));
}

TEST_CASE("a scene may name its schema") {
  Json json = Json::parse(scene::write(scenes::paper(5, 3)));
  json["$schema"] = "scene.schema.json";
  std::istringstream file(json.dump());
  CHECK(scene::read(file, all_kinds()) == scenes::paper(5, 3));
  CHECK(Json::parse(scene::json_schema(all_kinds()))["properties"].contains("$schema"));
}
