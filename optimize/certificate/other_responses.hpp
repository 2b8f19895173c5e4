#pragma once
// Responses of an optimum on branches that its search does not follow.

#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/peaks/peak_amplitude.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace arcslip::optimize {

/// A response on a branch other than that of the peaks.
struct OtherResponse {
  std::string found_by;             // "sweep downwards", "search at the ends", "deflation"
  double omega = 0, amplitude = 0;  // rad/s, m
  std::size_t in_case = 0;          // of Optimum::cases
};

/// Of one case: the highest response on the branch from the upper end of the window, if the traced branch
/// does not end there; where a law may have several responses, on those through further responses at both
/// ends, as of a window within a hysteresis; and by deflation at the highest peak.
std::vector<OtherResponse> other_responses(const PeakAmplitude& peaks, std::span<const double> design,
                                           const PeakState& optimum, const control::Control& control);

}  // namespace arcslip::optimize
