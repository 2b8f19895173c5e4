#pragma once
// Curves over any parameter: of resonance peaks, of folds, and of other bifurcations.

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/stability/stability_request.hpp>

#include <string>
#include <vector>

namespace arcslip::observables {

/// Which resonance a curve of peaks is of: the largest amplitude, or phase resonance
/// (analyses/branches/phase_resonance.hpp).
enum class Resonance { amplitude, phase };

/// A parameter `over`, its range, and a frequency window in the scene's unit. resonance: of peaks.
struct CurveRange {
  std::string over;
  double from = 0, to = 0, frequency_from = 0, frequency_to = 0;
  StabilityRequest stability{};  // of the points
  Resonance resonance = Resonance::amplitude;
  friend bool operator==(const CurveRange&, const CurveRange&) = default;
};

/// Kinds of bifurcations; `all`: each that the motion may have.
enum class BifurcationsOf { all, period_doubling, neimark_sacker, symmetry_breaking };

/// A parameter `over`, its range, and a frequency window in the scene's unit. branches: on which of the
/// responses bifurcations are looked for; limits: of all branches.
struct BifurcationRange {
  BifurcationsOf of = BifurcationsOf::all;
  std::string over;
  double from = 0, to = 0, frequency_from = 0, frequency_to = 0;
  Branches branches = Branches::one;
  BranchLimits limits{};
  friend bool operator==(const BifurcationRange&, const BifurcationRange&) = default;
};

/// The curves of resonance peaks, dA/ds = 0 along the frequency, over range.over. They are started from the
/// peaks in the frequency window at both ends of the range, at seven values in between, and next to each end
/// of a curve within the range; each curve is reported once. A curve that appears and vanishes between two
/// neighbouring values, an eighth of the range apart, may be missed. A curve starts at range.from if it
/// exists there, otherwise at range.to or where it appears. It ends at an end of the range, where the peak
/// leaves the window, where it grows without bound ("unbounded"), where it meets a minimum of the amplitude
/// ("fold"), or where it returns to its start ("closed"); if the curve beyond reaches a peak again, that is
/// another branch. Events: "minimum" and "maximum" of the peak amplitude over the parameter, "fold", where
/// the curve turns in it, and "corner", where the peak reaches or leaves a grazing point, at which
/// an element starts to slip. If a response cannot be continued through the window, a branch without points
/// reports it.
std::vector<ResponseBranch> resonance_peaks(const scene::Scene& scene, const CurveRange& range,
                                            const control::Control& control = {});

/// Those of high peaks: a peak below this share of the highest one of its response starts no curve.
std::vector<ResponseBranch> high_resonance_peaks(const scene::Scene& scene, const CurveRange& range,
                                                 double share, const control::Control& control = {});

/// The curves of folds in frequency over range.over, found in the same way; two folds that meet in a cusp are
/// on one curve. Events: "cusp", "fold", where the curve turns in the parameter, "turn", where it turns in
/// the frequency (folds in the parameter at fixed frequency start or end there), and "corner" as for peaks.
std::vector<ResponseBranch> fold_curves(const scene::Scene& scene, const CurveRange& range,
                                        const control::Control& control = {});

/// The curves of bifurcations of the frequency response over range.over (bifurcation_curve.hpp), found in the
/// same way, or of all branches at each of these values: motions that are antisymmetric double no period, but
/// those that leave them at a break of symmetry may. With the stability of their points: `unstable` counts
/// the multipliers other than those of the bifurcation. A branch is `of` one kind; its first and its last
/// event have that kind. Other events: "fold", where the curve turns in the parameter, so that two
/// bifurcations of the frequency response meet; "turn", where it turns in the frequency; resonances
/// "resonance_1_1" to "resonance_1_4" of Neimark-Sacker points, and "resonance_1_2" of others, where a second
/// multiplier is -1. A curve of Neimark-Sacker points ends at resonances 1:1 and 1:2 ("resonance"), and any
/// where multipliers jump across the bifurcation ("jump").
std::vector<ResponseBranch> bifurcation_curves(const scene::Scene& scene, const BifurcationRange& range,
                                               const control::Control& control = {});

}  // namespace arcslip::observables
