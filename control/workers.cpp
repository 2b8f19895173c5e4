#include <arcslip/control/workers.hpp>

#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace arcslip::control {

// A thread that wakes up late finds the run closed and takes no part: the caller waits for those inside only.
struct Workers::Shared {
  int threads;
  std::mutex running;
  const std::function<void(std::size_t)>* work = nullptr;
  std::size_t count = 0;
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> open = false;
  std::atomic<int> inside = 0;         // of the others
  std::atomic<std::uint32_t> run = 0;  // its number
  std::atomic<bool> ends = false;
  std::mutex failing;
  std::exception_ptr failure;
  std::vector<std::jthread> others{};

  void work_on() {
    for (std::size_t k; (k = next.fetch_add(1)) < count;) try {
        (*work)(k);
      } catch (...) {
        next = count;
        const std::lock_guard lock(failing);
        if (!failure) failure = std::current_exception();
      }
  }

  void wait_for_runs() {
    for (std::uint32_t last = 0;;) {
      run.wait(last);
      last = run;
      if (ends) return;
      ++inside;
      if (open) work_on();
      if (--inside == 0) inside.notify_one();
    }
  }
};

Workers::Workers(int threads) : shared_(std::make_unique<Shared>(threads)) {}

Workers::~Workers() {
  shared_->ends = true;
  ++shared_->run;
  shared_->run.notify_all();
}

void Workers::run(std::size_t count, const std::function<void(std::size_t)>& work) {
  Shared& all = *shared_;
  const std::unique_lock alone(all.running, std::try_to_lock);
  if (!alone || all.threads <= 1) {
    for (std::size_t k = 0; k < count; ++k) work(k);
    return;
  }
  try {
    while (static_cast<int>(all.others.size()) < all.threads - 1)
      all.others.emplace_back([&all] { all.wait_for_runs(); });
  } catch (const std::system_error&) {  // the system gives no more
    all.threads = 1 + static_cast<int>(all.others.size());
  }
  all.work = &work;
  all.count = count;
  all.next = 0;
  all.failure = nullptr;
  all.open = true;
  ++all.run;
  all.run.notify_all();
  all.work_on();
  all.open = false;
  for (int inside; (inside = all.inside) > 0;) all.inside.wait(inside);
  if (all.failure) std::rethrow_exception(all.failure);
}

}  // namespace arcslip::control
