#include "interrupt.hpp"

#include <csignal>
#include <utility>

namespace arcslip::app {
namespace {

volatile std::sig_atomic_t end_asked = 0;  // the only state a handler may access

extern "C" void ask_for_end(int signal) {
  if (end_asked != 0) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // delivered when this handler returns
  }
  end_asked = 1;
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

bool interrupted() {
  return end_asked != 0;
}

bool Interruption::is_new() {
  return interrupted() && !std::exchange(reported_, true);
}

}  // namespace arcslip::app
