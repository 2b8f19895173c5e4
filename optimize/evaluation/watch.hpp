#pragma once
// Interruption and time limit of a search. One watch is passed to all phases of a search, and by them down to
// each step of each trace, so that anything longer than a second can be interrupted. Not installed.

#include <arcslip/results/response.hpp>

#include <chrono>
#include <functional>
#include <string>

namespace arcslip::optimize {

class Watch {
 public:
  /// seconds: time limit; 0: none. ask: whether to continue; none: always.
  Watch(double seconds, std::function<bool()> ask) : limit_(seconds), ask_(std::move(ask)) {}
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// Between evaluations: false after the time limit, or once the user has requested a stop.
  bool go_on();

  /// Within an evaluation: false half a second after go_on(), so that a quick evaluation completes, and a
  /// result has the first design even with a short limit.
  bool go_on_within();

  /// Stops as if requested by the user.
  void stop();

  bool stopped() const { return !reason_.code.empty(); }
  /// Why it stops, with the phase; without a reason: it does not.
  observables::Stop why() const;

  /// The current phase in messages: "the search".
  void begin(const char* phase) { phase_ = phase; }
  const char* phase() const { return phase_; }

  double seconds() const;  // since this was made

 private:
  double limit_;
  std::function<bool()> ask_;
  results::Reason reason_{};
  const char* phase_ = "the search";
  const char* stopped_phase_ = "";
  double stopped_at_ = 0;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace arcslip::optimize
