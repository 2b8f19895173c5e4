#pragma once

#include <limits>

namespace arcslip::time {

/// Which natural modes of the structure without contacts have inertia: the first ten, and up to `most` of
/// those up to a natural frequency, rad/s.
struct ModesKept {
  double highest = std::numeric_limits<double>::infinity();
  int most = std::numeric_limits<int>::max();
};

}  // namespace arcslip::time
