#pragma once
// Time and error of the ways to compute one frequency response: harmonic balance of several orders with exact
// integrals of friction, the same with sampled friction, and time integration.
//
// The error is that of the highest peak,
//
//   |A - A_ref|/A_ref
//
// next to the peak by harmonic balance of a higher order with exact integrals, whose own error is determined
// by the order before it. In time, A is the amplitude at the frequency of that peak, by shooting from rest:
// where there are several motions it may be that of another one.

#include <arcslip/analyses/modes_and_time/time_results.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/control/run_control.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::observables {

/// A frequency window in the scene's unit, and the highest order that is tried.
struct AccuracySettings {
  double from = 0, to = 0;
  int order = 55;
  friend bool operator==(const AccuracySettings&, const AccuracySettings&) = default;
};

enum class Way { exact, sampled, newmark, shooting };

/// "exact", "sampled", "newmark", "event-driven".
std::string_view name(Way way);

/// One computation.
struct Trial {
  Way way = Way::exact;
  int order = 0;         // of the harmonics; in time 0
  int samples = 0;       // of a period, of sampled friction; or steps
  double amplitude = 0;  // of the highest peak, m
  double omega = 0;      // rad/s, where it is; in time, where it is by the reference
  double error = 0;
  double estimate = no_value;  // its own, of the harmonics left out, relative; in time none
  bool flagged = false;        // the estimate may be too low
  double seconds = 0;          // the least of three runs or more; in time of one frequency
  long points = 0;             // of the branch; in time 1
  bool best = false;           // no other has less error for a point in less time

  double seconds_per_point() const { return points > 0 ? seconds / static_cast<double>(points) : 0; }
};

/// complete: all computations that were asked for; those that failed are reported in `left_out`.
struct Accuracy {
  std::string study, kind;  // name and kind of its study; may be empty
  Status status = Status::complete;
  Stop stop;
  std::vector<std::pair<std::string, double>> set;         // set by for_each
  std::vector<std::pair<std::string, double>> parameters;  // every other parameter, by its name
  int reference_order = 0;
  double reference_amplitude = 0, reference_omega = 0;  // m, rad/s
  double reference_error = 0;                           // relative
  std::vector<Trial> trials;
  std::vector<std::string> left_out;
};

/// One result. Times are those of this machine, alone if nothing else runs on it.
Accuracy accuracy(const scene::Scene& scene, const AccuracySettings& settings,
                  const control::Control& control = {});

/// The fastest of the trials with at most this error; nullptr: none.
const Trial* fastest(const Accuracy& accuracy, double error);

}  // namespace arcslip::observables
