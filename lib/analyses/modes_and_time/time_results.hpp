#pragma once
// Results of time studies: a motion and its observables, as plain data.

#include <arcslip/results/response.hpp>
#include <arcslip/time/equation/time_history.hpp>

#include <complex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::observables {

/// Method of a time study: shooting, event-driven if the scene is piecewise linear (no smooth law, no
/// massless degree of freedom) and otherwise by Newmark's method, or always by Newmark's method; or a
/// transient from rest, by Newmark's method or event-driven.
enum class TimeMethod { shooting, newmark_shooting, newmark, event_driven };

/// "newmark-shooting", as in a scene file.
std::string_view name(TimeMethod method);

/// Observables of one friction element, or of a patch, over the recorded periods.
struct ElementMotion {
  std::string name;
  double stick_percent = 0;  // share of the time in stick, 0 to 100
  double energy = 0;         // dissipated per period, J
  bool has_normal_load = false;
  double open_percent = 0;                          // share of the time in separation
  double normal_load_max = 0, normal_load_min = 0;  // N; of a patch, of its total at the instants recorded
  double wear_rate = no_value;                      // m^3/s; no_value without a wear coefficient
  ContactExtremes extremes{};                       // of a patch
};

/// What became of a transient that began next to a response of harmonic balance (perturbed_transient.hpp).
struct MotionDeparture {
  double response_amplitude = 0;         // m
  int unstable = 0;                      // multipliers of the response outside the unit circle
  double largest_multiplier = no_value;  // of them, modulus; no_value: not known
  double multiplier_error = no_value;    // estimated
  double growth = 0;                     // of the disturbance in a period, measured
  double distance = 0;                   // of the end from the exact motion at the start, relative
  bool returned = false;                 // to that motion
  int motion_period = 0;                 // of the end, in periods of the motion at the start; 0: not settled
};

/// complete: a steady motion within the tolerance, or, if that is 0, the requested number of periods.
/// stopped: at the period limit before it was steady, or by the user. failed: no periodic motion was found,
/// or the integration failed; the history is the part computed.
struct Motion {
  std::string study, kind;  // name and kind of its study; may be empty
  Status status = Status::complete;
  Stop stop;
  std::vector<std::pair<std::string, double>> set;         // set by for_each
  std::vector<std::pair<std::string, double>> parameters;  // every other parameter, by its name
  TimeMethod method = TimeMethod::shooting;
  std::string integrator;  // "newmark" or "event-driven"
  double omega = 0;        // of the excitation, rad/s
  int steps = 0;           // per period
  long periods = 0;        // integrated, including the recorded ones
  double change = 0;       // of the state, relative: over the last period, or the last shooting correction
  double amplitude = 0;    // max |x| of the response over the recorded periods, m
  time::EnergyBalance energy;  // per period, the mean of those recorded, J
  std::vector<ElementMotion> elements;
  std::vector<ElementMotion> patches;             // their totals
  std::vector<std::complex<double>> multipliers;  // Floquet, by decreasing modulus; with shooting
  std::optional<bool> stable;                     // all of them within the unit circle
  std::optional<MotionDeparture> departure;       // with TimeSettings::start_amplitude
  time::TimeHistory history;                      // of the recorded periods; t = 0 at their start
  double seconds = 0;                             // computing time
};

}  // namespace arcslip::observables
