#pragma once
// Which peak each of several constraints is about. Not installed.
//
// A constraint keeps its peak while peaks are followed. Of a new response it takes the nearest one, if one is
// near; peaks that are left over go to constraints that have none.

#include <arcslip/optimize/peak_amplitude.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace arcslip::optimize {

class ConstraintPeaks {
 public:
  explicit ConstraintPeaks(std::size_t count = 0) : all_(count) {}

  std::size_t size() const { return all_.size(); }

  /// Of constraint k. responses: how many were traced so far. nullopt: there is none for it.
  std::optional<std::size_t> peak(std::size_t k, const PeakState& state, int responses);

 private:
  struct Constrained {
    double omega = 0;
    std::optional<std::size_t> peak{};
  };

  void assign(const PeakState& state);

  std::vector<Constrained> all_;
  int responses_ = -1;  // when they were given their peaks
};

}  // namespace arcslip::optimize
