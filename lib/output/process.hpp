#pragma once

#include <string>
#include <vector>

namespace arcslip::output {

struct ProcessResult {
  bool found = true;  // false: no such program in PATH
  int exit_code = 0;  // of the program; -1 where a signal ended it
  int signal = 0;     // the signal that ended it, 0 for none
  std::string text;   // what it wrote to standard output and standard error
};

/// Runs a program found in PATH, without a shell, in `folder`, with nothing on standard input, and waits for
/// its end. Throws std::system_error where the system cannot start any program.
ProcessResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                          const std::string& folder);

}  // namespace arcslip::output
