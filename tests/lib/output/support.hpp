#pragma once
// Made-up results with numbers that are easy to find again.

#include "lib/scene/folder.hpp"

#include <arcslip/results/reasons.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace support {

namespace fs = std::filesystem;

using TemporaryFolder = Folder;

inline std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// One degree of freedom with a slider; frequencies in Hz.
inline arcslip::scene::Scene scene(const std::string& title = "A slider") {
  std::istringstream text(R"({"format": "arcslip-scene-1", "title": "t", "structure": {"dofs": ["x"],
    "masses": [{"name": "m", "at": "x", "value": 1}], "springs": [{"name": "k", "at": "x", "value": 100}],
    "dampers": [{"name": "c", "at": "x", "value": 0.1}]},
    "elements": [{"name": "damper", "type": "jenkins", "at": "x", "stiffness": 10, "friction_coefficient": 0.5,
                  "normal_load": 3}],
    "excitation": [{"name": "force", "at": "x", "harmonic": 1, "cosine": 1}], "response": {"at": "x"},
    "studies": [{"name": "frf", "kind": "frf", "from": 1, "to": 2}]})");
  arcslip::scene::Scene scene = arcslip::scene::read(text, arcslip::studies::catalogue());
  scene.title = title;
  return scene;
}

inline arcslip::observables::ResponsePoint point(double hertz, double amplitude, double stick_percent = 50) {
  arcslip::observables::ResponsePoint point;
  point.omega = hertz * 2 * 3.14159265358979323846;
  point.amplitude = amplitude;
  point.phase = 0.5;
  point.truncation_estimate = 1e-9;
  point.energy_friction = 0.25;
  point.energy_viscous = 0.125;
  point.elements.push_back({"damper", true, stick_percent, {1.5, 4.5}, {0.5, 3.5}, 0.25, {}});
  point.coefficients = {amplitude, 0, 0, -amplitude};
  point.energy_input = 0.375;
  point.forces = {-40, 30, 2, {10, 6}, {}, {0.5, 8}};
  auto& damper = point.elements.back();
  damper.theta_0 = 0.5;
  damper.theta_star = 1.5;
  damper.fundamental = {1, 0.6};
  damper.equivalent_stiffness = 10;
  damper.equivalent_damping = 0.75;
  return point;
}

/// A resonance at 1.5 Hz: five points and a peak between the second and the third.
inline arcslip::observables::ResponseBranch branch(double normal_load = 3) {
  arcslip::observables::ResponseBranch branch;
  branch.stop = {arcslip::observables::reasons::boundary, 2, 2, "reached the end of the window at 2 Hz"};
  branch.set = {{"damper.normal_load", normal_load}};
  branch.parameters = {{"m.value", 1.0}, {"k.value", 100.0}};
  branch.harmonics = {1, 3};
  branch.points = {point(1, 0.01, 100), point(1.4, 0.05), point(1.6, 0.05), point(1.8, 0.02),
                   point(2, 0.005)};
  branch.events = {{"peak", false, true, point(1.5, 0.1, 40)}};
  branch.solver = {"dense LU", 4, 5, 1, 20, 18, 9, 30, 0.001};
  return branch;
}

/// Resonance peaks over the normal load, from 0.1 N to 30 N, with the least between the second and the third.
inline arcslip::observables::ResponseBranch peaks() {
  const auto at = [](double load, double hertz, double amplitude, double stick) {
    auto result = point(hertz, amplitude, stick);
    result.over = load;
    return result;
  };
  arcslip::observables::ResponseBranch branch;
  branch.stop = {arcslip::observables::reasons::boundary, 30, 30, "reached the end of the range at 30 N"};
  branch.over = "damper.normal_load";
  branch.parameters = {{"m.value", 1.0}, {"k.value", 100.0}};
  branch.harmonics = {1, 3};
  branch.points = {at(0.1, 1.50, 0.3, 1), at(1, 1.51, 0.04, 20), at(10, 1.62, 0.05, 70),
                   at(30, 1.64, 0.15, 90)};
  branch.events = {{"minimum", false, true, at(4, 1.57, 0.01, 50)}};
  branch.solver = {"dense LU", 4, 4, 1, 20, 18, 9, 30, 0.001};
  return branch;
}

}  // namespace support
