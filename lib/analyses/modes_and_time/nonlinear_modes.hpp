#pragma once
// Nonlinear modes (hbm/mode.hpp): the branch of free periodic motions over the amplitude of the response,
// with the extrema of the damping ratio and the folds in the amplitude.

#include <arcslip/control/run_control.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <vector>

namespace arcslip::observables {

/// mode: from 1, by the frequency of the structure at rest. Amplitudes of the response: half the way between
/// its extremes over the period, m; 0 < from < to. true_peaks: at how many amplitudes, from the lowest to the
/// highest in equal ratios, the true peak of the frequency response is found next to that of the mode.
struct ModeRange {
  int mode = 1;
  double from = 0, to = 0;
  int true_peaks = 0;
  friend bool operator==(const ModeRange&, const ModeRange&) = default;
};

/// One branch. One that ends early is reported with its reason. Of its points `amplitude` is the half way
/// above, and there is no phase, estimate of the truncation or part of forces; `energy_input` is the work of
/// the negative damping. Throws std::invalid_argument unless mode >= 1 and 0 < from < to. Threads may share
/// the scene.
std::vector<ResponseBranch> nonlinear_modes(const scene::Scene& scene, const ModeRange& range,
                                            const control::Control& control = {});

}  // namespace arcslip::observables
