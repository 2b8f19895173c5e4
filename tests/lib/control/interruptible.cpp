// Computations that ask nothing, ended by a stop request.

#include "catch.hpp"

#include <arcslip/control/interruptible.hpp>

#include <future>
#include <memory>
#include <stdexcept>
#include <thread>

using namespace arcslip::scene;

TEST_CASE("a computation that asks nothing is left at a stop, and reported that it is given up") {
  const auto reported = std::make_shared<std::promise<void>>();
  std::future<void> is_reported = reported->get_future();
  int asked = 0;
  const auto stop = [&] { return ++asked == 3; };
  const auto endless = [reported](const StopRequest& given_up) {
    while (!given_up()) std::this_thread::yield();
    reported->set_value();
    return 1;
  };
  CHECK_THROWS_WITH(interruptible(endless, stop, "interrupted while it went on"),
                    "interrupted while it went on");
  CHECK(asked == 3);
  is_reported.get();
}

TEST_CASE("a computation that ends by itself gives its result or its exception, with and without requests") {
  const auto own = std::this_thread::get_id();
  const auto thread = [](const StopRequest&) { return std::this_thread::get_id(); };
  CHECK(interruptible(thread, {}, "") == own);
  CHECK(interruptible(thread, [] { return false; }, "") != own);
  const auto fails = [](const StopRequest&) -> int { throw std::runtime_error("no solution"); };
  CHECK_THROWS_WITH(interruptible(fails, {}, ""), "no solution");
  CHECK_THROWS_WITH(interruptible(fails, [] { return false; }, ""), "no solution");
}
