#pragma once
// Whether a search is to go on, and if not, why. One watch is handed to all phases of a search, and by them
// down to each step of each trace, so that nothing that can take longer than a second goes unasked. Not
// installed.

#include <arcslip/observables/response.hpp>

#include <chrono>
#include <functional>
#include <string>

namespace arcslip::optimize {

class Watch {
 public:
  /// seconds: a limit; 0: none. ask: whether the user goes on; none: always.
  Watch(double seconds, std::function<bool()> ask) : limit_(seconds), ask_(std::move(ask)) {}
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// Between evaluations: false from the limit on, or from when the user has said so.
  bool go_on();

  /// Within one: false half a second after go_on(), so that a quick one under way comes to its end, and a
  /// result has the first design even where the limit is short.
  bool go_on_within();

  /// As if the user had said so.
  void stop();

  bool stopped() const { return !reason_.code.empty(); }
  /// What stops it, with the phase; without a reason: nothing.
  observables::Stop why() const;

  /// What is done, in words for people: "the search".
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
