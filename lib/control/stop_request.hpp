#pragma once

#include <functional>
#include <stdexcept>

namespace arcslip::scene {

/// Called about every tenth of a second in longer operations: true ends them. May be empty.
using StopRequest = std::function<bool()>;

inline bool is_asked(const StopRequest& stop) {
  return stop && stop();
}

/// An operation ended by a StopRequest without a result. what() says what was not done.
class Interrupted : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace arcslip::scene
