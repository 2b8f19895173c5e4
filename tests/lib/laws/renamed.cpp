// Nothing knows a law by its name or a field by its place: under other names and in another order, every
// study gives the same results, bit for bit.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/laws/renamed_jenkins.hpp"

#include <arcslip/results/json_writer.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <nlohmann/json.hpp>

#include <string>

using namespace arcslip;
using nlohmann::json;

namespace {

const own_laws::RenamedJenkins renamed_jenkins;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string in_other_words(std::string text) {
  text = replaced(std::move(text), "friction_coefficient", "grip");
  text = replaced(std::move(text), "normal_load", "preload");
  text = replaced(std::move(text), "\"jenkins\"", "\"series_slider\"");
  for (const std::string element : {"damper", "d1", "d2"})
    text = replaced(std::move(text), element + ".stiffness", element + ".tangent");
  return text;
}

scene::Scene read_with_names(const json& file, bool other) {
  auto catalogue = test_catalogue::whole();
  if (!other) {
    std::istringstream in(file.dump());
    return scene::read(in, catalogue);
  }
  json changed = json::parse(in_other_words(file.dump()));
  for (auto& element : changed["elements"])
    if (element["type"] == "series_slider") {
      element["tangent"] = element["stiffness"];
      element.erase("stiffness");
      element.erase("offset");  // an option of the law's own
    }
  catalogue.elements = {scene::lasting<scene::PartType>(renamed_jenkins)};
  for (const auto* law : elements::laws())
    if (law != &elements::jenkins()) catalogue.elements.push_back(scene::lasting(*law));
  std::istringstream in(changed.dump());
  return scene::read(in, catalogue);
}

void drop_times(json& results) {
  if (results.is_object()) {
    results.erase("seconds");
    results.erase("scene_hash");
  }
  if (results.is_structured())
    for (auto& item : results) drop_times(item);
}

json run(const scene::Scene& scene) {
  std::ostringstream out;
  studies::RunOptions options;
  options.coefficients = true;
  results::write_json(out, studies::run(scene, options));
  return json::parse(out.str());
}

// reason: how a study of the file ends.
void check_same(const json& file, const std::string& reason = "complete") {
  json expected = run(read_with_names(file, false));
  CHECK(expected.dump().find("\"" + reason + "\"") != std::string::npos);
  CHECK((reason != "complete" || expected.dump().find("\"status\":\"failed\"") == std::string::npos));
  json found = run(read_with_names(file, true));
  expected = json::parse(in_other_words(expected.dump()));
  drop_times(expected);
  drop_times(found);
  const json difference = json::diff(expected, found);
  for (std::size_t i = 0; i < std::min<std::size_t>(difference.size(), 5); ++i)
    FAIL_CHECK(difference[i].dump());
  CHECK(difference.empty());
}

json file_of(const scene::Scene& scene) {
  return json::parse(scene::write(scene));
}

}  // namespace

TEST_CASE("under another name and with its fields permuted a law gives the same results in every study") {
  json file = file_of(scenes::paper(5, 3));
  file["studies"] = json::parse(R"([
    {"name": "frf", "kind": "frf", "from": 18, "to": 22},
    {"name": "trace", "kind": "trace", "over": "damper.normal_load", "from": 0.1, "to": 50, "frequency": 20},
    {"name": "stiffness", "kind": "trace", "over": "damper.stiffness", "from": 500, "to": 5000, "frequency": 20},
    {"name": "peaks", "kind": "peaks", "over": "damper.normal_load", "from": 0.5, "to": 100, "frequency": [18, 22]},
    {"name": "point", "kind": "point", "frequency": 19.5},
    {"name": "shooting", "kind": "time", "frequency": 19.5},
    {"name": "steps", "kind": "time", "frequency": 19.5, "method": "newmark-shooting", "steps": 100},
    {"name": "load", "kind": "optimum", "over": ["damper.normal_load"], "bounds": [[0.1, 100]], "frequency": [18, 22]}
  ])");
  check_same(file);
}

TEST_CASE("an element of another law's name that sticks at an optimum is released by its own fields") {
  json file = file_of(scenes::example("two_dampers"));
  file["harmonics"]["order"] = 1;
  file["elements"][0]["normal_load"] = 20;
  json& studies = file["studies"];
  for (std::size_t i = studies.size(); i-- > 0;)
    if (studies[i]["kind"] != "optimum" || studies[i].contains("along")) studies.erase(i);
  REQUIRE_FALSE(studies.empty());
  check_same(file);
}

TEST_CASE("so it does among several elements with a mean, sampled as well", "[numbers]") {
  json file = file_of(scenes::chain(4, true));
  file["studies"] = json::parse(R"([
    {"name": "frf", "kind": "frf", "from": 0.6, "to": 1.4},
    {"name": "folds", "kind": "folds", "over": "d1.normal_load", "from": 0.2, "to": 2, "frequency": [0.6, 1.4]},
    {"name": "peaks", "kind": "peaks", "over": "d1.stiffness", "from": 0.3, "to": 0.9, "frequency": [0.6, 1.4]}
  ])");
  check_same(file);
  file["harmonics"]["friction"] = "sampled";
  file["studies"].erase(2);
  file["studies"].erase(1);
  check_same(file);
}

TEST_CASE("an undamped resonance of another law's name is unbounded for the same reason") {
  json file = file_of(scenes::paper(3, 1));
  file["structure"]["dampers"][0]["value"] = 0;
  file["studies"] = json::parse(R"([{"name": "frf", "kind": "frf", "from": 18, "to": 22}])");
  check_same(file, "unbounded");
}
