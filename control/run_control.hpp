#pragma once
// Whether a computation is to go on, and what it reports.

#include <arcslip/control/error.hpp>
#include <arcslip/control/progress.hpp>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <stop_token>

namespace arcslip::control {

class AbandonedThreads;

/// An operation that was ended by a Control without a result. what() says what was not done.
class Interrupted : public Error {
  using Error::Error;
};

enum class EndReason { none, user, deadline };

/// How a control came to its end.
struct Ending {
  EndReason reason = EndReason::none;
  double seconds = 0;  // of a deadline: what had passed of them
  double limit = 0;    // of a deadline: Control::Sources::seconds
};

/// What ends a control besides its parent and stop(), and where its reports go. References and pointers
/// outlive the calls that the control is passed to.
struct Sources {
  std::function<void(const Progress&)> report{};  // none: to the parent; called by one thread at a time
  const std::atomic<bool>* flag = nullptr;        // true ends it; may be set by a signal handler
  std::stop_token token{};
  // False ends it. Called in the thread that made the control only, as an interpreter asks for; what it
  // throws is passed on.
  std::function<bool()> poll{};
  std::chrono::milliseconds poll_every{20};               // at most
  double seconds = 0;                                     // the deadline, from now on; 0: none
  double grace = 0;                                       // s, by which it outlives its parent
  std::shared_ptr<const std::atomic<bool>> only_while{};  // false: it goes on, even if it had ended
  AbandonedThreads* abandoned = nullptr;  // where interruptible() leaves threads; none: the parent's
};

/// Passed to whatever takes longer than a tenth of a second, and asked there whether to go on. A handle:
/// copies share one state, which several threads may use. By default it never ends and reports nothing.
class Control {
 public:
  Control() = default;
  explicit Control(Sources sources);

  /// Returns a control that ends with this one, and by its own sources.
  Control child(Sources sources = {}) const;
  /// Returns a child with that deadline; this one if it is 0.
  Control until(double seconds) const;
  /// Returns a child that reports nothing.
  Control quiet() const;

  /// Returns whether to go on. Once false it stays so. Costs about as much as reading a clock.
  bool keep_going() const;
  /// Returns why keep_going() is false, without asking again; the reason is none while it is true.
  Ending ending() const;
  /// Returns whether it can end at all.
  bool can_end() const { return state_ != nullptr; }

  /// Ends it, as the user's wish, and its children with it. May be called in a signal handler and by any
  /// thread. One made by default does not end.
  void stop() const;

  void report(const Progress& now) const;

  /// Returns the list for interruptible(), which may be null.
  AbandonedThreads* abandoned() const;

 private:
  struct State;
  explicit Control(std::shared_ptr<State> state) : state_(std::move(state)) {}

  std::shared_ptr<State> state_;  // null: by default
};

}  // namespace arcslip::control
