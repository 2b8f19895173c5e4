#include <arcslip/control/interruptible.hpp>

#include <algorithm>

namespace arcslip::control {
namespace {

constexpr std::chrono::milliseconds between_questions{20};

}  // namespace

AbandonableThread::AbandonableThread(std::function<void()> work)
    : thread_([work = std::move(work), ended = ended_]() mutable {
        work();
        work = nullptr;  // with all that it owns
        *ended = true;
      }) {}

std::size_t AbandonedThreads::count() {
  const std::lock_guard lock(mutex_);
  std::erase_if(threads_, [](const AbandonableThread& thread) { return thread.has_ended(); });
  return threads_.size();
}

void AbandonedThreads::join() {
  std::vector<AbandonableThread> all;
  {
    const std::lock_guard lock(mutex_);
    all.swap(threads_);
  }
}

void AbandonedThreads::add(AbandonableThread thread) {
  const std::lock_guard lock(mutex_);
  threads_.push_back(std::move(thread));
}

namespace detail {

void wait_for_place(AbandonedThreads& threads, const Control& control, const std::string& message) {
  while (threads.count() >= AbandonedThreads::most) {
    if (!control.keep_going()) throw Interrupted(message);
    std::this_thread::sleep_for(between_questions);
  }
}

void wait_for(AbandonableThread& thread, const std::function<bool(std::chrono::milliseconds)>& is_there,
              const Control& control, const Control& of_thread, const std::string& message) {
  try {
    while (!is_there(between_questions))
      if (!control.keep_going()) throw Interrupted(message);
  } catch (...) {
    of_thread.stop();
    control.abandoned()->add(std::move(thread));
    throw;
  }
}

}  // namespace detail
}  // namespace arcslip::control
