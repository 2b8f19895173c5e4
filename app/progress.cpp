#include "progress.hpp"

#include "message.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <sys/ioctl.h>
#include <unistd.h>

namespace arcslip::app {
namespace {

std::size_t terminal_width() {
  struct winsize size {};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col - 1u : 79u;
}

std::string time_left(double share, double seconds) {
  if (!(share > 0.01) || seconds < 0.5) {
    return "";
  }
  const double left = seconds * (1 - share) / share;
  std::array<char, 48> text{};
  if (left < 90) {
    std::snprintf(text.data(), text.size(), "  %.0f s left", std::ceil(left));
  } else if (left < 5400) {
    std::snprintf(text.data(), text.size(), "  %.0f min left", std::ceil(left / 60));
  } else {
    std::snprintf(text.data(), text.size(), "  %.1f h left", left / 3600);
  }
  return text.data();
}

}  // namespace

std::string progress_text(const observables::Progress& progress, const std::string& unit, double seconds) {
  const int branches = std::max(progress.branches, 1);
  const double share = std::clamp((progress.branch + progress.share_done) / branches, 0.0, 1.0);
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), "%s %d/%d  %ld %s  %.6g %s", progress.item,
                std::min(progress.branch + 1, branches), branches, progress.points, progress.counted,
                progress.frequency, unit.c_str());
  std::string line = text.data();
  if (progress.step != 0) {  // at a fixed frequency there is none
    std::snprintf(text.data(), text.size(), "  step %.2g %s", progress.step, unit.c_str());
    line += text.data();
  }
  std::snprintf(text.data(), text.size(), "  %.0f %%", 100 * share);
  return line + text.data() + time_left(share, seconds);
}

ProgressLine::ProgressLine(bool quiet, std::string unit)
    : shown_(!quiet && ::isatty(STDERR_FILENO) == 1), unit_(std::move(unit)) {}

void ProgressLine::show(const observables::Progress& progress) {
  if (!shown_) {
    return;
  }
  const auto now = Clock::now();
  if (now < next_) {
    return;
  }
  next_ = now + std::chrono::milliseconds(100);
  std::string line = progress_text(progress, unit_, std::chrono::duration<double>(now - begin_).count());
  line.resize(std::min(line.size(), terminal_width()));
  const std::size_t width = line.size();
  line.resize(std::max(width, width_), ' ');
  width_ = width;
  put("\r" + line);
}

void ProgressLine::clear() {
  if (width_ > 0) {
    std::string blank(width_ + 2, ' ');
    blank.front() = blank.back() = '\r';
    put(blank);
    width_ = 0;
  }
}

}  // namespace arcslip::app
