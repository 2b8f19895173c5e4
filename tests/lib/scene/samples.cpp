// for_each by distributions: the same key, combinations and results as lists have.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/scene/folder.hpp"
#include "lib/scene/format/bad_scenes.hpp"

#include <arcslip/scene/combinations.hpp>
#include <arcslip/studies/catalogue.hpp>

using namespace arcslip::scene;
using namespace arcslip::scene::test;

namespace {

const std::string two_parameters =
    R"({"distributions": {"k.value": {"normal": [100, 2]}, "m.value": {"uniform": [1, 2]}}, "count": 5, "seed": 3})";

Scene with_samples(const std::string& text) {
  return scenes::parse(good_scene_with("{\"d.normal_load\": [1, 2]}", text));
}

}  // namespace

TEST_CASE("distributions of for_each are as many combinations as they have samples") {
  const Scene s = with_samples(two_parameters);
  const Study& study = s.studies[0];
  CHECK(study.for_each.empty());
  CHECK(study.samples.seed == 3);
  const Combinations all(study);
  CHECK(all.count() == 5);
  CHECK(all.size() == 5);
  CHECK(varied_parameters(study) == std::vector<std::string>{"k.value", "m.value"});
  const arcslip::sampling::Sampler sampler(study.samples);
  for (std::size_t i = 0; i < 5; ++i) {
    const std::vector<double> values = sampler(i);
    CHECK(all[i] == Setting{{"k.value", values[0]}, {"m.value", values[1]}});
    CHECK((values[1] >= 1 && values[1] <= 2));
  }
}

TEST_CASE("distributions are written as they are read, with every default") {
  const Scene s = with_samples(two_parameters);
  CHECK(scenes::parse(write(s)) == s);
  CHECK(write(s).find("\"design\": \"random\"") != std::string::npos);
  const std::string all = R"({"distributions": {"k.value": {"lognormal": [100, 2]},
      "d.normal_load": {"truncated_normal": [1, 5, 0, 3]}}, "count": 7, "design": "latin_hypercube"})";
  const Scene other = with_samples(all);
  CHECK(scenes::parse(write(other)) == other);
  CHECK(hash(s) != hash(other));
}

TEST_CASE("a parameter that is set drops out of the distributions, and the last one leaves one result") {
  Scene s = with_samples(two_parameters);
  set(s, "k.value", 90);
  CHECK(varied_parameters(s.studies[0]) == std::vector<std::string>{"m.value"});
  CHECK(scenes::parse(write(s)) == s);
  set(s, "m.value", 1);
  CHECK(Combinations(s.studies[0]).count() == 1);
  CHECK(scenes::parse(write(s)) == s);
}

TEST_CASE("a tie may be named distributions, and lists are those of its values") {
  const std::string text = good_scene_with("{\"d.normal_load\": [1, 2]}", R"({"distributions": [3, 4]})");
  std::string tied = text;
  tied.insert(tied.find("\"studies\""), R"("ties": {"distributions": ["k.value"]}, )");
  const Scene s = scenes::parse(tied);
  CHECK(s.studies[0].samples.count == 0);
  CHECK(Combinations(s.studies[0]).count() == 2);
}

TEST_CASE("responses of samples are those of a list with the same values") {
  const Scene samples = with_samples(two_parameters);
  Scene lists = samples;
  lists.studies[0].samples = {};
  lists.studies[0].in_rows = true;
  lists.studies[0].for_each = {{"k.value", {}}, {"m.value", {}}};
  const Combinations all(samples.studies[0]);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k) lists.studies[0].for_each[k].second.push_back(all[i][k].second);
  const auto a = arcslip::studies::run(samples), b = arcslip::studies::run(lists);
  REQUIRE(a.results.size() == 5);
  REQUIRE(b.results.size() == 5);
  CHECK(a.schemas.front().set.size() == 2);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(std::get<double>(a.results[i].head.set[0].value.get()) == all[i][0].second);
    CHECK(a.results[i].tables[1].count == b.results[i].tables[1].count);
    const auto frequencies = [&](const arcslip::results::Results& of) {
      return std::get<std::vector<double>>(of.results[i].tables[0].columns[0].of);
    };
    CHECK(frequencies(a) == frequencies(b));
  }
}

namespace {

const std::string named_file = R"("for_each": "mc.csv")";

Scene with_file(const ::Folder& folder, const std::string& csv) {
  folder.write("mc.csv", csv);
  std::string text = good_scene_with("{\"d.normal_load\": [1, 2]}", "\"mc.csv\"");
  folder.write("scene.json", text);
  return read_file(folder / "scene.json", arcslip::studies::catalogue());
}

/// Returns the only fault of a file with samples.
std::string fault_of(const std::string& csv) {
  const ::Folder folder;
  try {
    with_file(folder, csv);
  } catch (const SceneError& error) {
    REQUIRE(error.faults().size() == 1);
    CHECK(error.faults().front().pointer == "/studies/0/for_each");
    return error.faults().front().message;
  }
  return {};
}

}  // namespace

TEST_CASE("a CSV file of samples is read as rows, and named again where the scene is written") {
  const ::Folder folder;
  const Scene s =
      with_file(folder, "# by a Monte Carlo program\nk.value, m.value (kg)\n100,1\n1.5e2,2\n\n90,3\n");
  const Combinations all(s.studies[0]);
  REQUIRE(all.size() == 3);
  CHECK(all[1] == Setting{{"k.value", 150}, {"m.value", 2}});
  CHECK(write(s).find(named_file) != std::string::npos);
  CHECK(read_file(folder / "scene.json", arcslip::studies::catalogue()) == s);
  Scene other = s;
  REQUIRE(files(other).size() == 1);
  CHECK(files(other).front()->path == "mc.csv");
  const std::string before = hash(s);
  CHECK(hash(with_file(folder, "k.value,m.value\n100,1\n")) != before);
  // Without one of its columns the file is no longer what for_each has.
  set(other, "m.value", 2);
  CHECK(files(other).empty());
  CHECK(write(other).find(R"("for_each": [{"k.value": 100}, {"k.value": 150}, {"k.value": 90}])") !=
        std::string::npos);
}

TEST_CASE("faults of a CSV file of samples have the line and what is allowed") {
  CHECK(fault_of("k.valu,m.value\n1,2\n").find("did you mean \"k.value\"?") != std::string::npos);
  CHECK(fault_of("k.value,m.value (g)\n1,2\n") ==
        "line 1 of \"mc.csv\": found the title \"m.value (g)\", must be \"m.value (kg)\": numbers have the "
        "units of the "
        "scene");
  CHECK(fault_of("k.value,k.value\n1,2\n") ==
        "line 1 of \"mc.csv\": found the title \"k.value\" again, must stand only once");
  CHECK(fault_of("k.value,m.value\n1,2\n1,-2\n") == "line 3 of \"mc.csv\": found -2, must be at least 0 kg");
  CHECK(fault_of("k.value,m.value\n1,2 kg\n") ==
        "line 2 of \"mc.csv\": found \"2 kg\", must be a finite number");
  CHECK(fault_of("k.value,m.value\n1,inf\n") ==
        "line 2 of \"mc.csv\": found \"inf\", must be a finite number");
  CHECK(fault_of("k.value,m.value\n1\n") ==
        "line 2 of \"mc.csv\": found 1 values, must be 2, as the header has");
  for (const std::string text : {"", "\n# nothing\n", "k.value,m.value\n"})
    CHECK(fault_of(text) ==
          "found no rows in \"mc.csv\", must be a header with names of parameters, and a value of each on "
          "every line");
  CHECK_THROWS_WITH(scenes::parse(good_scene_with("{\"d.normal_load\": [1, 2]}", "\"none.csv\"")),
                    Catch::Matchers::Contains("which cannot be read: cannot open"));
}
