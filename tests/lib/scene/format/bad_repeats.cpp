#include "bad_topics.hpp"

namespace arcslip::scene::test {

void add_bad_repeats(std::vector<BadScene>& rows) {
  const auto with_masses = [](const std::string& repeat, const std::string& name) {
    return good_scene_with("\"masses\": [", "\"masses\": [{\"repeat\": " + repeat + ", \"name\": " + name +
                                                ", \"at\": \"a\", \"value\": 1}, ");
  };
  const std::string at = "/structure/masses/0/";
  rows.push_back({"repeated zero times", with_masses("0", "\"r{i}\""), at + "repeat",
                  "found 0, must be an integer from 1 to 10000"});
  rows.push_back({"repeated 10001 times", with_masses("10001", "\"r{i}\""), at + "repeat",
                  "found 10001, must be an integer from 1 to 10000"});
  rows.push_back({"repeated by a text", with_masses("\"12\"", "\"r{i}\""), at + "repeat",
                  "found \"12\" (a string), must be an integer from 1 to 10000, or an object with the keys "
                  "\"count\", \"index\", \"cyclic\""});
  rows.push_back({"repeated without a count", with_masses("{\"cyclic\": true}", "\"r{i}\""),
                  at + "repeat/count",
                  "found no key \"count\", which is required: must be an integer from 1"});
  rows.push_back({"unknown key of a repetition", with_masses("{\"count\": 2, \"ring\": true}", "\"r{i}\""),
                  at + "repeat/ring", "found the unknown key \"ring\", must be one of \"count\", \"index\""});
  rows.push_back({"repetition that is neither cyclic nor not",
                  with_masses("{\"count\": 2, \"cyclic\": 1}", "\"r{i}\""), at + "repeat/cyclic",
                  "found 1 (a number), must be true or false"});
  rows.push_back({"index that is no word", with_masses("{\"count\": 2, \"index\": \"i+1\"}", "\"r{i}\""),
                  at + "repeat/index", "found \"i+1\", must be a name of letters, such as \"i\""});
  for (const std::string braces : {"{j}", "{i", "{}", "{i+}", "{i+-1}", "{i1}", "{i+99999999999}", "{ii}"})
    rows.push_back(
        {"name r" + braces + " over i", with_masses("2", "\"r" + braces + "\""), at + "name",
         "found \"" + braces + "\", must be \"{i}\", or a neighbour such as \"{i+1}\" or \"{i-1}\""});
  rows.push_back({"eleven values for twelve",
                  with_masses("12", "{\"each\": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]}"), at + "name/each",
                  "found a list of 11, must have 12 values, one for each i"});
  rows.push_back({"values for each without an index",
                  good_scene_with("\"value\": 1}", "\"value\": {\"each\": [1, 2]}}"), at + "value",
                  "found an object, must be a number, at least 0 kg"});
  rows.push_back({"repeated twice", with_masses("1, \"repeat\": 1", "\"r{i}\""), at + "repeat",
                  "found the unknown key \"repeat\", must be one of \"name\""});
  rows.push_back({"repeated degree of freedom without a name",
                  good_scene_with("\"dofs\": [\"a\", \"b\"", "\"dofs\": [\"a\", \"b\", {\"repeat\": 1}"),
                  "/structure/dofs/2/name",
                  "found no key \"name\", which is required: must be a string, the name of each"});
  rows.push_back({"repeated degree of freedom with a mass",
                  good_scene_with("\"dofs\": [\"a\", \"b\"",
                                  "\"dofs\": [\"a\", \"b\", {\"repeat\": 1, \"name\": \"c\", \"mass\": 1}"),
                  "/structure/dofs/2/mass", "found the unknown key \"mass\", must be one of \"name\""});
  rows.push_back(
      {"half an engine order",
       good_scene_with("{\"name\": \"f\",", "{\"repeat\": 1, \"engine_order\": 0.5, \"name\": \"f\","),
       "/excitation/0/engine_order", "found 0.5, must be an integer from -1000000 to 1000000"});
  rows.push_back({"engine order of one force",
                  good_scene_with("{\"name\": \"f\",", "{\"engine_order\": 1, \"name\": \"f\","),
                  "/excitation/0/engine_order", "found the key \"engine_order\", which belongs to repeated"});
  rows.push_back(
      {"engine order of an element",
       good_scene_with("{\"name\": \"d\",", "{\"repeat\": 1, \"engine_order\": 1, \"name\": \"d\","),
       "/elements/0/engine_order", "found the unknown key \"engine_order\""});
}

}  // namespace arcslip::scene::test
