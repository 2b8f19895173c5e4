#pragma once
// Computations that do not depend on each other, in several threads, with their results in order.

#include <arcslip/control/run_control.hpp>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

namespace arcslip::control {

/// How many of the threads each of `count` computations may use.
inline int threads_for_each(int threads, std::size_t count) {
  return threads <= 1 ? 1 : std::max(1, threads / static_cast<int>(std::clamp<std::size_t>(count, 1, 1024)));
}

/// take(make(k)) for k = 0 ... count - 1, in this order and in the calling thread, with make() in up to
/// `threads` threads: the results are those of one thread. None is begun that far ahead of take() that more
/// than twice as many results as threads wait for it. No k is begun after the end of `control`, which the
/// calling thread asks while it waits. An exception of make(k) is thrown after the results before k are
/// taken; it and one of take() stop `control`, which has to be one that can end, and wait for what is begun.
template <class Make, class Take>
void in_order(std::size_t count, int threads, const Control& control, const Make& make, const Take& take) {
  using Result = std::invoke_result_t<const Make&, std::size_t>;
  if (threads <= 1 || count <= 1) {
    for (std::size_t k = 0; k < count && control.keep_going(); ++k) take(make(k));
    return;
  }
  struct Made {
    std::optional<Result> result;
    std::exception_ptr failure;
  };
  std::mutex mutex;
  std::condition_variable changed;
  std::map<std::size_t, Made> waiting;
  std::size_t begun = 0, taken = 0;
  const std::size_t ahead = 2 * static_cast<std::size_t>(threads);
  const auto work = [&] {
    std::unique_lock lock(mutex);
    for (;;) {
      changed.wait(lock, [&] { return !control.keep_going() || begun == count || begun < taken + ahead; });
      if (!control.keep_going() || begun == count) return;
      const std::size_t k = begun++;
      lock.unlock();
      Made made;
      try {
        made.result.emplace(make(k));
      } catch (...) {
        made.failure = std::current_exception();
      }
      lock.lock();
      waiting.emplace(k, std::move(made));
      changed.notify_all();
    }
  };
  struct Crew {  // ends the threads, before what they use is gone
    const Control& control;
    std::mutex& mutex;
    std::condition_variable& changed;
    std::vector<std::jthread> workers{};
    bool whole = false;
    ~Crew() {
      if (!whole) {
        const std::lock_guard lock(mutex);
        control.stop();
      }
      changed.notify_all();
    }
  } crew{control, mutex, changed};
  const auto workers = std::min(static_cast<std::size_t>(threads), count);
  for (std::size_t i = 0; i < workers; ++i) crew.workers.emplace_back(work);
  for (;;) {
    std::unique_lock lock(mutex);
    // What is begun is taken, also after a stop.
    bool stopped = false;
    const auto is_there = [&] {
      return waiting.contains(taken) || taken == count || (stopped && taken == begun);
    };
    while (!changed.wait_for(lock, std::chrono::milliseconds(20), is_there)) {
      lock.unlock();
      stopped = !control.keep_going();
      lock.lock();
    }
    const auto next = waiting.extract(taken);
    if (next.empty()) break;
    ++taken;
    changed.notify_all();
    lock.unlock();
    if (next.mapped().failure) std::rethrow_exception(next.mapped().failure);
    take(std::move(*next.mapped().result));
  }
  crew.whole = true;
}

}  // namespace arcslip::control
