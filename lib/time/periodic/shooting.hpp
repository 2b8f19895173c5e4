#pragma once
// Periodic motions by shooting: X = Phi(X) for the state X = (x, x', z) after one period (or several), by
// Newton's method with the monodromy matrix M = dPhi/dX:
//
//   (I - M) dX = Phi(X) - X
//
// A slider that sticks throughout gives z = z, a row of zeros, which is replaced by the condition of its
// offset (RestingSlider). Phi is piecewise smooth: a step is halved until the defect decreases, and
// if no step does, the motion is integrated for some periods, a contraction due to friction and damping,
// before Newton's method is tried again. That fails near resonances without viscous damping, where a start
// from harmonic balance (stability/state_from_harmonics.hpp) still converges in a few steps.
//
// Floquet multipliers: the eigenvalues of M without the sliders that stick throughout, each of which would
// add a multiplier 1. In general as many are zero as sliders slip simultaneously at some instant. Source:
// docs/theory/09-event-driven.md.

#include <arcslip/time/equation/period_map.hpp>
#include <arcslip/time/event_driven/event_driven.hpp>

#include <complex>

namespace arcslip::time {

struct ShootingOptions {
  int periods = 1;          // of the excitation, in one period of the motion
  int transients = 3;       // periods of the motion before the first step of Newton's method
  int iterations = 50;      // Newton steps and integrations of the motion
  double tolerance = 1e-9;  // of the last correction, relative; the error is about its square
};

enum class ShootingEnd {
  converged,    // last correction <= tolerance, or defect at rounding
  iterations,   // their number >= ShootingOptions::iterations
  flow_failed,  // the integration over a period ended early
  not_finite,   // the correction is not finite
};

struct ShootingResult {
  ShootingEnd reason = ShootingEnd::converged;
  std::string message;
  MotionState start;                              // on the periodic motion, t = 0
  double correction = 0;                          // the last one, relative to the state
  double defect = 0;                              // |Phi(X) - X| before it, relative to the state
  int iterations = 0;                             // Newton steps
  int maps = 0;                                   // periods integrated
  PeriodMap map;                                  // the last one
  std::vector<std::complex<double>> multipliers;  // by falling modulus
  bool stable = false;  // all multipliers within the unit circle, by more than 1e-10

  bool converged() const { return reason == ShootingEnd::converged; }
};

/// omega: rad/s, makes velocities comparable with displacements.
ShootingResult shoot(const Flow& flow, const MotionState& start, double omega,
                     const ShootingOptions& options = {});

/// A periodic motion of a structure with friction, exact.
struct PeriodicMotion {
  ShootingResult shooting;
  EventDrivenMotion period;  // from shooting.start over one period of the motion: events, energies, amplitude

  bool converged() const { return shooting.converged(); }
};

/// By event-driven integration. instants: ascending, s, in [0, periods 2 pi/omega], for the history.
PeriodicMotion periodic_motion(EventDriven& integrator, const MotionState& start,
                               const ShootingOptions& options = {}, std::span<const double> instants = {});

}  // namespace arcslip::time
