#include <arcslip/scene/scene.hpp>

#include <filesystem>
#include <sstream>

#include "bad_scenes.hpp"
#include "catalogue.hpp"
#include "catch.hpp"
#include "lib/scene/folder.hpp"
#include "lib/scene/format/read_text.hpp"

using namespace arcslip::scene;
using namespace arcslip::scene::test;

namespace {

Scene read_stream(std::istream& in) {
  return read(in, test_catalogue::whole());
}

Scene read_path(const std::string& path) {
  return read_file(path, test_catalogue::whole());
}

std::vector<Fault> faults_of(std::istream& in) {
  try {
    read_stream(in);
  } catch (const SceneError& error) {
    return error.faults();
  }
  return {};
}

}  // namespace

TEST_CASE("the scene that the bad scenes are made from is sound") {
  CHECK(faults_of(good_scene()).empty());
}

TEST_CASE("each bad scene gives the one fault that its row expects") {
  for (const BadScene& bad : bad_scenes()) {
    CAPTURE(bad.name, bad.pointer, bad.message_part);
    const auto in = open(bad);
    const std::vector<Fault> faults = faults_of(*in);
    REQUIRE(faults.size() == 1);
    CAPTURE(faults[0].message);
    CHECK(faults[0].pointer == bad.pointer);
    CHECK(faults[0].message.find(bad.message_part) != std::string::npos);
    CHECK(faults[0].message.size() < 1000);
  }
}

TEST_CASE("a file with seven faults gives these seven in one go") {
  const std::vector<Fault> faults = faults_of(R"({
    "format": "arcslip-scene-1", "titel": "x",
    "structure": {
      "dofs": ["a"],
      "masses": [{"name": "m", "at": "a", "value": -1}, {"name": "m", "at": "b", "value": 1}],
      "springs": [{"name": "k", "at": "a", "value": "stiff"}]
    },
    "excitation": [{"name": "f", "at": "a", "harmonic": 9}], "harmonics": {"order": 7},
    "studies": [{"kind": "frf", "from": 2, "to": 1}]
  })");
  std::vector<std::string> pointers;
  for (const Fault& fault : faults) pointers.push_back(fault.pointer);
  const std::vector<std::string> expected = {"/titel",
                                             "/structure/masses/0/value",
                                             "/structure/masses/1/name",
                                             "/structure/masses/1/at",
                                             "/structure/springs/0/value",
                                             "/excitation/0/harmonic",
                                             "/studies/0/to"};
  CHECK(pointers == expected);
}

TEST_CASE("all faults of a study over a parameter are reported in one go") {
  const std::vector<Fault> faults = faults_of(good_scene_with(
      R"({"kind": "frf", "from": 1, "to": 2, "for_each": {"d.normal_load": [1, 2]}})",
      R"({"kind": "folds", "over": "d.normal_load", "from": -1, "too": 2, "frequency": [0, true],
          "for_each": {"d.normal_load": [1], "m.valu": [2]}})"));
  std::vector<std::string> pointers;
  for (const Fault& fault : faults) pointers.push_back(fault.pointer);
  const std::vector<std::string> expected = {"/studies/0/too",
                                             "/studies/0/from",
                                             "/studies/0/to",
                                             "/studies/0/frequency/0",
                                             "/studies/0/frequency/1",
                                             "/studies/0/for_each/d.normal_load",
                                             "/studies/0/for_each/m.valu"};
  CHECK(pointers == expected);
}

TEST_CASE("all faults of a study of an optimum are reported in one go") {
  const std::vector<Fault> faults = faults_of(
      good_scene_with(R"({"kind": "frf", "from": 1, "to": 2, "for_each": {"d.normal_load": [1, 2]}})",
                      R"({"kind": "optimum", "over": ["d.normal_load", "d.normal_load", "frequency", 3],
          "bounds": [[1, 2], [-1, 2], [3, 1]], "frequency": [2, 1], "algorithm": 5,
          "constraints": [{"observable": "frequency"}, {"observable": "frequency", "at_least": 3, "at_most": 2},
                          {"at_most": 1}], "for_each": {"d.normal_load": [1]}})"));
  std::vector<std::string> pointers;
  for (const Fault& fault : faults) pointers.push_back(fault.pointer);
  const std::vector<std::string> expected = {
      "/studies/0/bounds",        "/studies/0/over/1",        "/studies/0/bounds/1/0",
      "/studies/0/over/2",        "/studies/0/bounds/2/1",    "/studies/0/over/3",
      "/studies/0/frequency/1",   "/studies/0/algorithm",     "/studies/0/constraints/0",
      "/studies/0/constraints/1", "/studies/0/constraints/2", "/studies/0/for_each/d.normal_load"};
  CHECK(pointers == expected);
}

TEST_CASE("all faults of cases, scatter and search settings are reported at once") {
  const std::vector<Fault> faults = faults_of(
      good_scene_with(R"({"kind": "frf", "from": 1, "to": 2, "for_each": {"d.normal_load": [1, 2]}})",
                      R"({"kind": "optimum", "over": ["d.normal_load"], "bounds": [[1, 2]],
          "frequency": [1, 2], "evaluations": 0, "seed": 1.5, "seconds": -1, "local": 3,
          "constraints": [{"sum": {"d.normal_laod": 1, "m.value": 1}, "at_most": 3},
                          {"sum": {}, "observable": "frequency"}],
          "cases": [{"set": {"d.normal_load": 1, "m.value": -1, "c.value": 1, "kk": 1}, "weight": 0},
                    {"response": {"at": "c"}, "wieght": 1}, 3],
          "criterion": "mena", "scatter": {"c.value": [1, 2], "k2.value": [2, 1]},
          "along": "d.stiffness", "from": 0, "to": 2, "for_each": {"d.stiffness": [1], "c.value": [1]}})"));
  std::vector<std::string> pointers;
  for (const Fault& fault : faults) pointers.push_back(fault.pointer);
  const std::vector<std::string> expected = {"/studies/0/local",
                                             "/studies/0/evaluations",
                                             "/studies/0/seconds",
                                             "/studies/0/seed",
                                             "/studies/0/constraints/0/sum/d.normal_laod",
                                             "/studies/0/constraints/0/sum/m.value",
                                             "/studies/0/constraints/1",
                                             "/studies/0/constraints/1",
                                             "/studies/0/constraints/1/sum",
                                             "/studies/0/cases/0/set/d.normal_load",
                                             "/studies/0/cases/0/set/m.value",
                                             "/studies/0/cases/0/set/kk",
                                             "/studies/0/cases/0/weight",
                                             "/studies/0/cases/1/wieght",
                                             "/studies/0/cases/1/response/at",
                                             "/studies/0/cases/2",
                                             "/studies/0/criterion",
                                             "/studies/0/scatter/c.value",
                                             "/studies/0/scatter/k2.value/1",
                                             "/studies/0/along",
                                             "/studies/0/from",
                                             "/studies/0/for_each/c.value"};
  CHECK(pointers == expected);
}

TEST_CASE("what() of a scene error has one line for each fault, with its pointer") {
  const SceneError error({{"/a", "found 1"}, {"", "too long"}});
  CHECK(std::string(error.what()) == "/a: found 1\ntoo long");
}

TEST_CASE("what follows from a fault that is reported is not reported again") {
  SECTION("the parameters of an element whose type is not known") {
    const auto faults = faults_of(good_scene_with("\"jenkins\"", "\"jenkinz\""));
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].pointer == "/elements/0/type");
  }
  SECTION("the parameters of an element whose name is not known") {
    const auto faults = faults_of(good_scene_with("\"name\": \"d\"", "\"name\": 4"));
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].pointer == "/elements/0/name");
  }
  SECTION("the parameter of a study that belongs to an element whose type is not known") {
    std::string text = good_scene_with(
        R"({"kind": "frf", "from": 1, "to": 2, "for_each": {"d.normal_load": [1, 2]}})",
        R"({"kind": "peaks", "over": "d.normal_load", "from": -1, "to": 2, "frequency": [1, 2]})");
    text.replace(text.find("jenkins"), 7, "jenkinz");
    const auto faults = faults_of(text);
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].pointer == "/elements/0/type");
  }
  SECTION("the names of degrees of freedom whose list is at fault") {
    const auto faults =
        faults_of(good_scene_with("[\"a\", \"b\"],\n    \"masses\"", "[\"A\", 3],\n    \"masses\""));
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].pointer == "/structure/dofs/1");
  }
}

TEST_CASE("of a hundred thousand faults a thousand are listed and the rest are counted") {
  std::string sweep = "{\"m.value\": [-1";
  for (int i = 1; i < 100'000; ++i) sweep += ",-1";
  const auto faults = faults_of(good_scene_with("{\"d.normal_load\": [1, 2]}", sweep + "]}"));
  REQUIRE(faults.size() == 1001);
  CHECK(faults.back().message == "and 99000 more faults, which are not listed");
}

TEST_CASE("more than five million values are refused before the memory is full") {
  std::string text = "[0";
  for (std::size_t i = 0; i < largest_count; ++i) text += ",0";
  const auto faults = faults_of(text + "]");
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].message.find("found more than 5000000 values, must be at most that many") !=
        std::string::npos);
}

TEST_CASE("a file that is not there is an error that names it") {
  CHECK_THROWS_WITH(read_path("/nowhere/scene.json"),
                    "cannot open /nowhere/scene.json: No such file or directory");
  CHECK_THROWS_AS(read_path("/nowhere/scene.json"), FileError);
}

TEST_CASE("a folder is not read as a scene") {
  const std::string folder = std::filesystem::temp_directory_path().string();
  CHECK_THROWS_WITH(read_path(folder), folder + " is a directory, must be a scene file");
}

TEST_CASE("a stream that has failed is a file error and not an empty scene") {
  std::istringstream in(good_scene());
  in.setstate(std::ios::failbit);
  CHECK_THROWS_AS(read_stream(in), FileError);
  std::istringstream broken(good_scene());
  broken.setstate(std::ios::badbit);
  CHECK_THROWS_AS(read_stream(broken), FileError);
}

TEST_CASE("a regular file above 64 MB is refused by its size") {
  const ::Folder folder = {{"scene.json", "["}};
  std::filesystem::resize_file(folder / "scene.json", largest_size + 1);  // sparse: nothing is written
  CHECK_THROWS_WITH(read_path(folder / "scene.json"),
                    "found a file of 67108865 bytes, a scene must be at most 64 MB");
  CHECK_THROWS_AS(read_path(folder / "scene.json"), SceneError);
}

TEST_CASE("a scene is read from a file as from a stream") {
  const ::Folder folder = {{"scene.json", good_scene()}};
  std::istringstream in(good_scene());
  CHECK(read_path(folder / "scene.json") == read_stream(in));
}

TEST_CASE("a scene that was changed in code is checked as its file would be") {
  std::istringstream in(good_scene());
  Scene scene = read_stream(in);
  CHECK_NOTHROW(check(scene));
  scene.harmonics.order = 3000;
  scene.masses[0].values[0] = -2;
  try {
    check(scene);
    FAIL("not refused");
  } catch (const SceneError& error) {
    REQUIRE(error.faults().size() == 2);
    CHECK(error.faults()[0].pointer == "/structure/masses/0/value");
    CHECK(error.faults()[1].pointer == "/harmonics/order");
  }
  scene = Scene{};
  CHECK_THROWS_AS(check(scene), SceneError);
}
