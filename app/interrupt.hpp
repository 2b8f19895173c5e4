#pragma once

namespace arcslip::app {

/// Installs the signal handlers: the first Ctrl-C (SIGINT), SIGTERM or SIGHUP requests an end and the second
/// one ends the program; a closed reader of standard output is a write error (EPIPE), not a signal.
void watch_signals();

/// Whether an end was requested.
bool interrupted();

/// Reports a requested end once.
class Interruption {
 public:
  /// True at the first call after the request, then false.
  bool is_new();

 private:
  bool reported_ = false;
};

}  // namespace arcslip::app
