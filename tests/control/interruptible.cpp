// Computations that ask nothing, ended by a control.

#include "catch.hpp"

#include <arcslip/control/interruptible.hpp>

#include <atomic>
#include <future>
#include <memory>
#include <random>
#include <stdexcept>
#include <thread>

using namespace arcslip::control;
using namespace std::chrono_literals;

namespace {

// Computes until it is allowed to end, whatever it is asked.
struct Deaf {
  std::shared_ptr<std::atomic<bool>> may_end = std::make_shared<std::atomic<bool>>(false);
  int operator()(const Control&) const {
    while (!*may_end) std::this_thread::sleep_for(1ms);
    return 1;
  }
};

}  // namespace

TEST_CASE("a computation that asks nothing is left at a stop, and learns that it is given up") {
  AbandonedThreads abandoned;
  const auto reported = std::make_shared<std::promise<void>>();
  std::future<void> is_reported = reported->get_future();
  int asked = 0;
  const Control control{{.poll = [&] { return ++asked != 3; }, .poll_every = 0ms, .abandoned = &abandoned}};
  const auto endless = [reported](const Control& of_thread) {
    while (of_thread.keep_going()) std::this_thread::yield();
    reported->set_value();
    return 1;
  };
  CHECK_THROWS_WITH(interruptible(endless, control, "interrupted while it went on"),
                    "interrupted while it went on");
  CHECK(asked == 3);
  is_reported.get();
  abandoned.join();
  CHECK(abandoned.count() == 0);
  CHECK_THROWS_AS(interruptible(endless, control, ""), Interrupted);  // not begun
  CHECK(abandoned.count() == 0);
}

TEST_CASE(
    "a computation that ends by itself gives its result or its exception, in a thread only with a list") {
  AbandonedThreads abandoned;
  const Control with_list{{.abandoned = &abandoned}}, without{Sources()};
  const auto own = std::this_thread::get_id();
  const auto thread = [](const Control&) { return std::this_thread::get_id(); };
  CHECK(interruptible(thread, {}, "") == own);
  CHECK(interruptible(thread, without, "") == own);
  CHECK(interruptible(thread, with_list.child(), "") != own);
  const auto fails = [](const Control&) -> int { throw std::runtime_error("no solution"); };
  CHECK_THROWS_WITH(interruptible(fails, {}, ""), "no solution");
  CHECK_THROWS_WITH(interruptible(fails, with_list, ""), "no solution");
  CHECK(abandoned.count() == 0);
}

TEST_CASE("without a list a computation is ended where it asks") {
  const Control control{Sources()};
  const auto asks = [&](const Control& given) {
    control.stop();
    return given.keep_going();
  };
  CHECK_FALSE(interruptible(asks, control, ""));
  CHECK_THROWS_WITH(interruptible(asks, control, "interrupted before"), "interrupted before");
}

TEST_CASE("the list joins its threads when it goes, and counts those that compute") {
  const Deaf deaf;
  std::atomic<bool> gone = false;
  std::jthread host([&] {
    {
      AbandonedThreads abandoned;
      const Control control{{.seconds = 0.05, .abandoned = &abandoned}};
      CHECK_THROWS_AS(interruptible(deaf, control, ""), Interrupted);
      CHECK(abandoned.count() == 1);
    }
    gone = true;
  });
  std::this_thread::sleep_for(150ms);
  CHECK_FALSE(gone);
  *deaf.may_end = true;
  host.join();
  CHECK(gone);
}

TEST_CASE(
    "of three computations that are left one after the other the third waits, and can be stopped there") {
  AbandonedThreads abandoned;
  const Control host{{.abandoned = &abandoned}};
  const Deaf deaf;
  for (int k = 0; k < 2; ++k) CHECK_THROWS_AS(interruptible(deaf, host.until(0.03), ""), Interrupted);
  CHECK(abandoned.count() == 2);
  std::atomic<bool> begun = false;
  const auto third = [&](const Control&) {
    begun = true;
    return 3;
  };
  CHECK_THROWS_AS(interruptible(third, host.until(0.05), ""), Interrupted);
  CHECK_FALSE(begun);
  CHECK(abandoned.count() == 2);
  std::jthread later([&] {
    std::this_thread::sleep_for(50ms);
    *deaf.may_end = true;
  });
  CHECK(interruptible(third, host, "") == 3);
  CHECK(begun);
}

TEST_CASE("a question that throws leaves the thread to the list, too") {
  AbandonedThreads abandoned;
  int asked = 0;
  const auto poll = [&] {
    if (++asked == 3) throw std::domain_error("interpreter");
    return true;
  };
  const Control control{{.poll = poll, .poll_every = 0ms, .abandoned = &abandoned}};
  const Deaf deaf;
  CHECK_THROWS_AS(interruptible(deaf, control, ""), std::domain_error);
  CHECK(abandoned.count() == 1);
  *deaf.may_end = true;
}

TEST_CASE("a stop at any moment of a computation returns at once, or with its result") {
  AbandonedThreads abandoned;
  std::mt19937 random(2);
  for (int repeated = 0; repeated < 40; ++repeated) {
    const Control control{{.abandoned = &abandoned}};
    std::jthread user([&, wait = std::chrono::microseconds(random() % 60000)] {
      std::this_thread::sleep_for(wait);
      control.stop();
    });
    const auto owned = std::make_shared<int>(repeated);
    const auto work = [owned, wait = std::chrono::microseconds(random() % 60000)](const Control&) {
      std::this_thread::sleep_for(wait);
      return *owned;
    };
    const auto began = std::chrono::steady_clock::now();
    try {
      const int result = interruptible(work, control, "stopped");
      CHECK(result == repeated);
    } catch (const Interrupted&) {
      CHECK_FALSE(control.keep_going());
    }
    CHECK(std::chrono::steady_clock::now() - began < 1s);
  }
}
