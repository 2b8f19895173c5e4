#pragma once

#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::scene {

/// The parameter values of one combination.
using Setting = std::vector<std::pair<std::string, double>>;

/// All combinations of lists, the last list varying fastest, or those of their rows, generated on demand; one
/// empty combination if there are no lists. Refers to the lists.
class Combinations {
 public:
  Combinations(const ValueLists& lists, bool in_rows = false) : lists_(lists), in_rows_(in_rows) {}
  /// Those of for_each.
  explicit Combinations(const Study& study) : Combinations(study.for_each, study.in_rows) {}
  /// Their number, which may exceed any integer.
  double count() const;
  /// Their number, at most the largest int.
  std::size_t size() const;
  Setting operator[](std::size_t index) const;

 private:
  const ValueLists& lists_;
  bool in_rows_;
};

/// The default limit of the command.
inline constexpr int usual_combinations = 100'000;

/// Of more, there are no figures, whose data would stay in memory to the end.
inline constexpr int most_drawn = 1000;

}  // namespace arcslip::scene
