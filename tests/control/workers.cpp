// Work shared among threads.
#include "catch.hpp"

#include <arcslip/control/workers.hpp>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace arcslip;

TEST_CASE("workers do each piece of work once, by all threads, and pass an exception on") {
  for (const int threads : {1, 2, 5}) {
    CAPTURE(threads);
    control::Workers workers(threads);
    for (int repeated = 0; repeated < 200; ++repeated) {
      std::vector<std::atomic<int>> done(37);
      workers.run(done.size(), [&](std::size_t k) { ++done[k]; });
      for (const auto& each : done) REQUIRE(each == 1);
      workers.run(0, [](std::size_t) { FAIL("there is none"); });
    }
    CHECK_THROWS_AS(workers.run(20,
                                [](std::size_t k) {
                                  if (k == 3) throw std::domain_error("third");
                                }),
                    std::domain_error);
    std::atomic<int> after = 0;
    workers.run(5, [&](std::size_t) { ++after; });
    CHECK(after == 5);
  }
}

TEST_CASE("work is shared: two threads are in it together") {
  control::Workers workers(2);
  std::atomic<int> inside = 0;
  workers.run(2, [&](std::size_t) {
    ++inside;
    while (inside < 2) std::this_thread::yield();  // without another thread it would never end
  });
  CHECK(inside == 2);
}

TEST_CASE("threads that use the same workers at the same time do their own work") {
  control::Workers workers(3);
  std::atomic<int> done = 0;
  const auto work = [&] {
    for (int repeated = 0; repeated < 100; ++repeated) workers.run(10, [&](std::size_t) { ++done; });
  };
  { const std::jthread one(work), other(work); }
  CHECK(done == 2000);
}
