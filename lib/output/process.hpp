#pragma once

#include <arcslip/scene/stop_request.hpp>

#include <chrono>
#include <string>
#include <vector>

namespace arcslip::output {

/// How a program came to its end.
enum class ProcessEnd {
  by_itself,
  not_found,    // no such program in PATH
  out_of_time,  // killed
  stopped,      // killed, as asked
};

struct ProcessResult {
  ProcessEnd end = ProcessEnd::by_itself;
  int exit_code = 0;  // of the program; -1 where a signal ended it
  int signal = 0;     // the signal that ended it, 0 for none
  std::string text;   // what it wrote to standard output and standard error
};

/// Until when a program may run.
struct ProcessLimits {
  scene::StopRequest stop{};
  std::chrono::milliseconds time = std::chrono::hours(24 * 365);
};

/// Runs a program found in PATH, without a shell, in `folder`, with nothing on standard input, and waits for
/// its end, or kills it, with all that it started, where a limit says so. It has a process group of its own:
/// a terminal's Ctrl-C is left to us. Throws std::system_error where the system cannot start any program.
ProcessResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                          const std::string& folder, const ProcessLimits& limits = {});

}  // namespace arcslip::output
