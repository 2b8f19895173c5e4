#pragma once
// Random numbers that are the same on every machine: the distributions of the standard library differ from
// one to the other, its generators do not.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace test_random {

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  double between(double lower, double upper) {
    return lower + (upper - lower) * std::ldexp(static_cast<double>(bits_() >> 11), -53);
  }
  double logarithmic(double lower, double upper) {
    return std::exp(between(std::log(lower), std::log(upper)));
  }
  int count(int lower, int upper) {
    return lower + static_cast<int>(bits_() % static_cast<std::uint64_t>(upper - lower + 1));
  }
  std::size_t below(std::size_t end) { return static_cast<std::size_t>(bits_() % end); }
  bool one_in(int n) { return count(1, n) == 1; }
  template <class List>
  const auto& of(const List& list) {
    return list[below(std::size(list))];
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace test_random
