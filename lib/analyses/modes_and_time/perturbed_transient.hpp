#pragma once
// A transient that begins next to a periodic motion, slightly disturbed: does it come back, and how fast?
//
// The motion is that of a response of harmonic balance, made exact by shooting: X*, with the monodromy matrix
// M. The start is X* + e |X*| w, with w along the largest multiplier, so that the disturbance d = X - X*
// grows or decays at its rate from the first period on: d_k+1 = mu d_k, or, for a complex pair, d_k+2 = 2
// Re(mu) d_k+1 - |mu|^2 d_k. The rate is measured by least squares over the periods in which |d| lies between
// e/1000 and 10 e.

#include <arcslip/time/periodic/period_integrator.hpp>
#include <arcslip/time/periodic/steady_state_search.hpp>

#include <functional>
#include <optional>
#include <string>

namespace arcslip::observables {

/// Where a disturbed motion went.
struct Departure {
  time::MotionState start;  // disturbed
  time::Settled end;        // what it came to
  double growth = 0;        // of the disturbance in a period, measured: |mu|
  double distance = 0;      // of the end from the periodic motion at the start, relative
  bool returned = false;    // to it
  double amplitude = 0;     // of that motion, m
  std::string failure;      // why there is none: shooting did not find it; empty: it did
};

/// nearby: a state of the response. disturbance: e. tolerance, periods: of settle(). progress: as there.
Departure departure(const Integrator& integrator, const time::MotionState& nearby, double omega,
                    double disturbance, const time::SettleOptions& options,
                    const std::function<bool(long, double)>& progress = {});

/// The largest modulus of mu in d_k+1 = mu d_k, or in d_k+2 = a d_k+1 + b d_k, whichever the columns of d
/// obey; with fewer than three columns the ratio of their sizes. 0 for a single one.
double growth_of(const time::Matrix& d);

}  // namespace arcslip::observables
