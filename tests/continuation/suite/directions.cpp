#include "catch.hpp"

#include "continuation/suite/cases.hpp"

#include <algorithm>
#include <cmath>

using namespace suite;
using arcslip::continuation::Point;
using arcslip::continuation::StopReason;

namespace {

std::vector<double> parameters(const std::vector<Event>& events) {
  std::vector<double> values;
  for (const Event& event : events) values.push_back(event.point.parameter);
  return values;
}

// Whether `found` begins with `expected`, to the accuracy of an event.
bool begins_with(const std::vector<double>& found, const std::vector<double>& expected) {
  if (found.size() < expected.size()) return false;
  for (std::size_t i = 0; i < expected.size(); ++i)
    if (std::abs(found[i] - expected[i]) > 1e-10 * std::max(1.0, std::abs(expected[i]))) return false;
  return true;
}

Branch from(const Case& c, const Point& point, int direction) {
  Case there = c;
  there.start.u = point.u;
  there.start.p[c.start.free.in(*c.problem)] = point.parameter;
  there.start.direction = direction;
  return trace(there);
}

}  // namespace

TEST_CASE("from its end each branch is followed back through the same folds to its start") {
  for (const Case& c : cases()) {
    if (c.branch_points || !c.folds) continue;
    CAPTURE(c.name);
    const Branch there = trace(c);
    const Point& end = there.points.back();
    const double along = end.tangent[end.tangent.size() - 1];
    const Branch back = from(c, end, along > 0 ? -1 : 1);
    auto expected = parameters(folds(there));
    std::reverse(expected.begin(), expected.end());
    CAPTURE(expected, parameters(folds(back)));
    CHECK(begins_with(parameters(folds(back)), expected));
    const bool from_a_bound = c.start.p[c.start.free.in(*c.problem)] == c.lower ||
                              c.start.p[c.start.free.in(*c.problem)] == c.upper;
    if (!from_a_bound) continue;
    CHECK(back.stop.reason == StopReason::boundary);
    CHECK(back.points.back().parameter == c.start.p[c.start.free.in(*c.problem)]);
    CHECK((back.points.back().u - there.points.front().u).norm() <
          1e-8 * (1 + there.points.front().u.norm()));
  }
}

TEST_CASE("from any of its points each branch is followed both ways through the folds that lie there") {
  for (const Case& c : cases()) {
    if (c.branch_points || !c.folds || c.folds->empty()) continue;
    const Branch whole = trace(c);
    for (double share : {0.13, 0.37, 0.5, 0.71, 0.9}) {
      const auto index = static_cast<std::size_t>(share * static_cast<double>(whole.points.size()));
      const Point& point = whole.points[index];
      CAPTURE(c.name, index, point.parameter);
      const double along = point.tangent[point.tangent.size() - 1];
      std::vector<double> before, after;
      for (const Event& fold : folds(whole))
        (fold.point.arclength < point.arclength ? before : after).push_back(fold.point.parameter);
      std::reverse(before.begin(), before.end());
      const auto ahead = parameters(folds(from(c, point, along > 0 ? 1 : -1)));
      CHECK(ahead.size() == after.size());
      CHECK(begins_with(ahead, after));
      CHECK(begins_with(parameters(folds(from(c, point, along > 0 ? -1 : 1))), before));
    }
  }
}
