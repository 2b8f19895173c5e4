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

}  // namespace

std::string time_left(double share, double seconds) {
  if (!(share > 0.01) || seconds < 0.5) return "";
  const double left = seconds * (1 - share) / share;
  std::array<char, 48> text{};
  if (left < 90)
    std::snprintf(text.data(), text.size(), "  %.0f s left", std::ceil(left));
  else if (left < 5400)
    std::snprintf(text.data(), text.size(), "  %.0f min left", std::ceil(left / 60));
  else
    std::snprintf(text.data(), text.size(), "  %.1f h left", left / 3600);
  return text.data();
}

std::string progress_text(const control::Progress& progress, const std::string& unit, double seconds) {
  const int branches = std::max(progress.branches, 1);
  std::string line;
  const auto add = [&](const char* format, auto... values) {
    std::array<char, 200> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    line += text.data();
  };
  add("%s %d/%d", progress.item, std::min(progress.branch + 1, branches), branches);
  if (progress.order > 0) add("  order %d", progress.order);
  if (*progress.phase != '\0') add("  %s", progress.phase);
  add("  %ld %s", progress.points, progress.counted);
  if (progress.frequency > 0) add("  %.6g %s", progress.frequency, unit.c_str());
  if (progress.step != 0)  // no step at a fixed frequency
    add("  step %.2g %s", progress.step, unit.c_str());
  if (!std::isnan(progress.best)) add("  best %.5g m", progress.best);
  if (std::isnan(progress.share_done)) {
    add("  %.0f s", seconds);
    return line;
  }
  const double share = std::clamp((progress.branch + progress.share_done) / branches, 0.0, 1.0);
  add("  %.0f %%", 100 * share);
  return progress.order > 0 ? line : line + time_left(share, seconds);
}

ProgressLine::ProgressLine(bool quiet, std::string unit)
    : shown_(!quiet), terminal_(::isatty(STDERR_FILENO) == 1), unit_(std::move(unit)) {
  next_ = begin_ + (terminal_ ? rewritten_every : reported_every);
}

void ProgressLine::show(const control::Progress& progress) {
  show([&](double seconds) { return progress_text(progress, unit_, seconds); });
}

void ProgressLine::show(const std::function<std::string(double)>& text) {
  if (!shown_) return;
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + (terminal_ ? rewritten_every : reported_every);
  std::string line = text(std::chrono::duration<double>(now - begin_).count());
  if (!terminal_) {
    tell(line);
    return;
  }
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
