#pragma once
// Computations that cannot be interrupted, such as a factorization.

#include <arcslip/control/run_control.hpp>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

namespace arcslip::control {

/// A thread that can be asked whether it has ended.
class AbandonableThread {
 public:
  explicit AbandonableThread(std::function<void()> work);
  bool has_ended() const { return *ended_; }

 private:
  std::shared_ptr<std::atomic<bool>> ended_ = std::make_shared<std::atomic<bool>>(false);
  std::jthread thread_;
};

/// The threads that still compute what nobody waits for any more. A host has one list for all its calls, and
/// passes it with its Control: a program that ends while count() is not 0 leaves by _Exit, as libraries must
/// not be taken down under them; an interpreter joins them when it ends.
class AbandonedThreads {
 public:
  /// None is begun while so many of them compute.
  static constexpr std::size_t most = 2;

  AbandonedThreads() = default;
  AbandonedThreads(const AbandonedThreads&) = delete;
  AbandonedThreads& operator=(const AbandonedThreads&) = delete;
  /// Joins them.
  ~AbandonedThreads() = default;

  /// Returns how many still compute.
  std::size_t count();
  void join();
  void add(AbandonableThread thread);

 private:
  std::mutex mutex_;
  std::vector<AbandonableThread> threads_;
};

namespace detail {

/// Waits until a further computation may be begun. Throws Interrupted.
void wait_for_place(AbandonedThreads& threads, const Control& control, const std::string& message);

/// Returns when is_there() does. If the control ends before, throws Interrupted, and leaves the thread to the
/// list, also where asking throws.
void wait_for(AbandonableThread& thread, const std::function<bool(std::chrono::milliseconds)>& is_there,
              const Control& control, const Control& of_thread, const std::string& message);

}  // namespace detail

/// Returns f(control) of an f that calls what asks no Control: in a thread of its own, while `control` is
/// asked here. At its end Interrupted(message) is thrown at once; f, which is given a control that is then
/// stopped, goes on in the list of abandoned threads, and so must own all it uses. Several threads that are
/// in it at the same time may each leave one there. Without such a list f is called here.
template <class F>
auto interruptible(F f, const Control& control, const std::string& message) {
  using Result = std::invoke_result_t<F&, const Control&>;
  if (!control.keep_going()) throw Interrupted(message);
  AbandonedThreads* const abandoned = control.abandoned();
  if (!abandoned) return f(control);
  detail::wait_for_place(*abandoned, control, message);
  const Control of_thread{Sources()};  // no child: f may outlive what `control` refers to
  auto task = std::make_shared<std::packaged_task<Result()>>(
      [f = std::move(f), of_thread]() mutable { return f(of_thread); });
  std::future<Result> result = task->get_future();
  AbandonableThread thread([task = std::move(task)] { (*task)(); });
  const auto is_there = [&](std::chrono::milliseconds patience) {
    return result.wait_for(patience) == std::future_status::ready;
  };
  detail::wait_for(thread, is_there, control, of_thread, message);
  return result.get();
}

}  // namespace arcslip::control
