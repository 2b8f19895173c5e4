#include <arcslip/optimize/constraint_peaks.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::optimize {
namespace {

constexpr double same_peak = 0.03;  // relative change of the frequency between responses

}  // namespace

std::optional<std::size_t> ConstraintPeaks::peak(std::size_t k, const PeakState& state, int responses) {
  if (responses_ != responses) {
    responses_ = responses;
    assign(state);
  }
  Constrained& here = all_[k];
  if (here.peak) here.omega = state.peaks[*here.peak].omega();
  return here.peak;
}

void ConstraintPeaks::assign(const PeakState& state) {
  std::vector<bool> taken(state.peaks.size(), false);
  for (Constrained& each : all_) {
    each.peak.reset();
    double nearest = same_peak * each.omega;
    for (std::size_t i = 0; i < state.peaks.size(); ++i)
      if (!taken[i] && std::abs(state.peaks[i].omega() - each.omega) < nearest) {
        nearest = std::abs(state.peaks[i].omega() - each.omega);
        each.peak = i;
      }
    if (each.peak) taken[*each.peak] = true;
  }
  for (std::size_t i = 0; i < state.peaks.size(); ++i) {
    const auto free =
        std::find_if(all_.begin(), all_.end(), [](const Constrained& each) { return !each.peak; });
    if (taken[i] || free == all_.end()) continue;
    free->peak = i;
    free->omega = state.peaks[i].omega();
  }
}

}  // namespace arcslip::optimize
