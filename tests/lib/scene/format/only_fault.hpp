#pragma once
// A scene with one fault, which is reported where it stands.

#include "catch.hpp"

#include <arcslip/scene/scene.hpp>

#include <string>

namespace arcslip::scene::test {

/// read() throws SceneError with one fault, at the pointer and with this part in its message.
template <class Read>
void check_only_fault(const Read& read, const std::string& pointer, const std::string& part) {
  try {
    read();
    FAIL("no fault");
  } catch (const SceneError& error) {
    CAPTURE(error.what());
    REQUIRE(error.faults().size() == 1);
    CHECK(error.faults()[0].pointer == pointer);
    CHECK_THAT(error.faults()[0].message, Catch::Contains(part));
  }
}

}  // namespace arcslip::scene::test
