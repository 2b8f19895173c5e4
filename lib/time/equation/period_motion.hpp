#pragma once
// A motion over some periods of the excitation, independent of the integrator, and transients that are
// integrated period by period until they are steady.

#include <arcslip/results/time_reasons.hpp>
#include <arcslip/time/equation/time_history.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::time {

/// One friction element over an interval.
struct FrictionShare {
  double stick_share = 0;             // of the time in which the slider rests, 0 to 1
  double open_share = 0;              // of the time, in separation
  double energy = 0;                  // dissipated, J
  double load_max = 0, load_min = 0;  // of the normal load, N, where Law::has_normal_load()
};

struct PeriodMotion {
  results::Reason failure;  // why the interval was not reached, of time::reasons; none: it was
  std::string message;      // the same in one sentence
  double time = 0;          // s, where it ended
  MotionState end;
  double amplitude = 0;  // max |x| of the response, m
  EnergyBalance energy;
  std::vector<FrictionShare> friction;  // of each friction element, in the order of the elements
  TimeHistory history;                  // empty if not requested; both ends included

  bool done() const { return failure.code.empty(); }
};

/// Integrates over `count` periods from a state that stands at the beginning of one; t = 0 is that of the
/// first.
using Periods = std::function<PeriodMotion(const MotionState& start, long count, bool with_history)>;

/// Between two states, relative to the larger one: of the largest |x|, |v|/omega or |z|.
double change_of(const MotionState& from, const MotionState& to, double omega);

struct TransientOptions {
  long periods = 1000;      // maximum, including the recorded ones
  long recorded = 1;        // with history, at the end, once the motion is steady
  double tolerance = 1e-9;  // steady: change of the state over a period, relative to its size; 0: never
};

enum class TransientEnd {
  steady,        // change <= tolerance
  period_limit,  // periods >= TransientOptions::periods
  failed,        // a period was not integrated: motion.failure
  user,          // the callback said so
};

struct Transient {
  TransientEnd reason = TransientEnd::steady;
  long periods = 0;     // before those recorded
  double change = 0;    // of the state over the last period, relative to its size
  MotionState start;    // of the recorded periods
  PeriodMotion motion;  // the recorded periods
};

/// From a state at t = 0. progress: periods done, and the last change; false stops. omega: rad/s, makes
/// velocities comparable with displacements.
Transient transient(const Periods& integrate, const MotionState& start, double omega,
                    const TransientOptions& options, const std::function<bool(long, double)>& progress = {});

}  // namespace arcslip::time
