#pragma once
// The points and events of a branch while it is traced: cut at its end, or joined of two directions.

#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/response.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::observables {

/// The points and events of a trace, with their arclength.
struct Course {
  std::vector<std::pair<double, ResponsePoint>> points;
  std::vector<std::pair<double, ResponseEvent>> events;

  /// Ends at the branch point there, which becomes the last point. The frequency turns there, and the
  /// amplitude may, next to the branch point by the rounding of its singular equations: folds and peaks
  /// closer than `next to` are none.
  void end_at(double arclength, double nearby) {
    std::erase_if(events, [&](const auto& event) {
      const std::string& kind = event.second.kind;
      return (kind == event_kinds::fold || kind == event_kinds::peak) &&
             std::abs(event.first - arclength) < nearby;
    });
    std::erase_if(points, [&](const auto& point) { return point.first >= arclength; });
    std::erase_if(events, [&](const auto& event) { return event.first > arclength; });
    const auto at = std::find_if(events.begin(), events.end(), [&](const auto& event) {
      return event.first == arclength && event.second.kind == event_kinds::branch_point;
    });
    if (at == events.end()) return;
    points.emplace_back(arclength, std::move(at->second.point));
    events.erase(at);
  }

  /// Of the same start, in the other direction.
  void prepend(Course&& back) {
    for (auto& point : back.points)
      if (point.first > 0) points.emplace(points.begin(), -point.first, std::move(point.second));
    for (auto& event : back.events) events.emplace_back(-event.first, std::move(event.second));
  }

  /// In the order of the arclength.
  void move_to(ResponseBranch& branch) {
    std::stable_sort(events.begin(), events.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& [arclength, event] : events) {
      const auto beyond = std::upper_bound(points.begin(), points.end(), arclength,
                                           [](double s, const auto& point) { return s < point.first; });
      event.after = static_cast<std::size_t>(std::max<std::ptrdiff_t>(beyond - points.begin(), 1) - 1);
      branch.events.push_back(std::move(event));
    }
    for (auto& point : points) branch.points.push_back(std::move(point.second));
  }
};

}  // namespace arcslip::observables
