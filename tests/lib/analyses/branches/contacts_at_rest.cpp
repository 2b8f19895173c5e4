// Structures that rest on a contact under a constant force alone, and those that nothing holds.

#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <cmath>
#include <string>

using namespace arcslip;

namespace {

// A block on a plane. Its contact has this normal load at rest, N; `press`, N, is a constant force towards
// it.
scene::Scene block(double load, double press) {
  scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x", "y"],
      "masses": [{"name": "mx", "at": "x", "value": 1}, {"name": "my", "at": "y", "value": 1}],
      "springs": [{"name": "kx", "at": "x", "value": 1}],
      "dampers": [{"name": "cx", "at": "x", "value": 0.02}, {"name": "cy", "at": "y", "value": 0.1}]},
    "elements": [{"name": "pad", "type": "contact_2d", "tangential": {"at": "x"}, "normal": {"at": "y"},
      "tangential_stiffness": 1, "normal_stiffness": 10, "friction_coefficient": 0.5, "normal_load": 0}],
    "excitation": [{"name": "f", "at": "x", "cosine": 1},
      {"name": "press", "at": "y", "cosine": 5, "harmonic": 0}],
    "harmonics": {"order": 15}, "response": {"at": "x"}, "studies": [{"kind": "frf", "from": 0.3, "to": 2}]})");
  scene::set(s, "pad.normal_load", load);
  scene::set(s, "press.cosine", press);
  return s;
}

const observables::ResponsePoint* highest_peak(const observables::ResponseBranch& branch) {
  const observables::ResponsePoint* found = nullptr;
  for (const auto& event : branch.events)
    if (event.kind == "peak" && (!found || event.point.amplitude > found->amplitude)) found = &event.point;
  return found;
}

}  // namespace

TEST_CASE("a block that a constant force alone presses on a plane is held by its contact") {
  // A gap is closed by the force, which the contact carries then as well.
  for (const double gap_load : {0.0, -2.0}) {
    const auto branches = observables::frequency_response(block(gap_load, 5), {0.3, 2});
    CAPTURE(gap_load, branches[0].stop.message);
    REQUIRE(branches[0].stop.reason == observables::reasons::boundary);
    const auto* peak = highest_peak(branches[0]);
    REQUIRE(peak);
    CHECK(std::abs(peak->amplitude / 3.5014 - 1) < 1e-4);
    CHECK(std::abs(peak->omega / 1.3275 - 1) < 1e-4);
  }
}

TEST_CASE("a constant force that opens the contact, or none, leaves the block free, and that is said") {
  for (const double press : {-5.0, 0.0}) {
    const auto branches = observables::frequency_response(block(0, press), {0.3, 2});
    CAPTURE(press);
    CHECK(branches[0].stop.reason == observables::reasons::start_failed);
    CHECK(branches[0].stop.message.find(
              "no spring holds the mean position of \"y\", nor does a contact that the "
              "constant forces close") != std::string::npos);
  }
}

TEST_CASE("where nothing can open, no contact is spoken of") {
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": ["x", "y"], "masses": [{"name": "m", "at": "x", "value": 1}, {"name": "n", "at": "y", "value": 1}],
      "springs": [{"name": "k", "at": "x", "value": 1}], "dampers": [{"name": "c", "at": "y", "value": 0.1}]},
    "elements": [{"name": "s", "type": "cubic_spring", "at": "x", "stiffness": 1}],
    "excitation": [{"name": "f", "at": "y", "cosine": 1}, {"name": "g", "at": "y", "cosine": 1, "harmonic": 0}],
    "harmonics": {"order": 3}, "response": {"at": "x"}})");
  const auto branches = observables::frequency_response(s, {0.3, 2});
  CHECK(branches[0].stop.message.find("no spring holds the mean position of \"y\", and friction") !=
        std::string::npos);
}

TEST_CASE("a mass that a constant force alone presses against a stop stays there, as on a spring") {
  // It moves by 0.5 N / |10 - w^2 + 0.1 i w| about 0.6 m, more than the stop's gap of 0.1 m by 0.5 m.
  for (const double side : {1.0, -1.0}) {
    scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
      "structure": {"dofs": ["y"], "masses": [{"name": "m", "at": "y", "value": 1}],
        "dampers": [{"name": "c", "at": "y", "value": 0.1}]},
      "elements": [{"name": "stop", "type": "gap_spring", "at": "y", "two_sided": false, "stiffness": 10, "gap": 0.1}],
      "excitation": [{"name": "f", "at": "y", "cosine": 0.5},
        {"name": "press", "at": "y", "cosine": 5, "harmonic": 0}],
      "harmonics": {"order": 5}, "response": {"at": "y"}, "studies": [{"kind": "frf", "from": 0.3, "to": 1.5}]})");
    scene::set(s, "press.cosine", side * 5);
    const auto branches = observables::frequency_response(s, {0.3, 1.5});
    CAPTURE(side, branches[0].stop.message);
    if (side < 0) {
      CHECK(branches[0].stop.reason == observables::reasons::start_failed);
      continue;
    }
    REQUIRE(branches[0].stop.reason == observables::reasons::boundary);
    for (const auto& point : branches[0].points)
      CHECK(std::abs(point.amplitude - 0.6 -
                     0.5 / std::hypot(10 - point.omega * point.omega, 0.1 * point.omega)) < 1e-9);
  }
}

TEST_CASE("a wedge pressed between two masses is held by its two contacts") {
  const scene::Scene s = scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "Hz",
    "structure": {"dofs": ["x1", "y1", "x2", "y2", "xd", "yd"],
      "masses": [{"name": "m_x1", "at": "x1", "value": 1.0}, {"name": "m_y1", "at": "y1", "value": 1.0},
        {"name": "m_x2", "at": "x2", "value": 1.0}, {"name": "m_y2", "at": "y2", "value": 1.0},
        {"name": "m_xd", "at": "xd", "value": 0.1}, {"name": "m_yd", "at": "yd", "value": 0.1}],
      "springs": [{"name": "k_x1", "at": "x1", "value": 3e5}, {"name": "k_y1", "at": "y1", "value": 3e5},
        {"name": "k_x2", "at": "x2", "value": 3e5}, {"name": "k_y2", "at": "y2", "value": 3e5},
        {"name": "k12x", "between": ["x1", "x2"], "value": 7e5},
        {"name": "k12y", "between": ["y1", "y2"], "value": 7e5},
        {"name": "kxy1", "between": ["x1", "y1"], "value": 3e5},
        {"name": "kxy2", "between": ["x2", "y2"], "value": 3e5},
        {"name": "kd", "between": ["xd", "yd"], "value": 3e5}],
      "dampers": [{"name": "c_x1", "at": "x1", "value": 20}, {"name": "c_y1", "at": "y1", "value": 20},
        {"name": "c_x2", "at": "x2", "value": 20}, {"name": "c_y2", "at": "y2", "value": 20}]},
    "elements": [
      {"name": "left", "type": "contact_2d", "tangential_stiffness": 3e5, "normal_stiffness": 3e5,
        "friction_coefficient": 0.5, "normal_load": 0,
        "tangential": {"direction": {"xd": 0.8660254037844387, "yd": 0.5, "x1": -0.8660254037844387, "y1": -0.5}},
        "normal": {"direction": {"xd": -0.5, "yd": 0.8660254037844387, "x1": 0.5, "y1": -0.8660254037844387}}},
      {"name": "right", "type": "contact_2d", "tangential_stiffness": 3e5, "normal_stiffness": 3e5,
        "friction_coefficient": 0.5, "normal_load": 0,
        "tangential": {"direction": {"xd": 0.8660254037844387, "yd": -0.5, "x2": -0.8660254037844387, "y2": 0.5}},
        "normal": {"direction": {"xd": 0.5, "yd": 0.8660254037844387, "x2": -0.5, "y2": -0.8660254037844387}}}],
    "excitation": [{"name": "f1", "at": "y1", "sine": -20}, {"name": "f2", "at": "x2", "sine": 5},
      {"name": "press", "at": "yd", "cosine": 120, "harmonic": 0}],
    "harmonics": {"order": 7}, "response": {"at": "y2"}, "studies": [{"kind": "frf", "from": 155, "to": 170}]})");
  const auto branches = observables::frequency_response(s, {155, 170});
  CAPTURE(branches[0].stop.message);
  REQUIRE(branches[0].stop.reason == observables::reasons::boundary);
  const auto* peak = highest_peak(branches[0]);
  REQUIRE(peak);
  CHECK(std::abs(peak->amplitude / 3.733e-4 - 1) < 3e-4);  // by Runge-Kutta
  CHECK(std::abs(peak->omega / scenes::hertz / 162.7 - 1) < 3e-4);
}
