// The order of the harmonics where branches leave others, and where peaks are flat: what is reported next to
// numbers of integration in time and of many harmonics.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/results/json_writer.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

using namespace arcslip;
using Json = nlohmann::json;

namespace {

Json branches_of(const char* scene) {
  std::ostringstream text;
  results::write_json(text, studies::run(scenes::parse(scene)));
  return Json::parse(text.str())["branches"];
}

}  // namespace

TEST_CASE("a branch that ends at a branch point does not raise the order of all branches", "[numbers]") {
  const Json branches = branches_of(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "elements": [{"name": "nl", "type": "cubic_spring", "at": "x", "stiffness": 1}],
    "excitation": [{"name": "force", "at": "x", "cosine": 25}],
    "studies": [{"kind": "frf", "from": 1, "to": 3, "branches": "all"}]})");
  CHECK(branches.size() == 5);
  for (const Json& branch : branches) {
    CAPTURE(branch["id"], branch["accuracy"].dump());
    CHECK(branch["accuracy"]["error"].get<double>() < 1e-4);
    CHECK(branch["accuracy"]["order"].get<int>() <= 31);
    CHECK(!branch.contains("doubt"));
    if (!branch.contains("leaves")) continue;
    const Json& parent = branches[branch["parent"].get<std::size_t>() - 1];
    const Json& event = parent["events"][branch["leaves"]["event"].get<std::size_t>()];
    CHECK(branch["points"][0]["truncation_estimate"] == event["truncation_estimate"]);
    for (const Json& end : branch["events"]) CHECK(end["truncation_estimate"].get<double>() < 1e-3);
  }
}

TEST_CASE(
    "a flat peak with a Bouc-Wen element is as near to that of the motion in time as its estimate says") {
  const Json branches = branches_of(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x"], "masses": [{"name": "m", "at": "x", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 0.6}],
      "dampers": [{"name": "c", "at": "x", "value": 0.02}]},
    "elements": [{"name": "b", "type": "bouc_wen", "at": "x", "stiffness": 0.4, "elastic_share": 0.2,
      "yield_displacement": 1, "exponent": 2.5, "shape": 0.5}],
    "excitation": [{"name": "f", "at": "x", "cosine": 0.3}], "response": {"at": "x"},
    "studies": [{"kind": "frf", "from": 0.4, "to": 1.6}]})");
  constexpr double in_time = 2.7742736;
  int peaks = 0;
  for (const Json& event : branches[0]["events"]) {
    if (event["kind"] != "peak") continue;
    ++peaks;
    CHECK(event["truncation_estimate"].get<double>() > std::abs(event["amplitude"].get<double>() - in_time));
  }
  CHECK(peaks > 0);
}
