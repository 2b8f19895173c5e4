#pragma once
// The first mode of a structure as a user has it, with the order by the accuracy.

#include "lib/hbm/scenes.hpp"

#include <arcslip/results/json_writer.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <nlohmann/json.hpp>

#include <sstream>
#include <string>

namespace mode_accuracy {

inline constexpr double wanted = 1e-4;

/// parts: "structure" and "elements" of a scene, with a degree of freedom x. The amplitudes, m, are of x.
inline nlohmann::json first_mode(const std::string& parts, double from, double to) {
  std::ostringstream text;
  text.precision(17);
  text << R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", )" << parts
       << R"(, "excitation": [{"name": "f", "at": "x", "cosine": 1}], "response": {"at": "x"},
    "harmonics": {"accuracy": )"
       << wanted << R"(}, "studies": [{"kind": "modes", "mode": 1, "amplitude": [)" << from << ", " << to
       << "]}]}";
  std::ostringstream json;
  arcslip::results::write_json(json, arcslip::studies::run(scenes::parse(text.str())));
  return nlohmann::json::parse(json.str())["branches"][0];
}

}  // namespace mode_accuracy
