#pragma once
// Where resonances lie: the natural frequencies around a window of the excitation frequency.

#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/observables/unresolved_resonances.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <string>
#include <vector>

namespace arcslip::observables {

/// Natural frequencies of the structure at rest over the lowest harmonic of the excitation, rad/s, in
/// increasing order: about there a small motion is in resonance. Empty where they are not known
/// (modes_at_rest()), and `stuck` where there are no contacts.
struct Resonances {
  std::vector<ModeAtRest> free, stuck;  // of all contacts
  int harmonic = 1;
};

Resonances resonances(const model::Model& model, const continuation::Vector& p, int most_dofs = few_dofs);

/// The lowest ones, at most so many of them, as a sentence: "natural frequencies with all contacts
/// free: 16.71 and 104.72 Hz; stuck: 17.254 and 105.11 Hz". Empty where they are not known.
std::string text_of(const Resonances& all, scene::FrequencyUnit unit, int most = 4);

/// Those in the window and the nearest ones on both sides: "natural frequencies with all contacts free: 16.71
/// Hz below, 104.72 Hz above; stuck: 17.254 Hz below, 105.11 Hz above". Where all are far below, and would
/// not be if mass and stiffness were taken for each other, a question about that.
std::string text_of(const Resonances& all, const FrequencyWindow& window, scene::FrequencyUnit unit);

/// A question, where all frequencies are far below a window, and would not be if mass and stiffness were
/// taken for each other: "are mass and stiffness taken for each other? ..."; else "".
std::string question_of_swapped(const std::vector<ModeAtRest>& modes, const FrequencyWindow& window,
                                scene::FrequencyUnit unit);

/// Where all branches over the window are complete and none has a peak, the first one says so, and where
/// resonances lie.
void tell_missing_peak(const model::Model& model, const FrequencyWindow& window, scene::FrequencyUnit unit,
                       std::vector<ResponseBranch>& branches);

}  // namespace arcslip::observables
