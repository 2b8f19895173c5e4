#pragma once

namespace arcslip::app {

/// From here on the first Ctrl-C (SIGINT) or SIGTERM asks for an end and the second one ends the program; a
/// reader of standard output who goes away is an error of writing (EPIPE), not a signal.
void watch_signals();

/// Whether an end was asked for.
bool interrupted();

/// That an end was asked for is told once.
class Interruption {
 public:
  /// True once, when it was asked for.
  bool is_new();

 private:
  bool told_ = false;
};

}  // namespace arcslip::app
