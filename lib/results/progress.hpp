#pragma once
// What a computation tells while it goes on.

#include <functional>
#include <limits>

namespace arcslip::results {

/// Progress of one branch, motion or search; told after every accepted point, and again in between while
/// steps are rejected or a response to start from is sought, so that it can be stopped there.
struct Progress {
  int branch = 0, branches = 0;                            // which of how many
  long points = 0;                                         // accepted so far on this branch
  double frequency = 0;                                    // in the scene's unit
  double step = 0;                                         // last step in frequency, in the scene's unit
  double share_done = 0;                                   // 0 to 1, of this branch; NaN: nobody knows
  const char *item = "branch", *counted = "points";        // in words for people
  const char* phase = "";                                  // of a search: what is done; else nothing
  double best = std::numeric_limits<double>::quiet_NaN();  // of a search: the least amplitude so far, m
};

/// Returns false to stop: what is under way then ends with reasons::user.
using ProgressCallback = std::function<bool(const Progress&)>;

}  // namespace arcslip::results
