// What ends a control, its children, and its reports.

#include "catch.hpp"

#include <arcslip/control/run_control.hpp>

#include <atomic>
#include <chrono>
#include <csignal>
#include <memory>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace arcslip::control;
using namespace std::chrono_literals;

namespace {

const Control signalled{Sources()};

extern "C" void stop_signalled(int) {
  signalled.stop();
}

}  // namespace

TEST_CASE("a control without sources never ends and reports nothing") {
  const Control none;
  CHECK_FALSE(none.can_end());
  none.stop();
  none.report({});
  CHECK(none.keep_going());
  CHECK(none.ending().reason == EndReason::none);
  CHECK(none.until(0).keep_going());
  CHECK_FALSE(none.until(0).can_end());
  CHECK(none.abandoned() == nullptr);
  const Control child = none.child();
  child.stop();
  CHECK_FALSE(child.keep_going());
}

TEST_CASE("stop, a flag and a token end a control as the user's wish, for good and for all copies") {
  std::atomic<bool> flag = false;
  const auto source = std::make_unique<std::stop_source>();  // on the stack GCC 12 warns of it
  const Control stopped{Sources()}, flagged{{.flag = &flag}}, of_token{{.token = source->get_token()}};
  for (const Control& each : {stopped, flagged, of_token}) {
    CHECK(each.keep_going());
    CHECK(each.ending().reason == EndReason::none);
  }
  stopped.stop();
  flag = true;
  source->request_stop();
  for (const Control& each : {stopped, flagged, of_token}) {
    CHECK_FALSE(each.keep_going());
    CHECK(each.ending().reason == EndReason::user);
    CHECK(each.ending().limit == 0);
  }
  flag = false;
  CHECK_FALSE(flagged.keep_going());
}

TEST_CASE("a signal handler may stop a control") {
  const auto before = std::signal(SIGUSR1, stop_signalled);
  CHECK(signalled.keep_going());
  std::raise(SIGUSR1);
  std::signal(SIGUSR1, before);
  CHECK_FALSE(signalled.keep_going());
}

TEST_CASE("a callback is polled at intervals, in the thread of the control only, and may throw") {
  int asked = 0;
  const Control each_time{{.poll = [&] { return ++asked < 3; }, .poll_every = 0ms}};
  std::thread([&] {
    for (int k = 0; k < 10; ++k) CHECK(each_time.keep_going());
  }).join();
  CHECK(asked == 0);
  const Control child = each_time.child();
  CHECK(child.keep_going());
  CHECK(each_time.keep_going());
  CHECK_FALSE(child.keep_going());
  CHECK_FALSE(each_time.keep_going());
  CHECK(asked == 3);
  CHECK(child.ending().reason == EndReason::user);

  int polled = 0;
  const Control seldom{{.poll = [&] { return ++polled > 0; }, .poll_every = 30ms}};
  const auto began = std::chrono::steady_clock::now();
  while (polled < 3) REQUIRE(seldom.keep_going());
  CHECK(std::chrono::steady_clock::now() - began >= 60ms);

  const Control fails{{.poll = []() -> bool { throw std::domain_error("interpreter"); }}};
  CHECK_THROWS_AS(fails.child().keep_going(), std::domain_error);
}

TEST_CASE("a child ends with its parent, and by itself without it") {
  const Control parent{Sources()};
  const Control one = parent.child(), other = parent.child(), grandchild = one.child();
  one.stop();
  CHECK(parent.keep_going());
  CHECK(other.keep_going());
  CHECK_FALSE(grandchild.keep_going());
  CHECK(grandchild.ending().reason == EndReason::user);
  parent.stop();
  CHECK_FALSE(other.keep_going());
}

TEST_CASE("a deadline ends a control and its children, and says how long it was") {
  const Control parent{Sources()};
  const Control limited = parent.until(0.05), child = limited.child(), longer = limited.until(1000);
  CHECK(child.keep_going());
  CHECK(child.ending().reason == EndReason::none);
  std::this_thread::sleep_for(60ms);
  for (const Control& each : {longer, child, limited}) {
    CHECK_FALSE(each.keep_going());
    CHECK(each.ending().reason == EndReason::deadline);
    CHECK(each.ending().limit == 0.05);
    CHECK(each.ending().seconds >= 0.05);
    CHECK(each.ending().seconds == limited.ending().seconds);
  }
  CHECK(parent.keep_going());
  limited.stop();  // too late
  CHECK(limited.ending().reason == EndReason::deadline);
}

TEST_CASE("a child with a grace outlives its parent by it, whatever ended that") {
  for (const bool by_user : {false, true}) {
    CAPTURE(by_user);
    const Control parent{{.seconds = by_user ? 1000 : 0.01}};
    const Control within = parent.child({.grace = 0.1});
    if (by_user) parent.stop();
    const auto began = std::chrono::steady_clock::now();
    while (parent.keep_going()) std::this_thread::yield();
    CHECK(within.keep_going());
    CHECK(within.ending().reason == EndReason::none);
    while (within.keep_going()) std::this_thread::yield();
    CHECK(std::chrono::steady_clock::now() - began >= 95ms);
    CHECK(within.ending().reason == (by_user ? EndReason::user : EndReason::deadline));
    CHECK(within.ending().limit == parent.ending().limit);
  }
  const Control within = Control(Sources()).child({.grace = 1000});
  within.stop();
  CHECK_FALSE(within.keep_going());
}

TEST_CASE("a control that holds only while a flag is true goes on otherwise, even after its end") {
  const Control parent{Sources()};
  const auto holds = std::make_shared<std::atomic<bool>>(false);
  const Control child = parent.child({.only_while = holds});
  parent.stop();
  CHECK(child.keep_going());
  *holds = true;
  CHECK_FALSE(child.keep_going());
  *holds = false;
  CHECK(child.keep_going());
}

TEST_CASE("a report goes to the nearest that takes it, by one thread at a time") {
  long outer = 0, inner = 0;
  const Control parent{{.report = [&](const Progress& now) { outer += now.points; }}};
  const Control child = parent.child({.report = [&](Progress now) {
    ++inner;
    now.points *= 10;
    parent.report(now);
  }});
  parent.child().child().report({.points = 1});
  CHECK(outer == 1);
  child.until(100).report({.points = 2});
  CHECK(outer == 21);
  CHECK(inner == 1);
  child.quiet().report({.points = 3});
  CHECK(outer == 21);
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i)
      threads.emplace_back([&] {
        for (int k = 0; k < 1000; ++k) child.report({.points = 1});
      });
  }
  CHECK(outer == 40021);
  CHECK(inner == 4001);
}

TEST_CASE("a report may stop what reports") {
  const Control parent{Sources()};
  const Control child = parent.child({.report = [&](const Progress& now) {
    if (now.points == 3) parent.stop();
  }});
  long points = 0;
  while (child.keep_going()) child.report({.points = ++points});
  CHECK(points == 3);
}

TEST_CASE("threads that share a control all end at a stop at any moment, for one reason") {
  std::mt19937 random(1);
  for (int repeated = 0; repeated < 50; ++repeated) {
    const Control parent{{.seconds = 10}};
    std::atomic<int> ended = 0;
    {
      std::vector<std::jthread> threads;
      for (int i = 0; i < 4; ++i)
        threads.emplace_back([&, child = parent.child({.grace = i == 0 ? 0.001 : 0})] {
          while (child.keep_going()) child.report({});
          CHECK(child.ending().reason == EndReason::user);
          ++ended;
        });
      std::this_thread::sleep_for(std::chrono::microseconds(random() % 2000));
      parent.stop();
    }
    CHECK(ended == 4);
  }
}
