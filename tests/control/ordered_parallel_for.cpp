// Loops in several threads: results, their order, and what ends them.

#include "catch.hpp"

#include <arcslip/control/ordered_parallel_for.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace arcslip::control;

namespace {

/// Longer for some k than for others, so that results are ready out of order.
void take_time(std::size_t k) {
  std::this_thread::sleep_for(std::chrono::microseconds(k % 3 == 0 ? 2000 : 100 * (k % 5)));
}

}  // namespace

TEST_CASE("results of several threads are taken in order, in the calling thread, by few of them at a time") {
  for (const int threads : {0, 1, 2, 3, 8, 100}) {
    CAPTURE(threads);
    const Control control{Sources()};
    std::atomic<int> running = 0, most = 0;
    std::atomic<std::size_t> taken = 0, farthest = 0;
    const auto caller = std::this_thread::get_id();
    bool are_in_order = true, in_caller = true;
    in_order(
        60, threads, control,
        [&](std::size_t k) {
          most = std::max(most.load(), ++running);
          farthest = std::max(farthest.load(), k - std::min(k, taken.load()));
          take_time(k);
          --running;
          return k;
        },
        [&](std::size_t k) {
          are_in_order = are_in_order && k == taken;
          in_caller = in_caller && std::this_thread::get_id() == caller;
          ++taken;
        });
    CHECK(taken == 60);
    CHECK(are_in_order);
    CHECK(in_caller);
    CHECK(most <= std::max(threads, 1));
    CHECK(farthest <= 2 * static_cast<std::size_t>(std::max(threads, 1)));
    CHECK(control.keep_going());
  }
}

TEST_CASE("an exception of one computation comes after the results before it, and ends the others") {
  for (const int threads : {1, 2, 8}) {
    CAPTURE(threads);
    const Control control{Sources()};
    std::vector<std::size_t> taken;
    const auto all = [&] {
      in_order(
          1000, threads, control,
          [&](std::size_t k) {
            take_time(k);
            if (k == 7) throw std::runtime_error("seven");
            return k;
          },
          [&](std::size_t k) { taken.push_back(k); });
    };
    CHECK_THROWS_WITH(all(), "seven");
    CHECK(taken == std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6});
  }
}

TEST_CASE("an exception where a result is taken ends the computations") {
  const Control control{Sources()};
  std::atomic<int> begun = 0;
  const auto all = [&] {
    in_order(
        1000, 4, control,
        [&](std::size_t k) {
          ++begun;
          take_time(k);
          return k;
        },
        [](std::size_t k) {
          if (k == 3) throw std::runtime_error("the disk is full");
        });
  };
  CHECK_THROWS_WITH(all(), "the disk is full");
  CHECK_FALSE(control.keep_going());
  CHECK(begun <= 4 + 8 + 1);
}

TEST_CASE("after a stop what is begun is taken, and no more is begun") {
  for (const int threads : {1, 2, 8}) {
    CAPTURE(threads);
    const Control control{Sources()};
    std::atomic<std::size_t> begun = 0;
    std::size_t taken = 0;
    in_order(
        1000, threads, control,
        [&](std::size_t k) {
          ++begun;
          take_time(k);
          if (k == 20) control.stop();
          return k;
        },
        [&](std::size_t k) { CHECK(k == taken++); });
    CHECK(taken == begun);
    CHECK(taken >= 21);
    CHECK(taken <= 21 + 2 * static_cast<std::size_t>(threads));
  }
}

TEST_CASE("while the calling thread waits for others it polls, and a stop is heard") {
  int asked = 0;
  const Control control{{.poll = [&] { return ++asked < 3; }}};
  std::size_t taken = 0;
  const auto until_stopped = [&](std::size_t k) {
    while (control.keep_going()) std::this_thread::yield();
    return k;
  };
  in_order(1000, 3, control, until_stopped, [&](std::size_t) { ++taken; });
  CHECK(asked == 3);
  CHECK(taken == 3);
}
