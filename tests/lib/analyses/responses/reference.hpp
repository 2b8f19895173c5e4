#pragma once

#include "environment.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace reference {

inline nlohmann::json read(const std::string& file) {
  std::ifstream in(source_folder() + "/tests/reference/" + file);
  return nlohmann::json::parse(in);
}

inline nlohmann::json exact(const std::string& list) {
  return read("exact_1dof.json")[list];
}

inline double error(double value, double exact) {
  return std::abs(value / exact - 1);
}

}  // namespace reference
