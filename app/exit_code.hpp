#pragma once

namespace arcslip::app {

/// Exit codes of the program.
enum class ExitCode {
  done = 0,
  usage_or_file = 1,
  invalid_scene = 2,
  stopped_early = 3,  // partial results are written
  differ = 4,         // compare found differences
};

}  // namespace arcslip::app
