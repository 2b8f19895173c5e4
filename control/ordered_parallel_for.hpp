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

namespace detail {

/// What the threads of in_order() share.
template <class Result>
class OrderedLoop {
 public:
  struct Made {
    std::optional<Result> result;
    std::exception_ptr failure;
  };

  OrderedLoop(std::size_t count, std::size_t ahead, const Control& control)
      : count_(count), ahead_(ahead), control_(control) {}
  OrderedLoop(const OrderedLoop&) = delete;
  OrderedLoop& operator=(const OrderedLoop&) = delete;
  /// Ends the threads, before what they use is gone.
  ~OrderedLoop() {
    if (!whole) {
      const std::lock_guard lock(mutex_);
      control_.stop();
    }
    changed_.notify_all();
  }

  template <class Make>
  void start(std::size_t workers, const Make& make) {
    for (std::size_t i = 0; i < workers; ++i) workers_.emplace_back([&] { work(make); });
  }

  /// Waits for the next result; nothing: there is none. What is begun is taken, also after a stop.
  std::optional<Made> next() {
    bool stopped = !control_.keep_going();
    std::unique_lock lock(mutex_);
    const auto is_there = [&] {
      return waiting_.contains(taken_) || taken_ == count_ || (stopped && taken_ == begun_);
    };
    while (!changed_.wait_for(lock, std::chrono::milliseconds(20), is_there)) {
      lock.unlock();
      stopped = !control_.keep_going();
      lock.lock();
    }
    auto found = waiting_.extract(taken_);
    if (found.empty()) return std::nullopt;
    ++taken_;
    changed_.notify_all();
    return std::move(found.mapped());
  }

  bool whole = false;  // all were taken, without an exception

 private:
  template <class Make>
  void work(const Make& make) {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock,
                    [&] { return !control_.keep_going() || begun_ == count_ || begun_ < taken_ + ahead_; });
      if (!control_.keep_going() || begun_ == count_) return;
      const std::size_t k = begun_++;
      lock.unlock();
      Made made;
      try {
        made.result.emplace(make(k));
      } catch (...) {
        made.failure = std::current_exception();
      }
      lock.lock();
      waiting_.emplace(k, std::move(made));
      changed_.notify_all();
    }
  }

  const std::size_t count_, ahead_;
  const Control& control_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::size_t, Made> waiting_;
  std::size_t begun_ = 0, taken_ = 0;
  std::vector<std::jthread> workers_;
};

}  // namespace detail

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
  const auto most = static_cast<std::size_t>(threads);
  detail::OrderedLoop<Result> loop(count, 2 * most, control);
  loop.start(std::min(most, count), make);
  while (auto made = loop.next()) {
    if (made->failure) std::rethrow_exception(made->failure);
    take(std::move(*made->result));
  }
  loop.whole = true;
}

}  // namespace arcslip::control
