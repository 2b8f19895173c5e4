#pragma once

#include "catalogue.hpp"

#include <arcslip/scene/scene.hpp>

#include <sstream>
#include <string>
#include <vector>

namespace arcslip::scene::test {

/// A scene of JSON that may hold any kind of study.
inline Scene read_text(const std::string& text) {
  std::istringstream in(text);
  return read(in, test_catalogue::whole());
}

/// What is wrong with it; none if it can be read.
inline std::vector<Fault> faults_of(const std::string& text) {
  try {
    read_text(text);
  } catch (const SceneError& error) {
    return error.faults();
  }
  return {};
}

}  // namespace arcslip::scene::test
