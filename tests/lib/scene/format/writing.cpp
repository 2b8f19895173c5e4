#include <arcslip/optimize/study/optimum_study.hpp>
#include <arcslip/scene/scene.hpp>

#include <cmath>
#include <limits>
#include <sstream>

#include "bad_scenes.hpp"
#include "catalogue.hpp"
#include "catch.hpp"
#include "lib/scene/format/read_text.hpp"

using namespace arcslip::scene;
using namespace arcslip::scene::test;

namespace {

// A scene with one of everything.
const char* const full_scene = R"({
  "format": "arcslip-scene-1",
  "title": "\"Full\" \\ scene\nwith µ, \t and \u0001",
  "frequency_unit": "rad/s",
  "structure": {
    "dofs": ["blade 1", "b.l/a~de", "x\"y"],
    "masses": [
      {"name": "m1", "at": "blade 1", "value": 1.24},
      {"name": "m2", "between": ["b.l/a~de", "x\"y"], "value": 0.1},
      {"name": "m3", "direction": {"blade 1": 1, "b.l/a~de": -0.3333333333333333, "x\"y": 1e-300}, "value": 1e300}
    ],
    "springs": [{"name": "k", "between": ["ground", "x\"y"], "value": -5e-324}],
    "dampers": []
  },
  "elements": [
    {"name": "d1", "type": "jenkins", "at": "blade 1", "stiffness": 3500, "friction_coefficient": 0.5, "normal_load": 3},
    {"name": "d2", "type": "jenkins", "at": "x\"y", "stiffness": 3500, "friction_coefficient": 0.5, "normal_load": 3},
    {"name": "n", "type": "cubic_spring", "between": ["blade 1", "ground"], "stiffness": -1e20}
  ],
  "excitation": [{"name": "f", "at": "blade 1", "harmonic": 3, "sine": 0.7}],
  "ties": {"load": ["d1.normal_load", "d2.normal_load"]},
  "harmonics": {"order": 6, "period": 2, "friction": "sampled", "samples": 28, "kinks": "located"},
  "response": [{"name": "µ", "direction": {"blade 1": 1, "x\"y": 1}}, {"name": "b", "at": "b.l/a~de"}],
  "studies": [
    {"kind": "frf", "from": 0.1, "to": 1e9},
    {"name": "loads", "kind": "frf", "from": 1, "to": 2, "for_each": {"load": [0, 1e-12, 1e9], "n.stiffness": [-1]}},
    {"kind": "trace", "over": "n.stiffness", "from": -2, "to": 3, "frequency": 0.1, "for_each": {"load": [1, 2]}},
    {"kind": "peaks", "over": "load", "from": 0, "to": 1e300, "frequency": [0.1, 0.3333333333333333]},
    {"name": "turns", "kind": "folds", "over": "d1.friction_coefficient", "from": 0.1, "to": 0.5,
     "frequency": [1e-300, 3]},
    {"kind": "time", "frequency": 0.7, "method": "newmark", "tolerance": 1e-300, "for_each": {"load": [1, 2]}},
    {"name": "best", "kind": "optimum", "over": ["load", "n.stiffness"], "bounds": [[0.1, 5], [-1, 2]],
     "frequency": [0.1, 2], "algorithm": "LD_MMA",
     "constraints": [{"observable": "energy_friction", "at_most": 0.5}, {"observable": "frequency", "at_least": 1}],
     "for_each": {"f.sine": [1, 2]}},
    {"kind": "optimum", "over": ["load"], "bounds": [[0.1, 5]], "frequency": [0.1, 2]},
    {"name": "levels", "kind": "optimum", "over": ["load", "k.value"], "bounds": [[0.1, 5], [1, 2]],
     "frequency": [0.1, 2], "algorithm": "G_MLSL_LDS", "local": "LN_BOBYQA", "evaluations": 50, "seconds": 0.25,
     "population": 4, "seed": 7, "cases": {"f.sine": [1, 2], "n.stiffness": [0, 1, 1e20]}, "criterion": "mean",
     "constraints": [{"sum": {"k.value": 1, "load": -0.5}, "at_least": 0}, {"observable": "frequency", "at_most": 1}]},
    {"name": "blades", "kind": "optimum", "over": ["load"], "bounds": [[0.1, 5]], "frequency": [0.1, 2],
     "cases": [{"set": {"f.sine": 0.3333333333333333, "f.cosine": -1}, "weight": 3}, {},
               {"response": {"direction": {"b.l/a~de": -1e-300, "blade 1": 2}}}, {"weight": 1e300}],
     "scatter": {"n.stiffness": [-1, 1e300], "d1.stiffness": [1, 2]}},
    {"name": "followed", "kind": "optimum", "over": ["load"], "bounds": [[0.1, 5]], "frequency": [0.1, 2],
     "along": "f.sine", "from": 1, "to": 8}
  ]
})";

}  // namespace

TEST_CASE("what is written is read as the same scene") {
  for (const std::string& text : {std::string(full_scene), good_scene()}) {
    const Scene scene = read_text(text);
    const Scene again = read_text(write(scene));
    CHECK(again == scene);
    CHECK(write(again) == write(scene));
    CHECK(again.title == scene.title);
  }
}

TEST_CASE("lists of values for cases make their product, the last list fastest") {
  const Scene scene = read_text(full_scene);
  REQUIRE(scene.studies[8].name == "levels");
  const auto& cases = scene.studies[8].settings.as<arcslip::optimize::OptimumSettings>().problem.cases;
  REQUIRE(cases.size() == 6);
  using arcslip::optimize::LoadCase;
  using Set = std::vector<std::pair<std::string, double>>;
  CHECK(cases[0] == LoadCase{Set{{"f.sine", 1}, {"n.stiffness", 0}}, 1, {}});
  CHECK(cases[2] == LoadCase{Set{{"f.sine", 1}, {"n.stiffness", 1e20}}, 1, {}});
  CHECK(cases[3] == LoadCase{Set{{"f.sine", 2}, {"n.stiffness", 0}}, 1, {}});
}

TEST_CASE("a study of an optimum is written with its cases, scatter and along") {
  const std::string text = write(read_text(full_scene));
  for (const char* line :
       {R"({"sum": {"k.value": 1, "load": -0.5}, "at_least": 0})",
        R"("local": "LN_BOBYQA", "evaluations": 50,)",
        R"({"set": {"f.sine": 2, "n.stiffness": 1e+20}, "weight": 1})", R"("criterion": "mean")",
        R"({"set": {"f.sine": 0.3333333333333333, "f.cosine": -1}, "weight": 3},)",
        R"({"set": {}, "weight": 1e+300})",
        R"("response": {"direction": {"b.l/a~de": -1e-300, "blade 1": 2}}})",
        R"("scatter": {"n.stiffness": [-1, 1e+300], "d1.stiffness": [1, 2]})",
        R"("along": "f.sine", "from": 1, "to": 8,)", R"("starts": 9, "constraints": [],)"}) {
    CAPTURE(line);
    CHECK(text.find(line) != std::string::npos);
  }
}

TEST_CASE("a scene is written with every default, in the order of the format") {
  CHECK(write(read_text(good_scene())) == R"({
  "format": "arcslip-scene-2",
  "title": "",
  "frequency_unit": "Hz",
  "structure": {
    "dofs": ["a", "b"],
    "masses": [{"name": "m", "at": "a", "value": 1}],
    "springs": [{"name": "k", "at": "a", "value": 100}, {"name": "k2", "between": ["a", "b"], "value": 50}],
    "dampers": [{"name": "c", "at": "a", "value": 0.1}]
  },
  "elements": [
    {"name": "d", "type": "jenkins", "at": "a", "offset": "centred", "stiffness": 10,
     "friction_coefficient": 0.5, "normal_load": 3}
  ],
  "excitation": [{"name": "f", "type": "force", "at": "a", "harmonic": 1, "cosine": 1, "sine": 0}],
  "harmonics": {
    "accuracy": 1e-04,
    "order": 55,
    "period": 1,
    "friction": "exact",
    "samples": 512,
    "kinks": "auto"
  },
  "response": {"at": "a", "frame": "relative"},
  "studies": [
    {"name": "frf", "kind": "frf", "from": 1, "to": 2, "method": "harmonic_balance", "stability": false,
     "branches": "one", "for_each": {"d.normal_load": [1, 2]}}
  ]
}
)");
}

TEST_CASE("a study over a parameter is written with its parameter and its frequency, or its window of them") {
  const std::string text = write(read_text(full_scene));
  for (
      const char* line :
      {R"({"name": "trace", "kind": "trace", "over": "n.stiffness", "from": -2, "to": 3, "frequency": 0.1,)",
       R"("method": "harmonic_balance", "stability": false, "for_each": {"load": [1, 2]}})",
       R"({"name": "peaks", "kind": "peaks", "over": "load", "from": 0, "to": 1e+300,)",
       R"("frequency": [0.1, 0.3333333333333333], "stability": false, "resonance": "amplitude", "for_each": {}})",
       R"({"name": "turns", "kind": "folds", "over": "d1.friction_coefficient", "from": 0.1, "to": 0.5,)",
       R"("frequency": [1e-300, 3], "stability": false, "for_each": {}})",
       R"({"name": "time", "kind": "time", "frequency": 0.7, "method": "newmark", "steps": 1000, "periods": 10000,)",
       R"("recorded": 1, "tolerance": 1e-300, "start": 0, "perturbation": 0.001, "for_each": {"load": [1, 2]}})"}) {
    CAPTURE(line);
    CHECK(text.find(line) != std::string::npos);
  }
}

TEST_CASE("no line of a long scene is wider than 110 columns where it can be broken") {
  Scene scene = read_text(full_scene);
  for (int i = 0; i < 1000; ++i) scene.studies[1].for_each[0].second.push_back(i / 7.0);
  const std::string text = write(scene);
  CHECK(read_text(text) == scene);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    CAPTURE(line);
    CHECK(line.size() <= 110);
    CHECK((line.empty() || line.back() != ' '));
  }
}

TEST_CASE("the hash is FNV-1a of the resolved scene") {
  // computed apart, by the definition of Fowler, Noll and Vo, of the text in the test above
  CHECK(hash(read_text(good_scene())) == "da0ed4b057be6e95");
}

TEST_CASE("the hash does not see how a file is laid out, and sees each value") {
  Scene scene = read_text(good_scene());
  const std::string before = hash(scene);
  CHECK(hash(read_text(write(scene))) == before);
  CHECK(hash(read_text(good_scene_with(
            "\"response\"", "\"harmonics\": {\"accuracy\": 1e-4, \"order\": 55},\n\n\"response\""))) ==
        before);
  scene.masses[0].values[0] = std::nextafter(1.0, 2.0);
  CHECK(hash(scene) != before);
}

TEST_CASE("a zero keeps its sign") {
  Scene scene = read_text(good_scene());
  set(scene, "k.value", -0.0);
  const Scene again = read_text(write(scene));
  CHECK(std::signbit(value(again, "k.value")));
  CHECK(write(again) == write(scene));
}

TEST_CASE("text that a terminal must not get is escaped, and comes back as it was") {
  Scene scene = read_text(good_scene());
  scene.title = "\xc2\x9b\x1b[31m\xe2\x80\xae\xef\xbf\xbf\xf0\x9f\xbf\xbe \"\\ \n\t\xc3\xa9";
  const std::string text = write(scene);
  CHECK(text.find("\"\\u009b\\u001b[31m\\u202e\\uffff\\ud83f\\udffe \\\"\\\\ \\n\\t\xc3\xa9\"") !=
        std::string::npos);
  CHECK(read_text(text).title == scene.title);
}

TEST_CASE("a value that is not finite does not come back as a scene") {
  Scene scene = read_text(good_scene());
  scene.masses[0].values[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(check(scene), SceneError);
}
