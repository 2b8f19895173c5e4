#pragma once
// How far two lists of multipliers are apart.

#include <algorithm>
#include <complex>
#include <vector>

namespace multiplier_distance {

/// The largest distance of a multiplier of one list from the nearest one of the other; those left out are 0.
inline double distance(const std::vector<std::complex<double>>& some,
                       const std::vector<std::complex<double>>& others) {
  double largest = 0;
  for (const auto& a : some) {
    double nearest = std::abs(a);
    for (const auto& b : others) nearest = std::min(nearest, std::abs(a - b));
    largest = std::max(largest, nearest);
  }
  return largest;
}

/// The larger one of both ways.
inline double difference(const std::vector<std::complex<double>>& a,
                         const std::vector<std::complex<double>>& b) {
  return std::max(distance(a, b), distance(b, a));
}

}  // namespace multiplier_distance
