#pragma once
// Frequency responses: the branch of periodic responses over the excitation frequency, with its peaks and
// folds.

#include <arcslip/observables/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <functional>
#include <vector>

namespace arcslip::observables {

/// Progress of one branch; told after every accepted point, and again in between while steps are rejected or
/// a response to start from is sought, so that it can be stopped there.
struct Progress {
  int branch = 0, branches = 0;                      // which of how many
  long points = 0;                                   // accepted so far on this branch
  double frequency = 0;                              // in the scene's unit
  double step = 0;                                   // last step in frequency, in the scene's unit
  double share_done = 0;                             // 0 to 1, of this branch; NaN: nobody knows
  const char *item = "branch", *counted = "points";  // in words for people
  const char* phase = "";                            // of a search: what is done; else nothing
  double best = no_value;                            // of a search: the least amplitude so far, m
};

/// Returns false to stop: the branch then ends with reason "user".
using ProgressCallback = std::function<bool(const Progress&)>;

/// One branch (or several, where an unbounded resonance cuts it) for each combination of the study's for_each
/// lists. A branch that ends early is kept, with its reason; after a stop by the callback no further branch
/// is begun.
std::vector<ResponseBranch> frequency_response(const scene::Scene& scene, const scene::Study& study,
                                               const ProgressCallback& progress = {});

}  // namespace arcslip::observables
