#include <arcslip/control/run_control.hpp>

#include <cstdint>
#include <mutex>
#include <thread>
#include <utility>

namespace arcslip::control {
namespace {

std::int64_t nanoseconds() {
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double seconds_between(std::int64_t from, std::int64_t to) {
  return 1e-9 * static_cast<double>(to - from);
}

// What ended a control, and when: one number, so that a signal handler can write it.
struct Mark {
  enum By { nothing, user, deadline, parent };
  By by = nothing;
  std::int64_t at = 0;

  std::int64_t number() const { return 4 * at + by; }
  static Mark from(std::int64_t number) { return {static_cast<By>(number % 4), number / 4}; }
};

}  // namespace

struct Control::State {
  Sources sources;
  std::shared_ptr<State> parent;
  const std::int64_t began = nanoseconds();
  const std::thread::id thread = std::this_thread::get_id();
  std::int64_t polled = 0;  // in that thread
  std::atomic<std::int64_t> mark = 0;
  std::mutex reporting;

  static_assert(std::atomic<std::int64_t>::is_always_lock_free);

  Mark ended() const { return Mark::from(mark.load()); }

  void end(Mark::By by) {
    std::int64_t none = 0;
    mark.compare_exchange_strong(none, Mark{by, nanoseconds()}.number());
  }

  bool is_over() {
    if (sources.only_while && !*sources.only_while) return false;
    if (ended().by != Mark::nothing) return true;
    if (const Mark::By by = ask(); by != Mark::nothing) end(by);
    return ended().by != Mark::nothing;
  }

  Mark::By ask() {
    if (parent && parent->is_over() &&
        (sources.grace == 0 || seconds_between(parent->ended().at, nanoseconds()) >= sources.grace))
      return Mark::parent;
    if ((sources.flag && sources.flag->load()) || sources.token.stop_requested()) return Mark::user;
    if (sources.seconds > 0 && seconds_between(began, nanoseconds()) >= sources.seconds)
      return Mark::deadline;
    return sources.poll && !poll() ? Mark::user : Mark::nothing;
  }

  bool poll() {
    if (std::this_thread::get_id() != thread) return true;
    const std::int64_t now = nanoseconds();
    if (polled > 0 && now - polled < std::chrono::nanoseconds(sources.poll_every).count()) return true;
    polled = now;
    return sources.poll();
  }
};

Control::Control(Sources sources) : Control(std::make_shared<State>(std::move(sources))) {}

Control Control::child(Sources sources) const {
  return Control(std::make_shared<State>(std::move(sources), state_));
}

Control Control::until(double seconds) const {
  return seconds > 0 ? child({.seconds = seconds}) : *this;
}

Control Control::quiet() const {
  return child({.report = [](const Progress&) {}});
}

bool Control::keep_going() const {
  return !state_ || !state_->is_over();
}

Ending Control::ending() const {
  const State* state = state_.get();
  if (!state) return {};
  while (state->ended().by == Mark::parent) state = state->parent.get();
  const Mark mark = state->ended();
  if (mark.by == Mark::deadline)
    return {EndReason::deadline, seconds_between(state->began, mark.at), state->sources.seconds};
  return {mark.by == Mark::user ? EndReason::user : EndReason::none};
}

void Control::stop() const {
  if (state_) state_->end(Mark::user);
}

void Control::report(const Progress& now) const {
  State* state = state_.get();
  while (state && !state->sources.report) state = state->parent.get();
  if (!state) return;
  const std::lock_guard alone(state->reporting);
  state->sources.report(now);
}

AbandonedThreads* Control::abandoned() const {
  const State* state = state_.get();
  while (state && !state->sources.abandoned) state = state->parent.get();
  return state ? state->sources.abandoned : nullptr;
}

}  // namespace arcslip::control
