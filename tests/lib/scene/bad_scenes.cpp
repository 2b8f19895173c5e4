#include "bad_scenes.hpp"
#include "bad_studies.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <streambuf>
#include <utility>

namespace arcslip::scene::test {
namespace {

// A text and its last character many times again, of which little is in memory at a time.
class RepeatingBuffer : public std::streambuf {
 public:
  RepeatingBuffer(std::string text, std::size_t repeats)
      : text_(std::move(text)), block_(1 << 16, text_.back()), repeats_(repeats) {
    setg(text_.data(), text_.data(), text_.data() + text_.size());
  }

 protected:
  int_type underflow() override {
    const std::size_t count = std::min(repeats_, block_.size());
    if (count == 0) return traits_type::eof();
    repeats_ -= count;
    setg(block_.data(), block_.data(), block_.data() + count);
    return traits_type::to_int_type(block_.front());
  }

 private:
  std::string text_, block_;
  std::size_t repeats_;
};

class RepeatingStream : public std::istream {
 public:
  RepeatingStream(const std::string& text, std::size_t repeats)
      : std::istream(nullptr), buffer_(text, repeats) {
    rdbuf(&buffer_);
  }

 private:
  RepeatingBuffer buffer_;
};

void add_files(std::vector<BadScene>& rows) {
  const std::string& good = good_scene();
  rows.push_back({"empty file", "", "", "line 1, column 1: the file is empty, must hold a scene"});
  rows.push_back({"only white space", " \n\t\n", "", "line 3, column 1: the file is empty"});
  rows.push_back({"truncated JSON", good.substr(0, good.size() / 2), "", "the file ends too early"});
  rows.push_back({"truncated in a number", "{\"a\": -", "", "line 1, column 8: the file ends too early"});
  rows.push_back({"truncated in a string", "{\n\"form", "", "line 2, column 6: the file ends too early"});
  rows.push_back({"no JSON at all", "structure: 3", "", "line 1, column 1: this is not JSON"});
  rows.push_back({"a comma too many", "{\"format\":\n \"arcslip-scene-1\",}", "",
                  "line 2, column 20: this is not JSON"});
  rows.push_back({"something after the end", good + "x", "", "expected end of input"});
  rows.push_back({"something after the end, behind a NUL byte", "{}\n" + std::string(1, '\0') + good, "",
                  "line 2, column 1: found a NUL byte, must be JSON in UTF-8, which has none"});
  rows.push_back({"text that is not UTF-8", "{\"title\": \"\xff\"}", "", "ill-formed UTF-8 byte"});
  rows.push_back(
      {"100 000 nested lists", std::string(100'000, '['), "",
       "line 1, column 65: found lists or objects nested deeper than 64, must be at most 64 deep"});
  std::string objects;
  for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
  rows.push_back({"100 000 nested objects", objects, "", "nested deeper than 64"});
  rows.push_back({"a number of 1 GB", "[1", "",
                  "found more than 67108864 bytes, a scene must be at most 64 MB", 1'000'000'000});
  rows.push_back({"a number of 20 000 digits", "[" + std::string(20'000, '1') + "]", "",
                  "\"... (20000 bytes), a number that is too large, must be a finite number"});
  rows.push_back(
      {"1e99999", good_scene_with("50}", "1e99999}"), "", "found \"1e99999\", a number that is too large"});
  rows.push_back({"NaN", good_scene_with("50}", "NaN}"), "", "JSON has no NaN and no Infinity"});
  rows.push_back({"nan", good_scene_with("50}", "nan}"), "", "JSON has no NaN and no Infinity"});
  rows.push_back({"Infinity", good_scene_with("50}", "Infinity}"), "", "JSON has no NaN and no Infinity"});
  rows.push_back({"-Infinity", good_scene_with("50}", "-Infinity}"), "", "JSON has no NaN and no Infinity"});
  rows.push_back(
      {"a list for a scene", "[]", "", "found a list, must be an object with the keys \"format\""});
}

void add_keys(std::vector<BadScene>& rows) {
  rows.push_back(
      {"unknown key", good_scene_with("\"masses\"", "\"massses\": [], \"masses\""), "/structure/massses",
       "found the unknown key \"massses\", must be one of \"dofs\", \"masses\", \"springs\", \"dampers\"; "
       "did you mean \"masses\"?"});
  rows.push_back(
      {"unknown key of an element", good_scene_with("\"normal_load\": 3", "\"normal_load\": 3, \"a/b~c\": 1"),
       "/elements/0/a~1b~0c", "found the unknown key \"a/b~c\", must be one of \"name\", \"type\""});
  rows.push_back({"duplicate key", good_scene_with("\"value\": 1}", "\"value\": 1, \"value\": 1}"),
                  "/structure/masses/0/value", "found the key \"value\" again, must stand only once"});
  rows.push_back({"no format", good_scene_with("\"format\": \"arcslip-scene-1\",", ""), "/format",
                  "found no key \"format\", which is required: must be \"arcslip-scene-1\""});
  rows.push_back({"format of another time", good_scene_with("scene-1", "scene-9"), "/format",
                  "found \"arcslip-scene-9\", must be \"arcslip-scene-1\""});
  rows.push_back({"format that is no string", good_scene_with("\"arcslip-scene-1\"", "1"), "/format",
                  "found 1 (a number), must be \"arcslip-scene-1\""});
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
  rows.push_back({"weight that is no number", good_scene_with(place, "\"direction\": {\"a\": \"1\"}"),
                  "/structure/springs/0/direction/a", "found \"1\" (a string), must be a finite number"});
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
  rows.push_back({"value that is no number", good_scene_with("\"value\": 1}", "\"value\": \"1\"}"),
                  "/structure/masses/0/value", "found \"1\" (a string), must be a number, at least 0 kg"});
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
  rows.push_back({"harmonic above the order", good_scene_with("\"cosine\": 1", "\"harmonic\": 9"),
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
                  "found 7 (a number), must be an object with the keys \"order\", \"period\", \"friction\", "
                  "\"samples\""});
  rows.push_back({"order of zero", with_harmonics("{\"order\": 0}"), "/harmonics/order",
                  "found 0, must be an integer from 1 to 2000"});
  rows.push_back({"order of 2001", with_harmonics("{\"order\": 2001}"), "/harmonics/order",
                  "found 2001, must be an integer from 1 to 2000"});
  rows.push_back({"order of 2.5", with_harmonics("{\"order\": 2.5}"), "/harmonics/order",
                  "found 2.5, must be an integer from 1 to 2000"});
  rows.push_back({"order of 1e300", with_harmonics("{\"order\": 1e300}"), "/harmonics/order",
                  "found 1e+300, must be an integer from 1 to 2000"});
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
  rows.push_back({"sweep of a tied field", with_ties("{\"t\": [\"d.normal_load\"]}"),
                  "/studies/0/for_each/d.normal_load",
                  "found \"d.normal_load\", which is tied; must be its tie \"t\""});
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
    add_files(all);
    add_keys(all);
    add_dofs(all);
    add_places(all);
    add_parts(all);
    add_rest(all);
    add_ties(all);
    add_bad_repeats(all);
    add_bad_studies(all);
    add_bad_designs(all);
    return all;
  }();
  return rows;
}

std::unique_ptr<std::istream> open(const BadScene& bad) {
  if (bad.repeats > 0) return std::make_unique<RepeatingStream>(bad.text, bad.repeats);
  return std::make_unique<std::istringstream>(bad.text);
}

}  // namespace arcslip::scene::test
