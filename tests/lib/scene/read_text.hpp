#pragma once

#include "catalogue.hpp"

#include <arcslip/scene/scene.hpp>

#include <sstream>
#include <string>

namespace arcslip::scene::test {

/// A scene of JSON that may hold any kind of study.
inline Scene read_text(const std::string& text) {
  std::istringstream in(text);
  return read(in, test_catalogue::whole());
}

}  // namespace arcslip::scene::test
