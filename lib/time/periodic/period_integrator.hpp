#pragma once
// One way to integrate one equation of motion over periods: between events, exactly, or in Newmark's steps.

#include <arcslip/control/run_control.hpp>
#include <arcslip/results/reason.hpp>
#include <arcslip/time/equation/period_motion.hpp>
#include <arcslip/time/event_driven/event_driven.hpp>
#include <arcslip/time/periodic/steady_state_search.hpp>

#include <string>

namespace arcslip::observables {

struct Integrator {
  std::string name;             // "newmark" or "event-driven"
  bool between_events = false;  // else in steps
  time::MotionState start;      // as it takes it: massless motions in their place
  results::Reason failure;      // why it cannot begin; none: it can
  std::string message;
  time::Periods periods{};
  time::Flow flow{};
};

/// steps: per period, those of the method and of the history. control: asked now and then; its end is that of
/// a period with the reason user.
Integrator in_steps(const time::EquationOfMotion& equation, const time::MotionState& start, long steps,
                    const control::Control& control);

/// steps: per period, of the history. Throws time::NotPiecewiseLinear, time::SingularMass.
Integrator between_events(const time::EquationOfMotion& equation, const time::MotionState& start, long steps,
                          const time::EventLimits& limits);

/// Of a period: beyond, Newmark's method takes less time.
inline constexpr long affordable_events = 100'000, affordable_pieces = 1'000'000;

}  // namespace arcslip::observables
