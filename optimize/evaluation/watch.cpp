#include <arcslip/optimize/evaluation/watch.hpp>

#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/optimize/evaluation/reasons.hpp>

namespace arcslip::optimize {

using continuation::text;
namespace {

constexpr double grace = 0.5;  // s

}  // namespace

bool Watch::go_on() {
  if (stopped()) return false;
  if (ask_ && !ask_()) {
    stop();
  } else if (limit_ > 0 && seconds() >= limit_) {
    reason_ = reasons::time_limit;
    stopped_phase_ = phase_;
    stopped_at_ = seconds();
  }
  return !stopped();
}

bool Watch::go_on_within() {
  return go_on() || seconds() - stopped_at_ < grace;
}

void Watch::stop() {
  if (stopped()) return;
  reason_ = reasons::user;
  stopped_phase_ = phase_;
  stopped_at_ = seconds();
}

observables::Stop Watch::why() const {
  observables::Stop stop;
  stop.reason = reason_;
  if (reason_ == reasons::time_limit) {
    stop.value = stopped_at_;
    stop.limit = limit_;
    stop.message = text("the limit of ", limit_, " s was reached at ", stopped_at_, " s in ", stopped_phase_);
  } else if (stopped()) {
    stop.message = text("interrupted in ", stopped_phase_);
  }
  return stop;
}

double Watch::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
}

}  // namespace arcslip::optimize
