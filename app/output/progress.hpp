#pragma once

#include <arcslip/control/progress.hpp>

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

namespace arcslip::app {

/// A progress line on standard error, rewritten at most ten times a second; if that is not a terminal, a new
/// line every ten seconds.
class ProgressLine {
 public:
  /// unit: of the frequencies.
  ProgressLine(bool quiet, std::string unit);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() { clear(); }

  void show(const control::Progress& progress);
  /// Shows text(seconds since the beginning), which is not called where nothing is shown.
  void show(const std::function<std::string(double)>& text);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds rewritten_every{100}, reported_every{10000};
  bool shown_, terminal_;
  std::string unit_;
  std::size_t width_ = 0;  // of the line shown now
  Clock::time_point begin_ = Clock::now();
  Clock::time_point next_;
};

/// "  4 s left"; "" where too little is done. share: from 0 to 1, of what takes that long in all.
std::string time_left(double share, double seconds);

/// "branch 3/12  152 points  19.84 Hz  step 0.012 Hz  41 %  4 s left"; for a search, whose remaining time is
/// unknown, "search 1/4  the certificate  37 evaluations  20.1 Hz  best 0.0123 m  12 s". seconds: elapsed
/// time.
std::string progress_text(const control::Progress& progress, const std::string& unit, double seconds);

}  // namespace arcslip::app
