#pragma once
// The difference of two scenes, for messages.

#include <string>

namespace arcslip::ensemble {

/// Returns where two JSON texts first differ, in words: "/elements/0/normal_load was 3 (a number), is 4 (a
/// number)"; "" where they do not.
std::string first_difference(const std::string& before, const std::string& now);

}  // namespace arcslip::ensemble
