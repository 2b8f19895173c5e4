#pragma once

#include <functional>
#include <stdexcept>

namespace arcslip::scene {

/// Asked at least every tenth of a second or so of what may take longer: true ends it. Empty: nobody asks.
using StopRequest = std::function<bool()>;

inline bool is_asked(const StopRequest& stop) {
  return stop && stop();
}

/// What a StopRequest ended before it had a result. what() says what was not done.
class Interrupted : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace arcslip::scene
