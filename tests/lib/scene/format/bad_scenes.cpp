#include "bad_scenes.hpp"
#include "bad_topics.hpp"

#include <stdexcept>

namespace arcslip::scene::test {
namespace {

void add_keys(std::vector<BadScene>& rows) {
  rows.push_back(
      {"unknown key", good_scene_with("\"masses\"", "\"massses\": [], \"masses\""), "/structure/massses",
       "found the unknown key \"massses\", must be one of \"dofs\", \"masses\", \"springs\", \"dampers\", "
       "\"damping\", \"rotation\", \"matrices\", \"names\", \"beam\", \"rod\", \"cyclic\"; "
       "did you mean \"masses\"?"});
  rows.push_back(
      {"unknown key of an element", good_scene_with("\"normal_load\": 3", "\"normal_load\": 3, \"a/b~c\": 1"),
       "/elements/0/a~1b~0c", "found the unknown key \"a/b~c\", must be one of \"name\", \"type\""});
  rows.push_back({"duplicate key", good_scene_with("\"value\": 1}", "\"value\": 1, \"value\": 1}"),
                  "/structure/masses/0/value", "found the key \"value\" again, must stand only once"});
  rows.push_back({"no format", good_scene_with("\"format\": \"arcslip-scene-1\",", ""), "/format",
                  "found no key \"format\", which is required: must be \"arcslip-scene-2\""});
  rows.push_back({"format of another time", good_scene_with("scene-1", "scene-9"), "/format",
                  "found \"arcslip-scene-9\", must be \"arcslip-scene-2\" or \"arcslip-scene-1\""});
  rows.push_back({"format that is no string", good_scene_with("\"arcslip-scene-1\"", "1"), "/format",
                  "found 1 (a number), must be \"arcslip-scene-2\""});
  rows.push_back({"title that is no string",
                  good_scene_with("\"structure\"", "\"title\": null, \"structure\""), "/title",
                  "found null, must be a string"});
  rows.push_back({"unknown frequency unit",
                  good_scene_with("\"structure\"", "\"frequency_unit\": \"hz\", \"structure\""),
                  "/frequency_unit", "found \"hz\", must be one of \"Hz\", \"rad/s\"; did you mean \"Hz\"?"});
  rows.push_back({"frequency unit that is no string",
                  good_scene_with("\"structure\"", "\"frequency_unit\": [], \"structure\""),
                  "/frequency_unit", "found a list, must be one of \"Hz\", \"rad/s\""});
  rows.push_back({"no structure",
                  "{\"format\": \"arcslip-scene-1\", \"excitation\": [{\"name\": \"f\", \"at\": \"a\"}]}",
                  "/structure", "found no key \"structure\", which is required"});
  rows.push_back(
      {"structure that is no object",
       "{\"format\": \"arcslip-scene-1\", \"structure\": true, \"excitation\": [{\"name\": \"f\", \"at\": "
       "\"a\"}], \"studies\": [{\"kind\": \"frf\", \"from\": 1, \"to\": 2, \"for_each\": {\"k.value\": "
       "[1]}}]}",
       "/structure", "found true, must be an object with the keys \"dofs\""});
}

void add_rest(std::vector<BadScene>& rows) {
  const std::string force = "{\"name\": \"f\", \"at\": \"a\", \"cosine\": 1}";
  const auto with_harmonics = [](const std::string& text) {
    return good_scene_with("\"response\"", "\"harmonics\": " + text + ", \"response\"");
  };
  rows.push_back({"no excitation", good_scene_with("\"excitation\": [" + force + "],", ""), "/excitation",
                  "found no key \"excitation\", which is required: must be a list of at least one force"});
  rows.push_back({"empty excitation", good_scene_with(force, ""), "/excitation",
                  "found an empty list, must be a list of at least one force"});
  rows.push_back({"harmonic below zero", good_scene_with("\"cosine\": 1", "\"harmonic\": -1"),
                  "/excitation/0/harmonic", "found -1, must be an integer from 0 to 2000"});
  rows.push_back(
      {"constant force alone", good_scene_with("\"cosine\": 1", "\"harmonic\": 0, \"cosine\": 1"),
       "/excitation",
       "found constant forces alone, must have a force or a motion of the ground of a harmonic above 0"});
  rows.push_back({"sine of a constant force",
                  good_scene_with("\"cosine\": 1}",
                                  "\"cosine\": 1}, {\"name\": \"load\", \"at\": \"a\", "
                                  "\"harmonic\": 0, \"sine\": 2}"),
                  "/excitation/1/sine", "found 2, must be 0 where the harmonic is 0: the force is constant"});
  rows.push_back({"harmonic above the order",
                  good_scene_with("\"cosine\": 1}],", "\"harmonic\": 9}], \"harmonics\": {\"order\": 7},"),
                  "/excitation/0/harmonic", "found 9, must be at most harmonics.order, which is 7"});
  const auto with_labels = [](const std::string& text) {
    return good_scene_with("\"response\"", "\"labels\": " + text + ", \"response\"");
  };
  rows.push_back(
      {"labels that are no object", with_labels("[]"), "/labels", "found a list, must be an object"});
  rows.push_back({"label that is no string", with_labels("{\"amplitude\": 1}"), "/labels/amplitude",
                  "found 1 (a number), must be a string, the label of an axis"});
  rows.push_back({"empty label", with_labels("{\"amplitude\": \"\"}"), "/labels/amplitude",
                  "found \"\", must be a label of at least one character"});
  rows.push_back({"label of an unknown quantity", with_labels("{\"amplitud\": \"tip\"}"), "/labels/amplitud",
                  "found \"amplitud\", must be a parameter, or one of \"frequency\", \"amplitude\", "
                  "\"displacement\"; did you mean \"amplitude\"?"});
  rows.push_back({"label of an unknown parameter", with_labels("{\"d.load\": \"load\"}"), "/labels/d.load",
                  "found the unknown parameter \"d.load\", must be one of"});
  rows.push_back({"harmonics that are no object", with_harmonics("7"), "/harmonics",
                  "found 7 (a number), must be an object with the keys \"order\", \"accuracy\", \"period\", "
                  "\"friction\", \"samples\", \"kinks\""});
  rows.push_back(
      {"unknown treatment of kinks", with_harmonics("{\"kinks\": \"pass\"}"), "/harmonics/kinks",
       "found \"pass\", must be one of \"auto\", \"located\", \"passed\"; did you mean \"passed\"?"});
  rows.push_back({"order of zero", with_harmonics("{\"order\": 0}"), "/harmonics/order",
                  "found 0, must be an integer from 1 to 2000"});
  rows.push_back({"order of 2001", with_harmonics("{\"order\": 2001}"), "/harmonics/order",
                  "found 2001, must be an integer from 1 to 2000"});
  rows.push_back({"order of 2.5", with_harmonics("{\"order\": 2.5}"), "/harmonics/order",
                  "found 2.5, must be an integer from 1 to 2000"});
  rows.push_back({"order of 1e300", with_harmonics("{\"order\": 1e300}"), "/harmonics/order",
                  "found 1e+300, must be an integer from 1 to 2000"});
  for (const std::string value : {"0", "0.2", "-0.001", "1e-11"})
    rows.push_back({"accuracy of " + value, with_harmonics("{\"accuracy\": " + value + "}"),
                    "/harmonics/accuracy", "found " + value + ", must be"});
  rows.push_back({"period of zero", with_harmonics("{\"period\": 0}"), "/harmonics/period",
                  "found 0, must be an integer from 1 to 100"});
  rows.push_back({"period of 101", with_harmonics("{\"period\": 101}"), "/harmonics/period",
                  "found 101, must be an integer from 1 to 100"});
  rows.push_back({"harmonic above the order over the period", with_harmonics("{\"order\": 7, \"period\": 8}"),
                  "/excitation/0/harmonic",
                  "found 1, must be at most harmonics.order/harmonics.period, which is 7/8"});
  rows.push_back({"order that is no number", with_harmonics("{\"order\": \"7\"}"), "/harmonics/order",
                  "found \"7\" (a string), must be an integer from 1 to 2000"});
  rows.push_back({"unknown treatment of friction", with_harmonics("{\"friction\": \"sampeld\"}"),
                  "/harmonics/friction",
                  "found \"sampeld\", must be one of \"exact\", \"sampled\"; did you mean \"sampled\"?"});
  rows.push_back({"too few samples",
                  with_harmonics("{\"order\": 30, \"friction\": \"sampled\", \"samples\": 123}"),
                  "/harmonics/samples", "found 123, must be an integer from 124 (4*order + 4) to 1000000"});
  rows.push_back({"too few samples by default", with_harmonics("{\"order\": 128, \"friction\": \"sampled\"}"),
                  "/harmonics/samples",
                  "found 512 (the default), must be an integer from 516 (4*order + 4)"});
  rows.push_back(
      {"samples that no period of the excitation has in whole",
       with_harmonics("{\"order\": 9, \"period\": 3, \"friction\": \"sampled\", \"samples\": 512}"),
       "/harmonics/samples",
       "found 512, must be a multiple of harmonics.period, which is 3, where friction is sampled"});
  rows.push_back({"too many samples", with_harmonics("{\"friction\": \"sampled\", \"samples\": 1000001}"),
                  "/harmonics/samples",
                  "found 1000001, must be an integer from 1 to 1000000, and at least 4*order + 4"});
  const auto with_cyclic = [](const std::string& text) {
    return good_scene_with("\"dofs\"", "\"cyclic\": " + text + ", \"dofs\"");
  };
  rows.push_back({"a ring of one sector", with_cyclic("{\"sectors\": 1, \"engine_order\": 1}"),
                  "/structure/cyclic/sectors", "found 1, must be an integer from 2"});
  rows.push_back({"a ring without an engine order", with_cyclic("{\"sectors\": 3}"),
                  "/structure/cyclic/engine_order", "found no key \"engine_order\""});
  rows.push_back({"mistuning of one sector",
                  with_cyclic("{\"sectors\": 3, \"engine_order\": 1, \"mistuning\": {}}"),
                  "/structure/cyclic/mistuning",
                  "found \"mistuning\", which belongs to a full ring; must have \"full\": true next to it"});
  rows.push_back({"mistuned twice",
                  with_cyclic("{\"sectors\": 3, \"engine_order\": 1, \"full\": true, \"mistuning\": "
                              "{\"k.value\": [1, 2, 1], \"k.value\": [1, 2, 1]}}"),
                  "/structure/cyclic/mistuning/k.value", "found the key \"k.value\" again"});
  rows.push_back({"a factor missing in a mistuning",
                  with_cyclic("{\"sectors\": 3, \"engine_order\": 1, \"full\": true, \"mistuning\": "
                              "{\"k.value\": [1, 2]}}"),
                  "/structure/cyclic/mistuning/k.value", "found a list of 2, must be a list of 3 numbers"});
  rows.push_back({"no response", good_scene_with("\"response\": {\"at\": \"a\"},", ""), "/response",
                  "found no key \"response\", which is required where there are several degrees of freedom"});
  rows.push_back({"response without a place",
                  good_scene_with("\"response\": {\"at\": \"a\"}", "\"response\": {}"), "/response",
                  "found no place, must have exactly one of"});
  rows.push_back({"response at ground",
                  good_scene_with("\"response\": {\"at\": \"a\"}", "\"response\": {\"at\": \"ground\"}"),
                  "/response/at", "found a direction that is zero"});
  rows.push_back({"response that is no object",
                  good_scene_with("\"response\": {\"at\": \"a\"}", "\"response\": \"a\""), "/response",
                  "found \"a\" (a string), must be an object with one of \"at\", \"between\", \"direction\", "
                  "or a list"});
  const auto with_responses = [](const std::string& list) {
    return good_scene_with("\"response\": {\"at\": \"a\"}", "\"response\": " + list);
  };
  rows.push_back({"largest of no places", with_responses("{\"max_of\": []}"), "/response/max_of",
                  "found an empty list, must be a list of at least one place"});
  rows.push_back({"largest of a text", with_responses("{\"max_of\": \"a\"}"), "/response/max_of",
                  "found \"a\" (a string), must be a list of at least one place"});
  rows.push_back({"a place and the largest of others",
                  with_responses("{\"at\": \"a\", \"max_of\": [{\"at\": \"b\"}]}"), "/response",
                  "found \"max_of\" and \"at\" together, must have one of them"});
  rows.push_back({"unknown place among several",
                  with_responses("[{\"name\": \"x\", \"max_of\": [{\"at\": \"a\"}, {\"at\": \"bb\"}]}]"),
                  "/response/0/max_of/1/at", "found \"bb\", must be one of the degrees of freedom"});
  rows.push_back({"unknown place among repeated ones",
                  with_responses("{\"max_of\": [{\"repeat\": 3, \"at\": \"q{i}\"}]}"),
                  "/response/max_of/0/at", "found \"q1\""});
  rows.push_back({"no response in a list", with_responses("[]"), "/response",
                  "found an empty list, must be an object with one of \"at\""});
  rows.push_back({"response in a list without a name", with_responses("[{\"at\": \"a\"}]"),
                  "/response/0/name",
                  "found no key \"name\", which is required: must be a string, the name of the response"});
  rows.push_back({"two responses of a name",
                  with_responses("[{\"name\": \"x\", \"at\": \"a\"}, {\"name\": \"x\", \"at\": \"b\"}]"),
                  "/response/1/name", "found the name \"x\" again; responses must have different names"});
  rows.push_back({"response with a name that is not allowed",
                  with_responses("[{\"name\": \"x.y\", \"at\": \"a\"}]"), "/response/0/name",
                  "found \"x.y\", must be a name without '.', '=' and white space"});
  rows.push_back({"response in a list that is no object", with_responses("[7]"), "/response/0",
                  "found 7 (a number), must be an object with the keys \"name\""});
}

void add_numbers(std::vector<BadScene>& rows) {
  const auto with_stiffness = [&](const std::string& name, const std::string& text,
                                  const std::string& message) {
    rows.push_back({name, good_scene_with("\"stiffness\": 10,", "\"stiffness\": \"" + text + "\","),
                    "/elements/0/stiffness", message});
  };
  with_stiffness("number in another unit", "3 kg",
                 "found \"3 kg\" (a string), must be in a unit of the same dimension as N/m");
  with_stiffness("number in no unit", "3 parsec", "found the unknown unit \"parsec\"");
  with_stiffness(
      "number in a unit with another capital", "3 n/m",
      "found the unknown unit \"n/m\", must be a unit as \"N/m\", \"mm\", or \"N s/m\"; did you mean "
      "\"N/m\"?");
  with_stiffness("number with a decimal comma", "3,5 N/m",
                 "found \"3,5 N/m\", must have a decimal point: \"3.5 N/m\"");
  with_stiffness("number with a unit out of bounds", "-3 kN/m", "found -3000, must be above 0 N/m");
  with_stiffness("formula with an unknown name", "2*kk",
                 "column 3: found the unknown name \"kk\", must be one of \"m.value\"");
  with_stiffness("formula that ends", "2*", "column 3: ends, must be");
  with_stiffness("formula with an unknown function", "sinn(k)", "found the unknown function \"sinn\"");
  with_stiffness("formula of itself", "2*d.stiffness",
                 "which follows itself: \"d.stiffness\" -> \"d.stiffness\"");
  with_stiffness("formula in kg", "m", "found \"m\", which is kg, must be N/m");
  with_stiffness("formula that adds kg to N/m", "k + m", "which adds or compares N/m and kg");
  with_stiffness("formula out of bounds", "-k", "found \"-k\", which is -100, must be above 0 N/m");
  with_stiffness("formula that divides by 0", "k^2/(k - k)",
                 "which is no finite number, must be above 0 N/m");
  with_stiffness("empty formula", "", "column 1: ends, must be");
  rows.push_back({"formula where none is followed",
                  good_scene_with("\"response\"", "\"harmonics\": {\"accuracy\": \"k\"}, \"response\""),
                  "/harmonics/accuracy", "found \"k\", a formula of parameters, must be a number"});
  const auto with_constants = [](const std::string& text, const std::string& stiffness) {
    std::string scene = good_scene_with("\"response\"", "\"constants\": {" + text + "}, \"response\"");
    return scene.replace(scene.find("\"stiffness\": 10,"), 16, "\"stiffness\": \"" + stiffness + "\",");
  };
  rows.push_back({"formulas in a circle", with_constants("\"a\": \"2*b\", \"b\": \"a + 1\"", "k"),
                  "/constants/a", "found \"2*b\", which follows itself: \"a\" -> \"b\" -> \"a\""});
  rows.push_back({"constant with the name of a part", with_constants("\"k\": 3", "k"),
                  "/structure/springs/0/name", "found the name \"k\" again, which is also at /constants/k"});
  rows.push_back({"constant pi", with_constants("\"pi\": 3", "k"), "/constants/pi",
                  "found \"pi\", which is 3.14159... in formulas; must be another name"});
  rows.push_back({"constant that is a list", with_constants("\"a\": [1]", "k"), "/constants/a",
                  "found a list, must be a number, or an object with the keys"});
  rows.push_back({"constant in millimetres", with_constants("\"a\": {\"value\": 1, \"unit\": \"mm\"}", "k"),
                  "/constants/a/unit", "found the unit \"mm\", must be \"m\""});
  rows.push_back({"constant in no unit", with_constants("\"a\": {\"value\": 1, \"unit\": \"parsec\"}", "k"),
                  "/constants/a/unit", "found the unit \"parsec\", must be a unit as \"N/m\""});
  rows.push_back({"constant out of its bounds",
                  with_constants("\"a\": {\"value\": 3, \"bounds\": [0, 2]}", "k"), "/constants/a/value",
                  "found 3, must be at least 0 and at most 2"});
  rows.push_back({"bounds the wrong way round",
                  with_constants("\"a\": {\"value\": 3, \"bounds\": [4, 2]}", "k"), "/constants/a/bounds",
                  "found 2, must be above the lower bound, which is 4"});
  rows.push_back({"ties in format 2",
                  [&] {
                    std::string text = with_constants("\"a\": 1", "k");
                    text.replace(text.find("arcslip-scene-1"), 15, "arcslip-scene-2");
                    return text.replace(text.find("\"constants\""), 11,
                                        "\"ties\": {\"t\": [\"k.value\"]}, \"constants\"");
                  }(),
                  "/ties", "found \"ties\", which belongs to format \"arcslip-scene-1\""});
}

void add_ties(std::vector<BadScene>& rows) {
  const auto with_ties = [](const std::string& text) {
    return good_scene_with("\"response\"", "\"ties\": " + text + ", \"response\"");
  };
  rows.push_back({"ties that are no object", with_ties("[]"), "/ties", "found a list, must be an object"});
  rows.push_back({"tie that is no list", with_ties("{\"t\": \"k.value\"}"), "/ties/t",
                  "found \"k.value\" (a string), must be a list of at least one parameter"});
  rows.push_back({"empty tie", with_ties("{\"t\": []}"), "/ties/t",
                  "found an empty list, must be a list of at least one"});
  rows.push_back({"tie of numbers", with_ties("{\"t\": [3]}"), "/ties/t/0",
                  "found 3 (a number), must be a string, a parameter \"part.field\""});
  rows.push_back({"tie with the name of a part", with_ties("{\"k\": [\"k.value\"]}"), "/ties/k",
                  "found the name \"k\" again, which is also at /structure/springs/0/name"});
  rows.push_back({"tie with a point in its name", with_ties("{\"k.t\": [\"k.value\"]}"), "/ties/k.t",
                  "found \"k.t\", must be a name without '.'"});
  rows.push_back({"tie twice", with_ties("{\"t\": [\"k.value\"], \"t\": [\"c.value\"]}"), "/ties/t",
                  "found the key \"t\" again, must stand only once"});
  rows.push_back({"tie of an unknown parameter", with_ties("{\"t\": [\"d.normal_laod\"]}"), "/ties/t/0",
                  "found \"d.normal_laod\", must be one of the parameters \"m.value\", \"k.value\""});
  rows.push_back({"tie of a part", with_ties("{\"t\": [\"m\"]}"), "/ties/t/0",
                  "found \"m\", must be one of the parameters"});
  rows.push_back({"field tied twice", with_ties("{\"t\": [\"k.value\"], \"u\": [\"k.value\"]}"), "/ties/u/0",
                  "found \"k.value\" again, which is also at /ties/t/0"});
  rows.push_back({"tie of different units", with_ties("{\"t\": [\"m.value\", \"f.cosine\"]}"), "/ties/t/1",
                  "found \"f.cosine\" (N) tied to \"m.value\" (kg), must have the same unit"});
  rows.push_back({"tie of different values", with_ties("{\"t\": [\"k.value\", \"k2.value\"]}"), "/ties/t",
                  "found k2.value = 50 and k.value = 100, must have one common value"});
  rows.push_back(
      {"sweep of a tied field", with_ties("{\"t\": [\"d.normal_load\"]}"),
       "/studies/0/for_each/d.normal_load",
       "found \"d.normal_load\", which is given by the formula \"t\"; must be what that follows: \"t\""});
}

}  // namespace

const std::string& good_scene() {
  static const std::string text = R"({
  "format": "arcslip-scene-1",
  "structure": {
    "dofs": ["a", "b"],
    "masses": [{"name": "m", "at": "a", "value": 1}],
    "springs": [{"name": "k", "between": ["a", "ground"], "value": 100},
                {"name": "k2", "between": ["a", "b"], "value": 50}],
    "dampers": [{"name": "c", "at": "a", "value": 0.1}]
  },
  "elements": [{"name": "d", "type": "jenkins", "at": "a", "stiffness": 10, "friction_coefficient": 0.5,
                "normal_load": 3}],
  "excitation": [{"name": "f", "at": "a", "cosine": 1}],
  "response": {"at": "a"},
  "studies": [{"kind": "frf", "from": 1, "to": 2, "for_each": {"d.normal_load": [1, 2]}}]
}
)";
  return text;
}

std::string good_scene_with(const std::string& piece, const std::string& replacement) {
  std::string text = good_scene();
  const std::size_t at = text.find(piece);
  if (at == std::string::npos || text.find(piece, at + 1) != std::string::npos)
    throw std::logic_error("the good scene must have this once: " + piece);
  return text.replace(at, piece.size(), replacement);
}

const std::vector<BadScene>& bad_scenes() {
  static const std::vector<BadScene> rows = [] {
    std::vector<BadScene> all;
    add_bad_files(all);
    add_keys(all);
    add_bad_structures(all);
    add_rest(all);
    add_ties(all);
    add_numbers(all);
    add_bad_repeats(all);
    add_bad_studies(all);
    add_bad_designs(all);
    return all;
  }();
  return rows;
}

}  // namespace arcslip::scene::test
