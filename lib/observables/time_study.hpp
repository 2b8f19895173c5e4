#pragma once
// Motions in time: steady ones by shooting, and transients from rest.

#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/observables/motion.hpp>

namespace arcslip::observables {

struct TimeSettings {
  double frequency = 0;  // of the excitation, in the scene's unit
  TimeMethod method = TimeMethod::shooting;
  int steps = 1000;         // per period: Newmark's, and those of the history
  int periods = 10'000;     // a transient has at most, those recorded included
  int recorded = 1;         // periods with history, at the end
  double tolerance = 1e-9;  // of the state: change over a period that is steady, last correction of shooting
  friend bool operator==(const TimeSettings&, const TimeSettings&) = default;
};

/// One motion. Shooting of a piecewise linear scene in which the integration between events ends
/// early, as with more than a million pieces in a period, goes over to Newmark's steps. It begins at rest and
/// goes on from harmonic balance where that leads nowhere. A motion that ends early is kept, with its reason.
/// Reasons: reasons::of_motions.
Motion motion_in_time(const scene::Scene& scene, const TimeSettings& settings,
                      const ProgressCallback& progress = {});

}  // namespace arcslip::observables
