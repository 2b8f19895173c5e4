#include "catch.hpp"
#include "program.hpp"

#include <nlohmann/json.hpp>

using namespace app_test;
using Json = nlohmann::json;

TEST_CASE("reduce writes a structure and a scene that run gives the results of the whole one") {
  const Workplace place;
  place.write("bar.json", R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
    "beam": {"elements": 30, "length": 1, "young": 2e11, "density": 7800, "width": 0.05, "height": 0.02,
             "points": {"mid": 0.5, "tip": 1}, "highest_frequency": 5000}},
    "elements": [{"name": "d", "type": "jenkins", "at": "mid", "stiffness": 3e4, "friction_coefficient": 0.5,
                  "normal_load": 4}],
    "excitation": [{"name": "f", "at": "tip", "cosine": 1}], "response": {"at": "tip"},
    "harmonics": {"order": 3}, "studies": [{"kind": "frf", "from": 90, "to": 130}]})");
  const Ended written = run(place, {"reduce", "bar.json", "--out", "less"});
  CHECK(written.exit_code == 0);
  CHECK(written.out == "less/M.mtx\nless/K.mtx\nless/names.csv\nless/reduced.json\n");
  CHECK(written.err.find("was reduced to 2 of them") != std::string::npos);
  const Json whole = Json::parse(run(place, {"frf", "bar.json", "--json", "-"}).out),
             less = Json::parse(run(place, {"frf", "less/reduced.json", "--json", "-"}).out);
  const auto first = [](const Json& json) {
    return json["branches"][0]["points"][0]["amplitude"].get<double>();
  };
  CHECK(first(less) == Approx(first(whole)).epsilon(1e-9));
  // Never over the files that the structure is from.
  const Ended over = run(place, {"reduce", "bar.json", "--out", "less", "--quiet"});
  CHECK(over.exit_code == 0);
  CHECK(over.out.empty());
  std::string again = place.read("less/reduced.json");
  again.replace(again.find("\"mass\""), 0, "\"highest_frequency\": 4000, ");
  place.write("less/again.json", again);
  const Ended refused = run(place, {"reduce", "less/again.json", "--out", "less"});
  CHECK(refused.exit_code == 1);
  CHECK(refused.err.find("M.mtx is a file that the scene reads: choose another path") != std::string::npos);
}

TEST_CASE("reduce refuses names that a table of names cannot hold before it writes anything") {
  for (const std::string name : {"tip,x", "tip ", " tip", "#tip", "ti\np", "ti\"p"}) {
    const Workplace place;
    Json scene = Json::parse(R"({"format": "arcslip-scene-1", "structure": {
      "beam": {"elements": 30, "length": 1, "young": 2e11, "density": 7800, "width": 0.05, "height": 0.02,
               "points": {}, "highest_frequency": 800}},
      "excitation": [{"name": "f", "cosine": 1}], "response": {}})");
    scene["structure"]["beam"]["points"][name] = 1;
    scene["excitation"][0]["at"] = name;
    scene["response"]["at"] = name;
    place.write("bar.json", scene.dump());
    const auto before = place.files();
    const Ended ended = run(place, {"reduce", "bar.json", "--out", "less"});
    CAPTURE(name, ended.err);
    CHECK(ended.exit_code != 0);
    CHECK(place.files() == before);
  }
}
