#pragma once
// Responses over any parameter: at a fixed excitation frequency, and the curves of resonance peaks and of
// folds.

#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/observables/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <string>
#include <vector>

namespace arcslip::observables {

/// A parameter `over`, its values, and a frequency in the scene's unit.
struct ParameterRange {
  std::string over;
  double from = 0, to = 0, frequency = 0;
  friend bool operator==(const ParameterRange&, const ParameterRange&) = default;
};

/// A parameter `over`, its values, and a window of frequencies in the scene's unit.
struct CurveRange {
  std::string over;
  double from = 0, to = 0, frequency_from = 0, frequency_to = 0;
  friend bool operator==(const CurveRange&, const CurveRange&) = default;
};

/// The branches over a parameter at one frequency, one for each response found at range.from: where a spring
/// is cubic there may be several. Events: "fold" in that parameter, "maximum" and "minimum" of the amplitude.
/// Throws scene::ParameterError where there is no such parameter or it may not take those values.
std::vector<ResponseBranch> parameter_response(const scene::Scene& scene, const ParameterRange& range,
                                               const ProgressCallback& progress = {});

/// The curves of resonance peaks, dA/ds = 0 along the frequency, over range.over. They are
/// those of the peaks in the frequency window at both ends of the range, at seven values between, and beside
/// each place where a curve ends within the range; each is there once. One that both is born and vanishes
/// between two neighbouring ones of these values, an eighth of the range apart, may be missing. A curve that
/// is there at range.from begins there, another at range.to, another where it is born. It ends at an end of
/// the range, where the peak leaves the window, where it grows without bound ("unbounded"), where it meets a
/// minimum of the amplitude ("fold"), or where it has come back to its beginning ("closed"); where the curve
/// beyond comes to a peak again, that is another branch. Events: "minimum" and "maximum" of the peak
/// amplitude over the parameter, "fold", where the curve turns in it, and "corner", where the peak comes to a
/// corner of the response, at which an element begins to slip, or leaves it. Where a response cannot be
/// followed through the window, a branch without points says so.
std::vector<ResponseBranch> resonance_peaks(const scene::Scene& scene, const CurveRange& range,
                                            const ProgressCallback& progress = {});

/// The curves of folds in frequency over range.over, found in the same way; one curve goes
/// through two folds where these meet in a cusp. Events: "cusp", "fold", where the curve turns in the
/// parameter, "turn", where it turns in the frequency (folds in the parameter at fixed frequency begin or end
/// there), and "corner" as on peaks.
std::vector<ResponseBranch> fold_curves(const scene::Scene& scene, const CurveRange& range,
                                        const ProgressCallback& progress = {});

}  // namespace arcslip::observables
