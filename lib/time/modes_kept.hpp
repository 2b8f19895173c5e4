#pragma once

#include <limits>

namespace arcslip::time {

/// Which natural modes of the structure without contacts have inertia: of the lowest `most` those up to a
/// natural frequency, rad/s, and the first ten in any case.
struct ModesKept {
  double highest = std::numeric_limits<double>::infinity();
  int most = std::numeric_limits<int>::max();
};

}  // namespace arcslip::time
