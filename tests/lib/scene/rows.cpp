// for_each as rows of values, next to the product of lists; labels of axes.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/scene/format/bad_scenes.hpp"

#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/scene/combinations.hpp>

using namespace arcslip::scene;
using namespace arcslip::scene::test;

namespace {

Scene with_for_each(const std::string& text) {
  return scenes::parse(good_scene_with("{\"d.normal_load\": [1, 2]}", text));
}

std::vector<Setting> settings(const Study& study) {
  const Combinations all(study);
  std::vector<Setting> found;
  for (std::size_t k = 0; k < all.size(); ++k) found.push_back(all[k]);
  return found;
}

}  // namespace

TEST_CASE("rows of for_each are one combination each, whatever the order of their parameters") {
  const Scene s = with_for_each(
      R"([{"k.value": 1, "m.value": 5}, {"m.value": 6, "k.value": 2}, {"k.value": 1, "m.value": 7}])");
  const std::vector<Setting> expected = {
      {{"k.value", 1}, {"m.value", 5}}, {{"k.value", 2}, {"m.value", 6}}, {{"k.value", 1}, {"m.value", 7}}};
  CHECK(settings(s.studies[0]) == expected);
  CHECK(Combinations(s.studies[0]).count() == 3);
  CHECK(scenes::parse(write(s)) == s);
}

TEST_CASE("rows of for_each are written as they are read, and one without the others is another study") {
  const Scene rows = with_for_each(R"([{"k.value": 1, "m.value": 5}, {"k.value": 2, "m.value": 6}])");
  const Scene lists = with_for_each(R"({"k.value": [1, 2], "m.value": [5, 6]})");
  CHECK(write(rows).find(R"("for_each": [{"k.value": 1, "m.value": 5}, {"k.value": 2, "m.value": 6}])") !=
        std::string::npos);
  CHECK(rows != lists);
  CHECK(hash(rows) != hash(lists));
  CHECK(settings(lists.studies[0]).size() == 4);
}

TEST_CASE("a parameter that is set drops out of the rows, and the last one leaves a study of one result") {
  Scene s = with_for_each(R"([{"k.value": 1, "m.value": 5}, {"k.value": 2, "m.value": 6}])");
  set(s, "k.value", 3);
  CHECK(settings(s.studies[0]) == std::vector<Setting>{{{"m.value", 5}}, {{"m.value", 6}}});
  CHECK(scenes::parse(write(s)) == s);
  set(s, "m.value", 4);
  CHECK(settings(s.studies[0]) == std::vector<Setting>{{}});
  CHECK(scenes::parse(write(s)) == s);
}

TEST_CASE("labels are read, and written where there are any") {
  const Scene s = scenes::parse(good_scene_with(
      "\"response\"",
      R"("labels": {"d.normal_load": "load of the damper", "amplitude": "tip \"x\""}, "response")"));
  CHECK(s.labels == std::vector<std::pair<std::string, std::string>>{{"d.normal_load", "load of the damper"},
                                                                     {"amplitude", "tip \"x\""}});
  CHECK(scenes::parse(write(s)) == s);
  CHECK(write(scenes::parse(good_scene())).find("labels") == std::string::npos);
}
