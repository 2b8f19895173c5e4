#pragma once
// Where a motion goes: it is integrated period by period, in periods T of the excitation, until it repeats
// itself after m of them, m = 1, 2, ...
//
// The end of a decay is shortened. From a state X of the motion, Newton's method finds X* = Phi^m(X*) with
// the monodromy matrix M of m periods. X* is taken where the motion is seen to be on its way into it: in the
// norm |d|^2 = d^T P d in which the linear map contracts,
//
//   P = sum_k (M^T)^k M^k/r^(2k),   r^2 = max |mu|,   so that |M d| < r |d|,
//
// the last m periods went from d = X - X* to d' with |d' - M d| < (1 - r) |d|/2: what is not linear is less
// than what is lost, and a smooth map has the less of it the nearer it comes. Which motion is reached is thus
// decided by the integration alone.
//
// Sliders that rest throughout keep the place where the motion left them; X* is the periodic motion with this
// place. An unstable motion is left by a disturbance of 1e-6, as every structure would. Source:
// docs/theory/16-sweeps.md.

#include <arcslip/time/equation/period_map.hpp>
#include <arcslip/time/equation/period_motion.hpp>

#include <complex>
#include <functional>
#include <string>
#include <vector>

namespace arcslip::time {

struct SettleOptions {
  long periods = 2000;      // of the excitation, at most
  int longest = 8;          // the largest m
  double tolerance = 1e-9;  // of the state: its change over m periods, relative to its size
};

enum class SettleEnd {
  settled,       // on a periodic motion that is not unstable
  period_limit,  // periods >= SettleOptions::periods
  failed,        // a period was not integrated: failure
  user,          // the callback said so
};

struct Settled {
  SettleEnd reason = SettleEnd::period_limit;
  int period = 0;        // m; 0: not settled
  long periods = 0;      // integrated until then
  double change = 0;     // of the state over m periods, or over the last one, relative to its size
  double amplitude = 0;  // max |x| over the m periods; not settled: over the second half of all
  MotionState state;     // at the beginning of a period
  std::vector<std::complex<double>> multipliers;  // over m periods, by falling modulus; empty: not found
  results::Reason failure;
  std::string message;
};

/// integrate, flow: over one period of the excitation. omega: rad/s, makes velocities comparable with
/// displacements. progress: periods done, and the last change; false stops.
Settled settle(const Periods& integrate, const Flow& flow, const MotionState& start, double omega,
               const SettleOptions& options, const std::function<bool(long, double)>& progress = {});

/// The map of `count` periods. Sliders that rest in all of them keep their place: RestingSlider::offset is
/// that of the start.
Flow keeping_places(const Flow& flow, int count);

}  // namespace arcslip::time
