#pragma once
// Progress reports of a computation.

#include <limits>

namespace arcslip::control {

/// Progress of one branch, motion or search; reported at its beginning and after every accepted point.
struct Progress {
  int branch = 0, branches = 0;                      // index and number
  long points = 0;                                   // accepted so far on this branch
  double frequency = 0;                              // in the scene's unit
  double step = 0;                                   // last step in frequency, in the scene's unit
  double share_done = 0;                             // 0 to 1, of this branch; NaN: unknown
  const char *item = "branch", *counted = "points";  // nouns in messages
  const char* phase = "";                            // of a search: its phase; else empty
  int order = 0;  // of the harmonics, where an accuracy chooses it and another may follow; else 0
  double best = std::numeric_limits<double>::quiet_NaN();  // of a search: the lowest amplitude so far, m
};

}  // namespace arcslip::control
