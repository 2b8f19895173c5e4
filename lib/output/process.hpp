#pragma once

#include <arcslip/control/run_control.hpp>

#include <chrono>
#include <string>
#include <vector>

namespace arcslip::output {

/// How a program ended.
enum class ProcessEnd {
  by_itself,
  not_found,    // no such program in PATH
  not_started,  // the system cannot start it; text says why
  out_of_time,  // killed
  stopped,      // killed on request
};

struct ProcessResult {
  ProcessEnd end = ProcessEnd::by_itself;
  int exit_code = 0;  // of the program; -1 if ended by a signal
  int signal = 0;     // the signal that ended it, 0 for none
  std::string text;   // standard output and standard error
};

/// Limits of a program.
struct ProcessLimits {
  control::Control control{};
  std::chrono::milliseconds time = std::chrono::hours(24 * 365);
};

/// Runs a program from PATH, without a shell, in `folder`, with empty standard input, and waits for it, or
/// kills it and its children at a limit. It runs in its own process group, so that a terminal's Ctrl-C does
/// not reach it.
ProcessResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                          const std::string& folder, const ProcessLimits& limits = {});

}  // namespace arcslip::output
