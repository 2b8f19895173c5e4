#pragma once

#include "volume.hpp"

namespace app_test {

/// Kills of each of three commands that write to a folder.
inline constexpr Volume kills{"ARCSLIP_KILLS", 4, 70};

}  // namespace app_test
