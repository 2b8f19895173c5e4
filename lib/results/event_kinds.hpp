#pragma once
// The kinds of events of branches and curves: the names of their monitors.

#include <array>

namespace arcslip::observables::event_kinds {

inline constexpr const char* peak = "peak";        // of the amplitude over the frequency
inline constexpr const char* fold = "fold";        // continuation::fold_event
inline constexpr const char* minimum = "minimum";  // of the amplitude over a parameter
inline constexpr const char* maximum = "maximum";
inline constexpr const char* cusp = "cusp";                        // continuation::cusp_event
inline constexpr const char* passage = "passage";                  // of a frequency that is looked for
inline constexpr const char* phase_resonance = "phase_resonance";  // analyses/branches/phase_resonance.hpp
inline constexpr const char* turn = "turn";                        // of a curve of folds in the frequency
inline constexpr const char* start = "start";  // of the branch of a mode, or of one that leaves another
inline constexpr const char* end = "end";
inline constexpr const char* corner = "corner";  // a curve reaches or leaves a corner of the response

// Where the motion loses its stability, or regains it (stability/stability.hpp).
inline constexpr const char* period_doubling = "period_doubling";
inline constexpr const char* neimark_sacker = "neimark_sacker";
inline constexpr const char* symmetry_breaking = "symmetry_breaking";
inline constexpr const char* stability_lost = "stability_lost";
inline constexpr const char* branch_point = "branch_point";  // continuation::branch_point_monitor()
inline constexpr std::array of_stability = {period_doubling, neimark_sacker, symmetry_breaking,
                                            stability_lost};

// One multiplier, or a pair of them, is on the unit circle, or jumps across it.
inline constexpr std::array limits_of_stability = {fold,           branch_point,      period_doubling,
                                                   neimark_sacker, symmetry_breaking, stability_lost};

inline constexpr std::array of_curves = {period_doubling, neimark_sacker, symmetry_breaking};

// On curves of bifurcations: a pair of multipliers at exp(+- 2 pi i/q), q = 1, 2, 3, 4.
inline constexpr const char* resonance_1_1 = "resonance_1_1";
inline constexpr const char* resonance_1_2 = "resonance_1_2";
inline constexpr const char* resonance_1_3 = "resonance_1_3";
inline constexpr const char* resonance_1_4 = "resonance_1_4";

}  // namespace arcslip::observables::event_kinds
