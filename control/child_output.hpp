#pragma once
// What another program writes on its standard output. Nothing that it does is trusted.

#include <arcslip/control/run_control.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace arcslip::control {

class ChildOutput {
 public:
  struct Command {
    std::string program;  // without a slash: of PATH
    std::vector<std::string> arguments{};
    std::optional<std::vector<std::string>> environment{};  // none: ours
    std::string folder{};                                   // "": the current one
    bool with_errors = false;                               // its standard error is read, too; else discarded
  };
  struct Limits {
    std::chrono::milliseconds time;
    Control control{};
  };
  /// How it came that the output ends.
  enum class End { not_yet, by_itself, by_signal, out_of_time, stopped };

  /// Starts a program, without a shell and with nothing on its standard input. Throws std::system_error where
  /// it cannot be started.
  ChildOutput(const Command& command, Limits limits);
  ChildOutput(const ChildOutput&) = delete;
  ChildOutput& operator=(const ChildOutput&) = delete;
  /// Kills it, where it has not ended, and what it started.
  ~ChildOutput();

  /// Appends what there is, after waiting for it. False where the output ends.
  bool read_some(std::string& text);
  /// Reads so many bytes. False where the output ends before: then end() says why.
  bool read(void* to, std::size_t bytes);
  /// Reads a line, without its end. Nothing where the output ends before, or within so many characters.
  std::optional<std::string> line(std::size_t longest);
  /// Waits for its end. True if it ends by itself, with exit code 0, and has written no more than was read.
  bool ends_well();

  End end() const { return end_; }
  /// The signal that ended it, 0 for none.
  int signal() const { return signal_; }
  /// Its exit code, -1 where a signal ended it.
  int exit_code() const { return exit_code_; }

 private:
  bool fill();
  bool keeps_going();
  bool has_exited();
  int kill_all();
  void wait_for_end();
  void take_status(int status);

  Limits limits_;
  std::chrono::steady_clock::time_point began_, asked_;
  int pipe_ = -1;
  pid_t child_ = -1;  // -1: has ended, and been waited for
  End end_ = End::not_yet;
  int signal_ = 0, exit_code_ = -1;
  std::array<char, 1 << 16> buffer_;
  std::size_t first_ = 0, last_ = 0;  // what of the buffer has not been read
};

}  // namespace arcslip::control
