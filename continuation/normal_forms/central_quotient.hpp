#pragma once
// Central quotients of second order for derivatives up to the fourth, sum of weight g(distance h) / h^order.
// Not installed.

#include <array>
#include <cstddef>

namespace arcslip::continuation {

struct CentralQuotient {
  std::array<double, 5> distance, weight;
  std::size_t places;
};

constexpr CentralQuotient central_quotient(int order) {
  if (order == 1) return {{1, -1}, {0.5, -0.5}, 2};
  if (order == 2) return {{1, 0, -1}, {1, -2, 1}, 3};
  if (order == 3) return {{2, 1, -1, -2}, {0.5, -1, 1, -0.5}, 4};
  return {{2, 1, 0, -1, -2}, {1, -4, 6, -4, 1}, 5};
}

}  // namespace arcslip::continuation
