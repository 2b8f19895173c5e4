#pragma once

#include <arcslip/observables/frequency_response.hpp>

#include <chrono>
#include <cstddef>
#include <string>

namespace arcslip::app {

/// One line on standard error that is rewritten at most ten times a second. Silent unless that is a terminal.
class ProgressLine {
 public:
  /// `unit` is that of the frequencies.
  ProgressLine(bool quiet, std::string unit);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() { clear(); }

  void show(const observables::Progress& progress);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool shown_;
  std::string unit_;
  std::size_t width_ = 0;  // of what stands there now
  Clock::time_point begin_ = Clock::now();
  Clock::time_point next_ = begin_ + std::chrono::milliseconds(100);
};

/// "branch 3/12  152 points  19.84 Hz  step 0.012 Hz  41 %  4 s left"; `seconds` have passed since the
/// beginning.
std::string progress_text(const observables::Progress& progress, const std::string& unit, double seconds);

}  // namespace arcslip::app
