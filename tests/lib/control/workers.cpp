// Elements shared among threads.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/control/workers.hpp>
#include <arcslip/hbm/problem.hpp>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using namespace arcslip;

namespace {

// Masses on two springs each, each rubbing on a plane of its own, coupled in a row.
scene::Scene rubbing(int masses) {
  std::string dofs, springs, elements, list;
  const auto add = [](std::string& to, const std::string& what) { to += (to.empty() ? "" : ", ") + what; };
  for (int i = 0; i < masses; ++i) {
    const std::string n = std::to_string(i), next = std::to_string((i + 1) % masses);
    for (const std::string axis : {"x", "y", "z"}) {
      add(dofs, "\"" + axis + n + "\"");
      add(list, R"({"name": "m)" + axis + n + R"(", "at": ")" + axis + n + R"(", "value": 1})");
      add(springs, R"({"name": "k)" + axis + n + R"(", "at": ")" + axis + n + R"(", "value": )" +
                       std::to_string(1 + 0.1 * i) + "}");
    }
    add(springs,
        R"({"name": "l)" + n + R"(", "between": ["x)" + n + R"(", "x)" + next + R"("], "value": 0.05})");
    add(elements,
        R"({"name": "c)" + n + R"(", "type": "contact_3d",
      "tangential_1": {"at": "x)" +
            n + R"("}, "tangential_2": {"at": "y)" + n + R"("}, "normal": {"at": "z)" + n +
            R"("}, "tangential_stiffness": 0.5, "normal_stiffness": 0.5, "friction_coefficient": 0.3,
      "normal_load": 0.4})");
  }
  return scenes::parse(R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s",
    "structure": {"dofs": [)" +
                       dofs + R"(], "masses": [)" + list + R"(], "springs": [)" + springs + R"(],
      "damping": [{"name": "r", "type": "rayleigh", "alpha": 0.02, "beta": 0.02}]},
    "elements": [)" + elements +
                       R"(],
    "excitation": [{"name": "f", "at": "x0", "cosine": 0.2}, {"name": "g", "at": "y1", "sine": 0.1},
                   {"name": "h", "at": "z1", "cosine": 0.3}],
    "harmonics": {"order": 3}, "response": {"at": "x0"}, "studies": [{"kind": "frf", "from": 0.9, "to": 1.1}]})");
}

}  // namespace

TEST_CASE("workers do each piece of work once, by all threads, and pass an exception on") {
  for (const int threads : {1, 2, 5}) {
    CAPTURE(threads);
    hbm::Workers workers(threads);
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
  hbm::Workers workers(2);
  std::atomic<int> inside = 0;
  workers.run(2, [&](std::size_t) {
    ++inside;
    while (inside < 2) std::this_thread::yield();  // without another thread it would never end
  });
  CHECK(inside == 2);
}

TEST_CASE("threads that use the same workers at the same time do their own work") {
  hbm::Workers workers(3);
  std::atomic<int> done = 0;
  const auto work = [&] {
    for (int repeated = 0; repeated < 100; ++repeated) workers.run(10, [&](std::size_t) { ++done; });
  };
  { const std::jthread one(work), other(work); }
  CHECK(done == 2000);
}

TEST_CASE("responses do not depend on the number of threads among which elements are shared") {
  scene::Scene s = rubbing(4);
  const auto one = observables::frequency_response(s, scenes::window(s));
  REQUIRE(one.front().points.size() > 10);
  for (const int threads : {2, 3, 16}) {
    CAPTURE(threads);
    s.threads.count = threads;
    const auto several = observables::frequency_response(s, scenes::window(s));
    REQUIRE(several.size() == one.size());
    REQUIRE(several.front().points.size() == one.front().points.size());
    for (std::size_t i = 0; i < one.front().points.size(); ++i) {
      CHECK(several.front().points[i].unknowns == one.front().points[i].unknowns);
      CHECK(several.front().points[i].amplitude == one.front().points[i].amplitude);
    }
  }
  CHECK(s == [&] {
    scene::Scene of_one = s;
    of_one.threads.count = 1;
    return of_one;
  }());
}
