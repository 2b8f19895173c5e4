#pragma once
// The kinds of events of branches and curves, each defined once and listed in docs/results.md.

#include <arcslip/results/event_kind.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace arcslip::observables::event_kinds {

using results::EventKind;
using results::Shape;

inline constexpr EventKind peak{
    "peak",
    "resonance peak",
    {Shape::filled_circle, 0.8},
    "a maximum of the amplitude over the frequency; of modes, at an amplitude whose true peak was looked for",
    "frequency responses, modes"};
inline constexpr EventKind fold{
    "fold",
    "fold",
    {.shape = Shape::square, .size = 1.5, .line_width = 1.5, .labelled = false},
    "the branch or curve turns in the frequency, or in the parameter that it is over",
    "responses, curves, modes"};
inline constexpr EventKind maximum{
    "maximum",
    "maximum",
    {Shape::filled_triangle},
    "of the amplitude over the parameter, of modes the damping ratio over the amplitude",
    "responses over a parameter, curves of peaks, curves of optima, modes"};
inline constexpr EventKind minimum{"minimum",
                                   "minimum",
                                   {Shape::filled_inverted_triangle},
                                   "likewise",
                                   "responses over a parameter, curves of peaks, curves of optima, modes"};
inline constexpr EventKind cusp{
    "cusp", "cusp", {Shape::filled_diamond, 1.1}, "two folds meet and vanish", "curves of folds"};
inline constexpr EventKind turn{"turn",
                                "turn",
                                {Shape::filled_square, 0.7},
                                "the curve turns in the frequency",
                                "curves of folds and of other bifurcations"};

// Where the motion loses its stability, or regains it (stability/stability.hpp).
inline constexpr EventKind period_doubling{"period_doubling",
                                           "period doubling",
                                           {Shape::triangle, 1, 1.5},
                                           "a multiplier is -1: motions of twice the period begin or end",
                                           "responses with stability, curves of bifurcations"};
inline constexpr EventKind neimark_sacker{
    "neimark_sacker",
    "Neimark-Sacker point",
    {Shape::circle, 1, 1.5},
    "a pair of multipliers is on the unit circle: motions with a second frequency begin or end",
    "responses with stability, curves of bifurcations"};
inline constexpr EventKind symmetry_breaking{"symmetry_breaking",
                                             "break of symmetry",
                                             {Shape::diamond, 1.1, 1.5},
                                             "motions that are not antisymmetric begin or end at one that is",
                                             "responses with stability, curves of bifurcations"};
inline constexpr EventKind stability_lost{
    "stability_lost",
    "loss of stability",
    {Shape::cross, 0.9, 1.5},
    "multipliers jump across the unit circle, as where a phase of contact begins or ends",
    "responses with stability"};
inline constexpr EventKind branch_point{"branch_point",
                                        "branch point",
                                        {},
                                        "a branch of the same harmonics crosses",
                                        "frequency responses with `\"branches\": \"all\"`"};

inline constexpr EventKind jump{
    "jump", "jump", {Shape::star, 0.9, 1.5}, "the motion leaves one response for another", "sweeps"};

// A pair of multipliers at exp(+- 2 pi i/q), q = 1, 2, 3, 4.
inline constexpr EventKind resonance_1_1{"resonance_1_1",
                                         "resonance 1:1",
                                         {.shape = Shape::filled_pentagon, .size = 0.9, .label = "1:1"},
                                         "the pair of multipliers is 1: the curve ends on one of folds",
                                         "curves of Neimark-Sacker points"};
inline constexpr EventKind resonance_1_2{
    "resonance_1_2",
    "resonance 1:2",
    {.shape = Shape::pentagon, .size = 1, .line_width = 1.5, .label = "1:2"},
    "the pair of multipliers is -1, or, of other bifurcations, a second multiplier is",
    "curves of bifurcations"};
inline constexpr EventKind resonance_1_3{
    "resonance_1_3",
    "resonance 1:3",
    {.shape = Shape::filled_inverted_triangle, .size = 0.9, .label = "1:3"},
    "the pair of multipliers is at exp(±2πi/3)",
    "curves of Neimark-Sacker points"};
inline constexpr EventKind resonance_1_4{
    "resonance_1_4",
    "resonance 1:4",
    {.shape = Shape::plus, .size = 0.9, .line_width = 1.5, .label = "1:4"},
    "the pair of multipliers is at ±i",
    "curves of Neimark-Sacker points"};

inline constexpr EventKind phase_resonance{
    "phase_resonance",
    "phase resonance",
    {},
    "an end of the curve, on which the motion is a quarter of a period behind the force",
    "curves of phase resonances"};
inline constexpr EventKind corner{
    "corner", "corner", {}, "the curve reaches or leaves a grazing point", "curves of peaks and folds"};
inline constexpr EventKind start{
    "start", "start", {}, "where it begins", "modes, branches that leave another one"};
inline constexpr EventKind end{"end", "end", {}, "where it ends", "modes, branches that leave another one"};

/// All of them, in the order of docs/results.md, in which figures have their marks.
inline constexpr std::array all = {peak,
                                   fold,
                                   maximum,
                                   minimum,
                                   cusp,
                                   turn,
                                   period_doubling,
                                   neimark_sacker,
                                   symmetry_breaking,
                                   stability_lost,
                                   branch_point,
                                   jump,
                                   resonance_1_1,
                                   resonance_1_2,
                                   resonance_1_3,
                                   resonance_1_4,
                                   phase_resonance,
                                   corner,
                                   start,
                                   end};

inline constexpr std::array of_stability = {period_doubling, neimark_sacker, symmetry_breaking,
                                            stability_lost};

// One multiplier, or a pair of them, is on the unit circle, or jumps across it.
inline constexpr std::array limits_of_stability = {fold,           branch_point,      period_doubling,
                                                   neimark_sacker, symmetry_breaking, stability_lost};

inline constexpr std::array of_curves = {period_doubling, neimark_sacker, symmetry_breaking};

/// Returns whether a list has a kind of that name.
template <class Kinds>
constexpr bool contains(const Kinds& kinds, std::string_view name) {
  return std::find(kinds.begin(), kinds.end(), name) != kinds.end();
}

/// Returns the kind of that name; for a name that is not listed, one whose words are the name, without a
/// mark.
constexpr EventKind kind_named(std::string_view name) {
  const auto* const known = std::find(all.begin(), all.end(), name);
  return known != all.end() ? *known : EventKind{.name = name, .words = name};
}

/// Returns its words: "period doubling".
inline std::string words_of(std::string_view name) {
  return std::string(kind_named(name).words);
}

}  // namespace arcslip::observables::event_kinds
