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

namespace {

// A chain of 60 masses of 1 kg between springs of 1 N/m, fixed at one end, with natural frequencies from
// 0.026 rad/s on; observed up to 0.04 rad/s.
void write_chain(const Workplace& place, const std::string& reduction) {
  std::string mass = "%%MatrixMarket matrix coordinate real symmetric\n60 60 60\n",
              stiffness = "%%MatrixMarket matrix coordinate real symmetric\n60 60 119\n";
  for (int i = 1; i <= 60; ++i) {
    const std::string row = std::to_string(i);
    mass += row + " " + row + " 1\n";
    stiffness += row + " " + row + (i < 60 ? " 2\n" : " 1\n");
    if (i > 1) stiffness += row + " " + std::to_string(i - 1) + " -1\n";
  }
  place.write("M.mtx", mass);
  place.write("K.mtx", stiffness);
  place.write("names.csv", "name,row\ntip,60\n");
  place.write("chain.json", R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {
      "matrices": {"mass": "M.mtx", "stiffness": "K.mtx", "highest_frequency": 1.5, "reduction": )" +
                                reduction + R"(},
      "names": "names.csv", "damping": [{"name": "d", "type": "rayleigh", "alpha": 0.001, "beta": 0}]},
      "excitation": [{"name": "f", "at": "tip", "cosine": 1}], "response": {"at": "tip"},
      "harmonics": {"order": 1}, "studies": [{"kind": "frf", "from": 0.02, "to": 0.04}]})");
}

std::string modes(int count) {
  return R"({"method": "craig_bampton", "modes": )" + std::to_string(count) + "}";
}

Json responses_of(const Workplace& place, const std::string& scene) {
  const Ended ended = run(place, {"frf", scene, "--json", "-"});
  CAPTURE(ended.err);
  REQUIRE(ended.exit_code == 0);
  return Json::parse(ended.out);
}

std::string doubt_of(const Workplace& place, const std::string& scene) {
  return responses_of(place, scene)["branches"][0].value("doubt", "");
}

bool is_rough(const std::string& text, const std::string& up_to) {
  CAPTURE(text);
  return text.find("the reduction of the structure may have an error of ") != std::string::npos &&
         text.find(" up to " + up_to + " rad/s: keep more modes") != std::string::npos;
}

}  // namespace

TEST_CASE("a reduction by so few modes that it may be wrong is a doubt of the results") {
  const Workplace place;
  write_chain(place, modes(2));
  CHECK(responses_of(place, "chain.json")["reduction"]["method"] == "craig_bampton");
  CHECK(is_rough(doubt_of(place, "chain.json"), "0.04"));
  // Far from enough for the highest frequency, below which there are some 32.
  write_chain(place, modes(8));
  CHECK(responses_of(place, "chain.json")["reduction"]["error"] > 0.1);
  CHECK(doubt_of(place, "chain.json").empty());
  write_chain(place, modes(59));
  CHECK(doubt_of(place, "chain.json").empty());
}

TEST_CASE("the doubt about a reduction goes with the files that reduce writes") {
  const Workplace place;
  write_chain(place, modes(2));
  CHECK(is_rough(run(place, {"reduce", "chain.json", "--out", "less"}).err, "0.04"));
  CHECK(is_rough(doubt_of(place, "less/reduced.json"), "0.04"));
  write_chain(place, modes(8));
  const Ended better = run(place, {"reduce", "chain.json", "--out", "less"});
  CHECK(better.err.find("keep more modes") == std::string::npos);
  CHECK(doubt_of(place, "less/reduced.json").empty());
  // A study that goes farther than that of the scene.
  Json scene = Json::parse(place.read("less/reduced.json"));
  scene["studies"][0]["to"] = 0.05;
  place.write("less/reduced.json", scene.dump());
  CHECK(is_rough(doubt_of(place, "less/reduced.json"), "1.5"));
  // Beyond what the structure was reduced for.
  write_chain(place, "{}");
  CHECK(run(place, {"reduce", "chain.json", "--out", "less"}).exit_code == 0);
  CHECK(doubt_of(place, "less/reduced.json").empty());
  scene = Json::parse(place.read("less/reduced.json"));
  scene["studies"][0]["from"] = 1.6;
  scene["studies"][0]["to"] = 1.7;
  place.write("less/reduced.json", scene.dump());
  CHECK(doubt_of(place, "less/reduced.json").find("harmonics beyond highest_frequency of the reduction") !=
        std::string::npos);
}
