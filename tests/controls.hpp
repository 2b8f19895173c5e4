#pragma once
// Controls that end where a test says so.

#include <arcslip/control/run_control.hpp>

#include <chrono>
#include <functional>
#include <utility>

namespace controls {

/// Asked each time, in this thread: false ends it.
inline arcslip::control::Control polled(std::function<bool()> poll) {
  return arcslip::control::Control({.poll = std::move(poll), .poll_every = std::chrono::milliseconds(0)});
}

/// Stopped at the first report for which go is false.
template <class Go>
arcslip::control::Control reporting(Go go, const arcslip::control::Control& parent = {}) {
  const auto control = parent.child();
  return control.child({.report = [control, go](const arcslip::control::Progress& now) mutable {
    if (!go(now)) control.stop();
  }});
}

inline arcslip::control::Control stopped() {
  const arcslip::control::Control control{arcslip::control::Sources()};
  control.stop();
  return control;
}

}  // namespace controls
