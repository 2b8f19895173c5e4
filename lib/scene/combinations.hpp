#pragma once

#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::scene {

/// The parameter values of one combination of the for_each lists.
using Setting = std::vector<std::pair<std::string, double>>;

/// All combinations of the for_each lists, the last list varying fastest, generated on demand; one empty
/// combination if there are no lists. Refers to the lists.
class Combinations {
 public:
  explicit Combinations(const ValueLists& lists) : lists_(lists) {}
  /// Their number, which may exceed any integer.
  double count() const;
  /// Their number, at most the largest int.
  std::size_t size() const;
  Setting operator[](std::size_t index) const;

 private:
  const ValueLists& lists_;
};

/// The default limit of the command.
inline constexpr int usual_combinations = 100'000;

}  // namespace arcslip::scene
