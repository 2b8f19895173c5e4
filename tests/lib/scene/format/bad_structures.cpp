#include "bad_topics.hpp"

namespace arcslip::scene::test {
namespace {

void add_dofs(std::vector<BadScene>& rows) {
  const std::string dofs = "\"dofs\": [\"a\", \"b\"]";
  rows.push_back({"no degrees of freedom", good_scene_with(dofs + ",", ""), "/structure/dofs",
                  "found no key \"dofs\", which is required: must be a list of at least one name"});
  rows.push_back({"empty list of degrees of freedom", good_scene_with(dofs, "\"dofs\": []"),
                  "/structure/dofs", "found an empty list, must be a list of at least one name"});
  rows.push_back({"degrees of freedom that are no list", good_scene_with(dofs, "\"dofs\": 2"),
                  "/structure/dofs", "found 2 (a number), must be a list of at least one name"});
  rows.push_back({"degree of freedom that is no string", good_scene_with(dofs, "\"dofs\": [\"a\", 2]"),
                  "/structure/dofs/1", "found 2 (a number), must be a string"});
  rows.push_back({"degree of freedom without a name", good_scene_with(dofs, "\"dofs\": [\"a\", \"\"]"),
                  "/structure/dofs/1", "found \"\", must be a name of at least one character"});
  rows.push_back({"degree of freedom \"ground\"",
                  good_scene_with(dofs, "\"dofs\": [\"a\", \"b\", \"ground\"]"), "/structure/dofs/2",
                  "found \"ground\", which is reserved"});
  std::string many = "\"dofs\": [\"a\", \"b\"";
  for (int i = 2; i < 10'000; ++i) many += ", \"x" + std::to_string(i) + "\"";
  rows.push_back({"10 000 degrees of freedom", good_scene_with(dofs, many + "]"), "/structure/dofs",
                  "found 10000 degrees of freedom, must be at most 1000: the matrices of the linear part are "
                  "dense"});
  rows.push_back({"degree of freedom twice", good_scene_with(dofs, "\"dofs\": [\"a\", \"b\", \"a\"]"),
                  "/structure/dofs/2", "found \"a\" again, which is also at /structure/dofs/0"});
  rows.push_back({"nothing acts on a degree of freedom",
                  good_scene_with(dofs, "\"dofs\": [\"a\", \"b\", \"c\"]"), "/structure/dofs/2",
                  "found nothing that acts on \"c\", must have a mass, spring or damper"});
  rows.push_back({"only a spring of zero acts on a degree of freedom",
                  good_scene_with("\"value\": 50}", "\"value\": 0}"), "/structure/dofs/1",
                  "found nothing that acts on \"b\""});
}

void add_places(std::vector<BadScene>& rows) {
  const std::string place = "\"between\": [\"a\", \"ground\"]";
  rows.push_back({"unknown degree of freedom", good_scene_with(place, "\"at\": \"aa\""),
                  "/structure/springs/0/at",
                  "found \"aa\", must be one of the degrees of freedom \"a\", \"b\" or \"ground\"; did you "
                  "mean \"a\"?"});
  rows.push_back({"unknown degree of freedom in between",
                  good_scene_with(place, "\"between\": [\"a\", \"blade\"]"), "/structure/springs/0/between/1",
                  "found \"blade\", must be one of the degrees of freedom"});
  rows.push_back(
      {"unknown degree of freedom in a direction", good_scene_with(place, "\"direction\": {\"x/y\": 1}"),
       "/structure/springs/0/direction/x~1y", "found \"x/y\", must be one of the degrees of freedom"});
  rows.push_back({"at that is no string", good_scene_with(place, "\"at\": 0"), "/structure/springs/0/at",
                  "found 0 (a number), must be a string, the name of a degree of freedom"});
  rows.push_back({"between that is no list", good_scene_with(place, "\"between\": \"a\""),
                  "/structure/springs/0/between", "found \"a\" (a string), must be a list of two names"});
  rows.push_back({"between three", good_scene_with(place, "\"between\": [\"a\", \"b\", \"ground\"]"),
                  "/structure/springs/0/between", "found a list of 3, must be a list of two names"});
  rows.push_back({"between numbers", good_scene_with(place, "\"between\": [\"a\", 2]"),
                  "/structure/springs/0/between/1",
                  "found 2 (a number), must be a string, the name of a degree of freedom"});
  rows.push_back({"direction that is no object", good_scene_with(place, "\"direction\": [1]"),
                  "/structure/springs/0/direction", "found a list, must be an object"});
  rows.push_back({"weight that is no number", good_scene_with(place, "\"direction\": {\"a\": [1]}"),
                  "/structure/springs/0/direction/a", "found a list, must be a finite number"});
  rows.push_back({"no place", good_scene_with(place + ",", ""), "/structure/springs/0",
                  "found no place, must have exactly one of \"at\", \"between\", \"direction\""});
  rows.push_back({"two places", good_scene_with(place, place + ", \"at\": \"a\""), "/structure/springs/0",
                  "found \"at\", \"between\" together, must have exactly one of"});
  rows.push_back({"from ground to ground", good_scene_with(place, "\"between\": [\"ground\", \"ground\"]"),
                  "/structure/springs/0/between", "found a direction that is zero"});
  rows.push_back({"from a to a", good_scene_with(place, "\"between\": [\"a\", \"a\"]"),
                  "/structure/springs/0/between", "found a direction that is zero"});
  rows.push_back({"empty direction", good_scene_with(place, "\"direction\": {}"),
                  "/structure/springs/0/direction",
                  "found a direction that is zero, must act on at least one degree of freedom"});
}

void add_parts(std::vector<BadScene>& rows) {
  const std::string mass = "\"name\": \"m\"";
  rows.push_back(
      {"dampers that are no list",
       good_scene_with("\"dampers\": [{\"name\": \"c\", \"at\": \"a\", \"value\": 0.1}]", "\"dampers\": {}"),
       "/structure/dampers", "found an object, must be a list of objects"});
  rows.push_back({"part that is no object", good_scene_with("\"dampers\": [", "\"dampers\": [false, "),
                  "/structure/dampers/0", "found false, must be an object with the keys \"name\""});
  rows.push_back({"element that is no object", good_scene_with("\"elements\": [", "\"elements\": [0, "),
                  "/elements/0", "found 0 (a number), must be an object"});
  rows.push_back({"part without a name", good_scene_with(mass + ",", ""), "/structure/masses/0/name",
                  "found no key \"name\", which is required"});
  rows.push_back({"name that is no string", good_scene_with(mass, "\"name\": 1"), "/structure/masses/0/name",
                  "found 1 (a number), must be a string, the name of the part"});
  rows.push_back({"empty name", good_scene_with(mass, "\"name\": \"\""), "/structure/masses/0/name",
                  "found \"\", must be a name of at least one character"});
  for (const std::string name : {"a.b", "a=b", "a b", "a\\tb"}) {
    rows.push_back({"name " + name, good_scene_with(mass, "\"name\": \"" + name + "\""),
                    "/structure/masses/0/name",
                    "found \"" + name + "\", must be a name without '.', '=' and white space"});
  }
  rows.push_back({"part \"ground\"", good_scene_with(mass, "\"name\": \"ground\""),
                  "/structure/masses/0/name", "found \"ground\", which is reserved for the fixed frame"});
  rows.push_back({"part \"frequency\"", good_scene_with(mass, "\"name\": \"frequency\""),
                  "/structure/masses/0/name",
                  "found \"frequency\", which is reserved for the excitation frequency"});
  rows.push_back({"duplicate name", good_scene_with(mass, "\"name\": \"k\""), "/structure/springs/0/name",
                  "found the name \"k\" again, which is also at /structure/masses/0/name"});
  rows.push_back({"no value", good_scene_with(", \"value\": 1}", "}"), "/structure/masses/0/value",
                  "found no key \"value\", which is required: must be at least 0 kg"});
  rows.push_back({"value that is no number", good_scene_with("\"value\": 1}", "\"value\": [1]}"),
                  "/structure/masses/0/value", "found a list, must be a number, at least 0 kg"});
  rows.push_back({"negative mass", good_scene_with("\"value\": 1}", "\"value\": -1.24}"),
                  "/structure/masses/0/value", "found -1.24, must be at least 0 kg"});
  rows.push_back({"mass of 1e999 kg", good_scene_with("\"value\": 1}", "\"value\": 1e999}"),
                  "/structure/masses/0/value",
                  "found 1e999 (a number that is too large), must be a finite number"});
  rows.push_back({"mass of 400 digits",
                  good_scene_with("\"value\": 1}", "\"value\": " + std::string(400, '9') + "}"),
                  "/structure/masses/0/value",
                  "... (400 digits) (a number that is too large), must be a finite number"});
  rows.push_back({"spring of -1e999 N/m", good_scene_with("50}", "-1e999}"), "/structure/springs/1/value",
                  "found -1e999 (a number that is too large), must be a finite number"});
  rows.push_back({"negative damper", good_scene_with("0.1}", "-0.1}"), "/structure/dampers/0/value",
                  "found -0.1, must be at least 0 N s/m"});
  rows.push_back({"element without a type", good_scene_with("\"type\": \"jenkins\",", ""), "/elements/0/type",
                  "found no key \"type\", which is required: must be one of \"jenkins\", "});
  rows.push_back({"unknown type of element", good_scene_with("\"jenkins\"", "\"jenkin\""), "/elements/0/type",
                  "; did you mean \"jenkins\"?"});
  rows.push_back({"type that is no string", good_scene_with("\"jenkins\"", "{}"), "/elements/0/type",
                  "found an object, must be one of \"jenkins\", "});
  rows.push_back({"contact stiffness of zero", good_scene_with("\"stiffness\": 10", "\"stiffness\": 0"),
                  "/elements/0/stiffness", "found 0, must be above 0 N/m"});
  rows.push_back({"negative friction coefficient",
                  good_scene_with("\"friction_coefficient\": 0.5", "\"friction_coefficient\": -0.5"),
                  "/elements/0/friction_coefficient", "found -0.5, must be at least 0"});
  rows.push_back({"negative normal load", good_scene_with("\"normal_load\": 3", "\"normal_load\": -3"),
                  "/elements/0/normal_load", "found -3, must be at least 0 N"});
  rows.push_back(
      {"cubic spring without stiffness",
       good_scene_with("\"elements\": [",
                       "\"elements\": [{\"name\": \"n\", \"type\": \"cubic_spring\", \"at\": \"b\"}, "),
       "/elements/0/stiffness", "must be a finite number (N/m^3)"});
  const auto with_spring = [](const std::string& keys) {
    return good_scene_with("\"elements\": [",
                           "\"elements\": [{\"name\": \"n\", \"at\": \"b\", \"type\": " + keys + "}, ");
  };
  rows.push_back({"choice that is neither true nor false",
                  with_spring("\"gap_spring\", \"stiffness\": 1, \"gap\": 0, \"two_sided\": 1"),
                  "/elements/0/two_sided", "found 1 (a number), must be true or false"});
  rows.push_back(
      {"negative corner of a spring",
       with_spring("\"bilinear_spring\", \"stiffness\": 1, \"stiffness_beyond\": 2, \"corner\": -1"),
       "/elements/0/corner", "found -1, must be at least 0 m"});
  const auto with_table = [&](const std::string& table) {
    return with_spring("\"piecewise_linear_spring\", \"table\": " + table);
  };
  rows.push_back({"spring without its table", with_spring("\"piecewise_linear_spring\""), "/elements/0/table",
                  "found no key \"table\", which is required: must be a list of at least two points [q, f]"});
  rows.push_back({"table of one point", with_table("[[0, 0]]"), "/elements/0/table",
                  "found 1 point, must be a list of at least two points [q, f] (m and N), q ascending"});
  rows.push_back({"table that does not ascend", with_table("[[0, 0], [1, 1], [1, 2]]"), "/elements/0/table/2",
                  "found q = 1 after 1, must be ascending"});
  rows.push_back({"point of three numbers", with_table("[[0, 0], [1, 1, 1]]"), "/elements/0/table/1",
                  "found a list of 3, must be a point [q, f]"});
  rows.push_back({"force of 1e999 N in a table", with_table("[[0, 0], [1, 1e999]]"), "/elements/0/table/1/1",
                  "found 1e999 (a number that is too large), must be a finite number"});
  rows.push_back({"slope of 1e600 N/m in a table", with_table("[[0, 0], [1e-300, 1e300]]"),
                  "/elements/0/table/1",
                  "found a slope that is too large for a number between f = 0 and 1e+300"});
  rows.push_back({"no mass",
                  good_scene_with("\"masses\": [{\"name\": \"m\", \"at\": \"a\", \"value\": 1}],", ""),
                  "/structure/masses", "found no mass, must have at least one mass with a value above 0 kg"});
  rows.push_back({"every mass zero", good_scene_with("\"value\": 1}", "\"value\": 0}"), "/structure/masses",
                  "found no mass, must have at least one mass"});
  rows.push_back(
      {"zero stiffness everywhere",
       "{\"format\": \"arcslip-scene-1\", \"structure\": {\"dofs\": [\"a\"], \"masses\": [{\"name\": \"m\", "
       "\"at\": \"a\", \"value\": 1}], \"springs\": [{\"name\": \"k\", \"at\": \"a\", \"value\": 0}]}, "
       "\"excitation\": [{\"name\": \"f\", \"at\": \"a\", \"cosine\": 1}]}",
       "/structure/springs", "found no stiffness, must have at least one spring"});
}

}  // namespace

void add_bad_structures(std::vector<BadScene>& rows) {
  add_dofs(rows);
  add_places(rows);
  add_parts(rows);
}

}  // namespace arcslip::scene::test
