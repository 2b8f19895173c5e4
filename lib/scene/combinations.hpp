#pragma once

#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::scene {

/// The values that one combination of the for_each lists gives to parameters.
using Setting = std::vector<std::pair<std::string, double>>;

/// All combinations of the for_each lists, the last one fastest, each made when it is asked for; one empty
/// setting where there are none. Refers to the lists.
class Combinations {
 public:
  explicit Combinations(const ValueLists& lists) : lists_(lists) {}
  /// How many there are, which may be more than any integer.
  double count() const;
  /// No more than an int can count.
  std::size_t size() const;
  Setting operator[](std::size_t index) const;

 private:
  const ValueLists& lists_;
};

/// What the command runs without being told to.
inline constexpr int usual_combinations = 100'000;

}  // namespace arcslip::scene
