#pragma once

#include <arcslip/control/stop_request.hpp>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>

namespace arcslip::scene {

/// f(given_up) of an f that calls what asks no StopRequest, such as a factorization: in a thread of its own,
/// while `stop` is asked here. After a stop Interrupted(message) is thrown at once; f goes on with given_up()
/// true, until it or the program ends, and so must own all it uses. Without a stop request it is called here.
template <class F>
auto interruptible(F f, const StopRequest& stop, const std::string& message) {
  using Result = std::invoke_result_t<F&, const StopRequest&>;
  if (!stop) return f(stop);
  if (stop()) throw Interrupted(message);
  const auto given_up = std::make_shared<std::atomic<bool>>(false);
  auto task = std::make_shared<std::packaged_task<Result()>>(
      [f = std::move(f), given_up]() mutable { return f([given_up] { return given_up->load(); }); });
  std::future<Result> result = task->get_future();
  std::thread([task = std::move(task)] { (*task)(); }).detach();
  while (result.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
    if (!stop()) continue;
    *given_up = true;
    throw Interrupted(message);
  }
  return result.get();
}

}  // namespace arcslip::scene
