// Traces next to each other, built with the thread sanitizer where there is one: it ends the program at the
// first race.

#include "catch.hpp"

#include "continuation/events/hopf_problems.hpp"

#include <arcslip/continuation/diagrams/diagram.hpp>
#include <arcslip/continuation/events/hopf.hpp>
#include <arcslip/continuation/special_points/branch_point.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>

#include <functional>
#include <thread>

using namespace problems;

namespace {

constexpr int threads = 8;

// What each thread found is what one alone finds, bit for bit.
void check_nearby(const std::function<Branch()>& alone) {
  const Branch one = alone();
  std::vector<Branch> all(threads);
  std::vector<std::thread> running;
  for (Branch& each : all) running.emplace_back([&] { each = alone(); });
  for (std::thread& each : running) each.join();
  for (const Branch& each : all) {
    REQUIRE(each.points.size() == one.points.size());
    CHECK(each.stop.message == one.stop.message);
    for (std::size_t k = 0; k < one.points.size(); ++k) CHECK(each.points[k].u == one.points[k].u);
    REQUIRE(each.events.size() == one.events.size());
    for (std::size_t k = 0; k < one.events.size(); ++k) {
      CHECK(each.events[k].monitor == one.events[k].monitor);
      CHECK(each.events[k].point.parameter == one.events[k].point.parameter);
      CHECK(each.events[k].data.index() == one.events[k].data.index());
    }
  }
}

}  // namespace

TEST_CASE("eight traces with copies of one vector of Hopf monitors find each what one alone finds") {
  const Line line{.nodes = 8};
  const auto problem = line.problem();
  const auto monitors = hopf_monitors(*problem);
  check_nearby([&] {
    Branch branch =
        trace(problem, {line.homogeneous(2, 4), Vector{{4.0, 2.0}}, 0, 1}, window(4, 7), monitors);
    REQUIRE(branch.events.size() >= 2);
    return branch;
  });
}

TEST_CASE("eight traces of one problem, dense, sparse and of folds, with all monitors") {
  check_nearby([problem = cusp()] {
    return trace(problem, {Vector::Constant(1, -1.3), Vector{{-1.0, 1.0}}, 0, 1}, window(-1, 1),
                 {fold_monitor(), branch_point_monitor(), kink_monitor(), bound_monitor("end", 0, 1.2)});
  });
  check_nearby([problem = from_functions(rod(20))] {
    return trace(problem, {Vector::Zero(20), Vector{{5.0}}, 0, 1}, window(5, 50),
                 {fold_monitor(), branch_point_monitor()});
  });
  check_nearby([problem = folds(cusp(), 0)] {
    return trace(problem, {Vector{{-0.6, 0.4}}, Vector{{0.0, 1.0}}, 1, -1}, window(-1, 2), {cusp_monitor()});
  });
}
