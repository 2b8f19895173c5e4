#include <arcslip/time/periodic/period_integrator.hpp>

#include <arcslip/control/run_control.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/time/newmark/newmark_periods.hpp>

#include <algorithm>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

namespace arcslip::observables {

using time::EquationOfMotion;
using time::MotionState;
using time::PeriodMotion;

Integrator in_steps(const EquationOfMotion& equation, const MotionState& start, long steps,
                    const control::Control& control) {
  const auto method = std::make_shared<time::Newmark>(equation, steps);
  Integrator result{"newmark", false, {}, {}, {}};
  std::tie(result.failure, result.message) = time::failure_of(method->begin(start), 0);
  result.start = method->state();
  result.periods = [method, control](const MotionState& from, long count, bool with_history) {
    return time::newmark_periods(*method, from, count, with_history, false, control);
  };
  result.flow = [method](const MotionState& from) { return time::newmark_map(*method, from); };
  return result;
}

namespace {

results::Reason failure_of(time::EndReason reason) {
  switch (reason) {
    case time::EndReason::reached:
      return {};
    case time::EndReason::events:
    case time::EndReason::pieces:
      return reasons::event_limit;
    case time::EndReason::stopped:
      return reasons::user;
    case time::EndReason::not_finite:
      break;
  }
  return reasons::not_finite;
}

PeriodMotion periods_between_events(time::EventDriven& events, const MotionState& start, long count,
                                    long steps, bool with_history) {
  const double period = events.equation().period(), end = static_cast<double>(count) * period;
  std::vector<double> instants;
  for (long k = 0; with_history && k <= count * steps; ++k)
    instants.push_back(std::min(static_cast<double>(k) * (period / static_cast<double>(steps)), end));
  time::EventDrivenMotion motion = events.integrate(start, 0, end, instants);
  PeriodMotion result;
  result.failure = failure_of(motion.reason);
  result.message = motion.message;
  result.time = motion.time;
  result.end = motion.end;
  result.amplitude = motion.amplitude;
  result.energy = motion.energy;
  const double per_time = motion.time > 0 ? 1 / motion.time : 0;
  for (const time::FrictionRecord& record : motion.friction)
    result.friction.push_back({record.stick_time * per_time, record.open_time * per_time, record.energy,
                               record.load_max, record.load_min});
  if (with_history) result.history = std::move(motion.history);
  return result;
}

}  // namespace

Integrator between_events(const EquationOfMotion& equation, const MotionState& start, long steps,
                          const time::EventLimits& limits) {
  const auto events = std::make_shared<time::EventDriven>(equation, limits);
  Integrator result{"event-driven", true, start, {}, {}};
  result.periods = [events, steps](const MotionState& from, long count, bool with_history) {
    return periods_between_events(*events, from, count, steps, with_history);
  };
  result.flow = [events](const MotionState& from) { return events->map(from, events->equation().period()); };
  return result;
}

}  // namespace arcslip::observables
