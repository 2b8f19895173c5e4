#include <arcslip/optimize/study/optimum_study.hpp>
#include <arcslip/scene/combinations.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <limits>
#include <sstream>

#include "catalogue.hpp"
#include "catch.hpp"
#include "lib/scene/format/bad_scenes.hpp"
#include "lib/scene/format/read_text.hpp"

using namespace arcslip::scene;
using namespace arcslip::scene::test;

namespace {

Scene tied_scene() {
  return read_text(R"({"format": "arcslip-scene-1",
    "structure": {"dofs": ["a"], "masses": [{"name": "m", "at": "a", "value": 1}]},
    "elements": [
      {"name": "d1", "type": "jenkins", "at": "a", "stiffness": 1, "friction_coefficient": 0.5, "normal_load": 3},
      {"name": "d2", "type": "jenkins", "at": "a", "stiffness": 2, "friction_coefficient": 0.5, "normal_load": 3}],
    "excitation": [{"name": "f", "at": "a", "cosine": 1}],
    "ties": {"load": ["d1.normal_load", "d2.normal_load"]},
    "studies": [{"kind": "frf", "from": 1, "to": 2, "for_each": {"load": [1, 2], "m.value": [1, 2]}},
                {"kind": "frf", "from": 1, "to": 2, "for_each": {"load": [5]}}]})");
}

}  // namespace

TEST_CASE("the parameters are the constants and then every field of every part") {
  CHECK(parameter_names(tied_scene()) == std::vector<std::string>{"load", "m.value", "d1.stiffness",
                                                                  "d1.friction_coefficient", "d1.normal_load",
                                                                  "d2.stiffness", "d2.friction_coefficient",
                                                                  "d2.normal_load", "f.cosine", "f.sine"});
}

TEST_CASE("every parameter has a value and knows its unit") {
  const Scene scene = tied_scene();
  for (const std::string& name : parameter_names(scene)) {
    CAPTURE(name);
    CHECK_NOTHROW(value(scene, name));
    CHECK_FALSE(parameter_field(scene, name).unit.empty());
  }
  CHECK(value(scene, "d2.stiffness") == 2);
  CHECK(parameter_field(scene, "load").unit == "N");
  CHECK(parameter_field(scene, "load").lower == 0);
}

TEST_CASE("a parameter that is set has the value and is swept no more") {
  Scene scene = tied_scene();
  set(scene, "m.value", 4);
  CHECK(value(scene, "m.value") == 4);
  CHECK(scene.masses[0].values[0] == 4);
  REQUIRE(scene.studies[0].for_each.size() == 1);
  CHECK(scene.studies[0].for_each[0].first == "load");
}

TEST_CASE(
    "a parameter that is set is dropped from cases and scatter, and cases that are the same become one") {
  using namespace arcslip::optimize;
  using Set = std::vector<std::pair<std::string, double>>;
  const auto problem_after_set = [](Criterion criterion) {
    Scene scene = tied_scene();
    OptimumSettings settings;
    settings.problem.criterion = criterion;
    settings.problem.scatter = {{"load", 1, 2}, {"m.value", 1, 2}};
    settings.problem.cases = {{Set{{"m.value", 1}, {"load", 1}}, 2, {}},
                              {Set{{"m.value", 2}, {"load", 1}}, 3, {}},
                              {Set{{"load", 2}}, 4, {}},
                              {Set{{"m.value", 1}, {"load", 1}}, 5, Direction{{0, 2}}}};
    scene.studies = {{"best", &optimum_type(), Settings::of(settings)}};
    set(scene, "m.value", 4);
    const OptimumProblem& dropped = scene.studies[0].settings.as<OptimumSettings>().problem;
    CHECK(dropped.cases.size() == 4);
    return with_distinct_cases(dropped);
  };
  for (const Criterion criterion : {Criterion::worst, Criterion::mean}) {
    const OptimumProblem problem = problem_after_set(criterion);
    CHECK(problem.scatter == std::vector<DesignVariable>{{"load", 1, 2}});
    REQUIRE(problem.cases.size() == 3);
    CHECK(problem.cases[0] == LoadCase{Set{{"load", 1}}, criterion == Criterion::worst ? 3.0 : 5.0, {}});
    CHECK(problem.cases[1] == LoadCase{Set{{"load", 2}}, 4, {}});
    CHECK(problem.cases[2] == LoadCase{Set{{"load", 1}}, 5, Direction{{0, 2}}});
  }
}

TEST_CASE("a tie that is set gives its value to all its members") {
  Scene scene = tied_scene();
  CHECK(value(scene, "load") == 3);
  set(scene, "load", 7);
  CHECK(value(scene, "load") == 7);
  CHECK(value(scene, "d1.normal_load") == 7);
  CHECK(value(scene, "d2.normal_load") == 7);
  CHECK(scene.studies[0].for_each.size() == 1);
  CHECK(scene.studies[1].for_each.empty());
  CHECK_NOTHROW(check(scene));
}

TEST_CASE("a tied field is not set apart from its tie") {
  Scene scene = tied_scene();
  CHECK_THROWS_WITH(set(scene, "d1.normal_load", 4),
                    "parameter \"d1.normal_load\" is given by the formula \"load\", must be set by what it "
                    "follows: \"load\"");
  CHECK(scene == tied_scene());
}

TEST_CASE("a parameter that is not there is an error that names the nearest") {
  Scene scene = tied_scene();
  CHECK_THROWS_AS(value(scene, "d1.normal_laod"), ParameterError);
  CHECK_THROWS_WITH(value(scene, "d1.normal_laod"),
                    Catch::Matchers::Contains("unknown parameter \"d1.normal_laod\"") &&
                        Catch::Matchers::EndsWith("did you mean \"d1.normal_load\"?"));
  CHECK_THROWS_WITH(set(scene, "laod", 1), Catch::Matchers::EndsWith("did you mean \"load\"?"));
  for (const std::string name :
       {"", ".", "d1", "m.", ".value", "m.value.value", "frequency", "ground.value"}) {
    CAPTURE(name);
    CHECK_THROWS_AS(value(scene, name), ParameterError);
    CHECK_THROWS_AS(set(scene, name, 1), ParameterError);
    CHECK_THROWS_AS(parameter_field(scene, name), ParameterError);
  }
}

TEST_CASE(
    "a value out of a parameter's bounds is refused with the bound and its unit, and nothing is changed") {
  Scene scene = tied_scene();
  CHECK_THROWS_WITH(set(scene, "m.value", -1), "parameter \"m.value\": found -1, must be at least 0 kg");
  CHECK_THROWS_WITH(set(scene, "d1.stiffness", 0),
                    "parameter \"d1.stiffness\": found 0, must be above 0 N/m");
  CHECK_THROWS_WITH(set(scene, "load", -2), "parameter \"load\": found -2, must be at least 0 N");
  CHECK_THROWS_WITH(set(scene, "f.sine", std::numeric_limits<double>::infinity()),
                    "parameter \"f.sine\": found inf, must be a finite number (N)");
  CHECK_THROWS_AS(set(scene, "f.sine", std::numeric_limits<double>::quiet_NaN()), ParameterError);
  CHECK(scene == tied_scene());
}

TEST_CASE("each type of element is known by its name and describes its fields") {
  std::vector<std::string> names;
  for (const PartType* type : arcslip::elements::laws()) {
    names.emplace_back(type->name());
    CHECK_FALSE(type->help().empty());
    for (const Field& field : type->fields({})) {
      CHECK_FALSE(field.unit.empty());
      CHECK_FALSE(field.help.empty());
    }
  }
  CHECK(names == std::vector<std::string>{"jenkins", "contact_2d", "contact_3d", "iwan", "bouc_wen",
                                          "tanh_friction", "coulomb", "quadratic_damper", "van_der_pol",
                                          "cubic_spring", "polynomial_spring", "polynomial_coupling",
                                          "gap_spring", "bilinear_spring", "piecewise_linear_spring",
                                          "formula"});
}

TEST_CASE("combinations of for_each are made one at a time, the last list fastest, however many there are") {
  ValueLists lists;
  CHECK(Combinations(lists).count() == 1);
  CHECK(Combinations(lists)[0].empty());
  lists = {{"a", {1, 2}}, {"b", {3, 4, 5}}};
  const Combinations six(lists);
  REQUIRE(six.size() == 6);
  CHECK(six[0] == Setting{{"a", 1}, {"b", 3}});
  CHECK(six[1] == Setting{{"a", 1}, {"b", 4}});
  CHECK(six[5] == Setting{{"a", 2}, {"b", 5}});

  std::vector<double> thousand(1000);
  for (std::size_t i = 0; i < thousand.size(); ++i) thousand[i] = static_cast<double>(i);
  lists = {{"a", thousand}, {"b", thousand}, {"c", thousand}};
  CHECK(Combinations(lists).count() == 1e9);
  CHECK(Combinations(lists)[123'456'789] == Setting{{"a", 123}, {"b", 456}, {"c", 789}});
  lists.emplace_back("d", thousand);
  CHECK(Combinations(lists).count() == 1e12);
  CHECK(Combinations(lists).size() == static_cast<std::size_t>(std::numeric_limits<int>::max()));
}
