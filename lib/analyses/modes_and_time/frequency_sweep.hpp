#pragma once
// Slow stepped sweeps of the excitation frequency, as in an experiment: at each frequency the motion goes on
// from the displacements, velocities and slider places that it had, at the same phase of the excitation,
// until it is periodic (time/periodic/steady_state_search.hpp).
//
// Jumps: the amplitude A changes from one frequency to the next by far more than before. The step is then
// halved again and again, towards the half with the larger change: of a smooth A the change falls as the step
// does, at a jump it stays.

#include <arcslip/control/run_control.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::observables {

/// up_down: up, and then down from where that ended.
enum class SweepDirection { up, down, up_down };

/// "up-down", as in a scene file.
std::string_view name(SweepDirection direction);

struct SweepSettings {
  double from = 0, to = 0;  // from < to, in the scene's unit
  int points = 201;         // frequencies, equally spaced; both ends included
  double spacing = 0;       // largest one between them, in the scene's unit; 0: by `points`
  SweepDirection direction = SweepDirection::up_down;
  int periods = 2000;       // of the excitation, at most, at each frequency
  int steps = 1000;         // per period, where Newmark's method is taken
  double tolerance = 1e-9;  // of the state: its change over the period of the motion, relative to its size
  friend bool operator==(const SweepSettings&, const SweepSettings&) = default;
};

/// The motion at one frequency.
struct SweepPoint {
  double omega = 0;      // rad/s
  double amplitude = 0;  // max |x| of the response, m: over the period of the motion; not settled: over the
                         // second half of the periods
  bool settled = false;
  int period = 0;                        // of the motion, in periods of the excitation; 0: not settled
  long periods = 0;                      // until it was settled
  double change = 0;                     // of the state over the period of the motion, relative to its size
  double largest_multiplier = no_value;  // modulus, over the period of the motion; no_value: not known
};

struct SweepJump {
  double omega = 0, omega_after = 0;          // last frequency before, and first one after it, rad/s
  double amplitude = 0, amplitude_after = 0;  // there, m
  std::size_t after = 0;                      // index of the preceding point
  bool by_step = false;  // in smaller steps the motion goes on without a jump: the step itself ends it early
};

/// complete: all frequencies, settled or not. stopped: by the user; failed: a period could not be integrated.
struct FrequencySweep {
  std::string study, kind;  // name and kind of its study; may be empty
  int parent = 0;           // the sweep that it goes on from, counted backwards in the list; 0: from rest
  Status status = Status::complete;
  Stop stop;
  std::vector<std::pair<std::string, double>> set;         // set by for_each
  std::vector<std::pair<std::string, double>> parameters;  // every other parameter, by its name
  SweepDirection direction = SweepDirection::up;           // up or down
  std::string integrator;  // "newmark" or "event-driven"; both, where events became too many
  int steps = 0;           // per period, of Newmark's method
  std::vector<SweepPoint> points;
  std::vector<SweepJump> jumps;
  long periods = 0;    // of all points and jumps
  std::string doubt;   // empty: none
  double seconds = 0;  // computing time
};

/// One sweep, or two for up_down, the first one from rest. Threads may share the scene.
std::vector<FrequencySweep> frequency_sweep(const scene::Scene& scene, const SweepSettings& settings,
                                            const control::Control& control = {});

}  // namespace arcslip::observables
