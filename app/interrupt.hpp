#pragma once

#include <arcslip/control/run_control.hpp>

namespace arcslip::app {

/// Installs the signal handlers: the first Ctrl-C (SIGINT), SIGTERM or SIGHUP requests an end and the second
/// one ends the program; a closed reader of standard output is a write error (EPIPE), not a signal.
void watch_signals();

/// Ends when an end was requested. What cannot be interrupted is left behind, and leave() ends the program.
const control::Control& by_signal();

/// Whether an end was requested.
bool interrupted();

/// Ends the program, without taking down libraries under a computation that was left behind.
[[noreturn]] void leave(int code);

/// Reports a requested end once.
class Interruption {
 public:
  /// True at the first call after the request, then false.
  bool is_new();

 private:
  bool reported_ = false;
};

}  // namespace arcslip::app
