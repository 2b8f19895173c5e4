#pragma once
// Time studies: periodic motions by shooting, and transients from rest.

#include <arcslip/analyses/modes_and_time/time_results.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/control/run_control.hpp>

namespace arcslip::observables {

struct TimeSettings {
  double frequency = 0;  // of the excitation, in the scene's unit
  TimeMethod method = TimeMethod::shooting;
  int steps = 1000;            // per period: Newmark's, and those of the history
  int periods = 10'000;        // maximum of a transient, including the recorded ones
  int recorded = 1;            // periods with history, at the end
  double tolerance = 1e-9;     // of the state: change per period in steady state, last shooting correction
  double start_amplitude = 0;  // m: starts from the response of harmonic balance nearest to it; 0: from rest
  double perturbation = 1e-3;  // of such a start, if a transient: relative, along the largest multiplier
  friend bool operator==(const TimeSettings&, const TimeSettings&) = default;
};

/// One motion. If the event-driven integration of a piecewise linear scene ends early, as with more than a
/// million pieces in a period, shooting switches to Newmark's method. It starts from rest, and from harmonic
/// balance if that fails. A transient next to a response has Motion::departure. A motion that ends early is
/// reported with its reason, of reasons::of_motions. Threads may share the scene.
Motion motion_in_time(const scene::Scene& scene, const TimeSettings& settings,
                      const control::Control& control = {});

}  // namespace arcslip::observables
