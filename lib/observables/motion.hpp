#pragma once
// What a study in time gives: a motion and what an engineer reads off it, as plain data.

#include <arcslip/observables/response.hpp>
#include <arcslip/time/motion.hpp>

#include <complex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::observables {

/// How a motion in time is found: by shooting on the period, between exact events where the scene is
/// piecewise linear (no smooth law, no massless degree of freedom) and in Newmark's steps elsewhere, or
/// always in Newmark's steps; or period by period from rest, in Newmark's steps or between exact events.
enum class TimeMethod { shooting, newmark_shooting, newmark, event_driven };

/// "newmark-shooting", as a scene file writes it.
std::string_view name(TimeMethod method);

/// What one friction element does over the recorded periods.
struct ElementMotion {
  std::string name;
  double stick_percent = 0;  // share of the time in stick, 0 to 100
  double energy = 0;         // dissipated per period, J
};

/// complete: a steady motion within the tolerance, or, where that is 0, as many periods as were asked for.
/// stopped: by the limit of periods before it was steady, or by the user. failed: no periodic motion was
/// found, or it could not be integrated; the history holds what there is.
struct Motion {
  std::string study, kind;  // name and kind of the study that asked for it; empty where nobody said so
  Status status = Status::complete;
  Stop stop;
  std::vector<std::pair<std::string, double>> set;         // what for_each gave this motion
  std::vector<std::pair<std::string, double>> parameters;  // every other parameter, by its name
  TimeMethod method = TimeMethod::shooting;
  std::string integrator;  // "newmark" or "event-driven"
  double omega = 0;        // of the excitation, rad/s
  int steps = 0;           // per period
  long periods = 0;        // integrated, those recorded included
  double change = 0;     // relative, of the state: over the last of these, or the last correction of shooting
  double amplitude = 0;  // max |x| of the response over the recorded periods, m
  time::EnergyBalance energy;  // per period, the mean of those recorded, J
  std::vector<ElementMotion> elements;
  std::vector<std::complex<double>>
      multipliers;             // Floquet, by falling modulus; of periodic motions by shooting
  std::optional<bool> stable;  // all of them within the unit circle
  time::History history;       // of the recorded periods; t = 0 at their beginning
  double seconds = 0;          // that it took
};

}  // namespace arcslip::observables
