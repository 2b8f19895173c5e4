#include "interrupt.hpp"

#include <arcslip/control/interruptible.hpp>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <utility>

namespace arcslip::app {
namespace {

std::atomic<bool> end_asked = false;  // the only state a handler may access
static_assert(std::atomic<bool>::is_always_lock_free);

control::AbandonedThreads& abandoned() {
  static control::AbandonedThreads threads;
  return threads;
}

extern "C" void ask_for_end(int signal) {
  if (end_asked) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // delivered when this handler returns
  }
  end_asked = true;
}

void watch(int signal) {
  struct sigaction old {};
  if (::sigaction(signal, nullptr, &old) == 0 && old.sa_handler == SIG_IGN)
    return;  // ignored, as under nohup
  struct sigaction action {};
  action.sa_handler = ask_for_end;  // without SA_RESTART: blocking calls return and check
  sigemptyset(&action.sa_mask);
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

void watch_signals() {
  watch(SIGINT);
  watch(SIGTERM);
  watch(SIGHUP);  // the terminal was closed
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

const control::Control& by_signal() {
  static const control::Control control{{.flag = &end_asked, .abandoned = &abandoned()}};
  return control;
}

bool interrupted() {
  return end_asked;
}

void leave(int code) {
  if (abandoned().count() > 0) std::_Exit(code);
  std::exit(code);
}

bool Interruption::is_new() {
  return interrupted() && !std::exchange(reported_, true);
}

}  // namespace arcslip::app
