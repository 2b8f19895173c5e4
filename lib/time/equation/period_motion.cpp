#include <arcslip/time/equation/period_motion.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::time {
namespace {

double largest(const Vector& v) {
  return v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0;
}

double size_of(const MotionState& state, double omega) {
  return std::max({largest(state.x), largest(state.v) / omega, largest(state.z)});
}

}  // namespace

double change_of(const MotionState& from, const MotionState& to, double omega) {
  const double size = std::max(size_of(from, omega), size_of(to, omega));
  const double change = size_of({to.x - from.x, to.v - from.v, to.z - from.z}, omega);
  return size > 0 ? change / size : 0;
}

Transient transient(const Periods& integrate, const MotionState& start, double omega,
                    const TransientOptions& options, const std::function<bool(long, double)>& progress) {
  Transient result;
  result.reason = TransientEnd::period_limit;
  result.start = start;
  const long before = std::max(options.periods - options.recorded, 0L);
  while (result.periods < before) {
    PeriodMotion period = integrate(result.start, 1, false);
    ++result.periods;
    if (!period.done()) {
      result.reason = TransientEnd::failed;
      break;  // and again, to record it
    }
    result.change = change_of(result.start, period.end, omega);
    result.start = std::move(period.end);
    if (options.tolerance > 0 && result.change <= options.tolerance) {
      result.reason = TransientEnd::steady;
      break;
    }
    if (progress && !progress(result.periods, result.change)) {
      result.reason = TransientEnd::user;
      break;
    }
  }
  result.motion = integrate(result.start, result.reason == TransientEnd::failed ? 1 : options.recorded, true);
  if (!result.motion.done()) result.reason = TransientEnd::failed;
  return result;
}

}  // namespace arcslip::time
