#pragma once

#include <arcslip/sampling/sampler.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::scene {

/// The parameter values of one combination.
using Setting = std::vector<std::pair<std::string, double>>;

/// All combinations of lists, the last list varying fastest, those of their rows, or samples, generated on
/// demand; one empty combination if there are no lists. Refers to the lists. Threads may share it.
class Combinations {
 public:
  Combinations(const ValueLists& lists, bool in_rows = false) : lists_(lists), in_rows_(in_rows) {}
  /// Those of for_each.
  explicit Combinations(const Study& study);
  /// Their number, which may exceed any integer.
  double count() const;
  /// Their number, at most the largest int.
  std::size_t size() const;
  Setting operator[](std::size_t index) const;

 private:
  const ValueLists& lists_;
  bool in_rows_;
  const sampling::Plan* plan_ = nullptr;  // null: there are lists
  std::optional<sampling::Sampler> sampler_{};
};

/// The parameters of for_each, in their order.
std::vector<std::string> varied_parameters(const Study& study);

/// The default limit of the command.
inline constexpr int usual_combinations = 100'000;

/// Of more, there are no figures, whose data would stay in memory to the end.
inline constexpr int most_drawn = 2500;

}  // namespace arcslip::scene
