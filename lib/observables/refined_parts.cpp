#include <arcslip/observables/refined_parts.hpp>

#include <arcslip/elements/harmonics.hpp>
#include <arcslip/observables/study_branches.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::observables {
namespace {

constexpr std::size_t neighbours = 3;  // points on each side that a part takes with it
constexpr std::size_t apart = 4;       // points between two parts: fewer belong to one

elements::Harmonics harmonics_of(const ResponseBranch& branch) {
  return {branch.harmonics.back(), branch.harmonics.front() > 0, branch.period};
}

std::vector<double> in_harmonics(const std::vector<double>& u, const elements::Harmonics& from,
                                 const elements::Harmonics& to) {
  const auto blocks = static_cast<Eigen::Index>(u.size()) / from.size();
  std::vector<double> wider(static_cast<std::size_t>(blocks * to.size()));
  elements::transfer(from, Eigen::Map<const Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size())),
                     to, Eigen::Map<Eigen::VectorXd>(wider.data(), blocks * to.size()));
  return wider;
}

// Whether the frequency goes on at each point of a branch, and no event lies next to it; true at both ends.
std::vector<bool> may_end(const ResponseBranch& branch) {
  const auto& points = branch.points;
  const std::size_t n = points.size();
  std::vector<bool> may(n, true);
  for (std::size_t i = 1; i + 1 < n; ++i)
    may[i] = (points[i].omega - points[i - 1].omega) * (points[i + 1].omega - points[i].omega) > 0;
  for (const ResponseEvent& event : branch.events)
    for (std::size_t i = event.after > 0 ? event.after - 1 : 0; i < std::min(n, event.after + 3); ++i)
      may[i] = false;
  may.front() = may.back() = true;
  return may;
}

// A part whose last point may move on, with the range of the frequencies before that point.
struct Growing {
  Part part;
  double lowest = HUGE_VAL, highest = -HUGE_VAL;

  void go_to(const std::vector<ResponsePoint>& points, std::size_t last) {
    for (; part.last < last; ++part.last) {
      lowest = std::min(lowest, points[part.last].omega);
      highest = std::max(highest, points[part.last].omega);
    }
  }
  // Whether the last point is beyond all others, above or below.
  bool is_left(const std::vector<ResponsePoint>& points) const {
    return points[part.last].omega > highest || points[part.last].omega < lowest;
  }
};

// The events that lie between two points.
template <class Between>
void append_events(const std::vector<ResponseEvent>& events, const Between& between, std::ptrdiff_t shift,
                   std::vector<ResponseEvent>& to) {
  for (const ResponseEvent& event : events) {
    if (!between(event.after)) continue;
    to.push_back(event);
    to.back().after = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(event.after) + shift);
  }
}

}  // namespace

ResponsePoint in_harmonics(ResponsePoint point, const ResponseBranch& from, const ResponseBranch& to) {
  if (!point.unknowns.empty())
    point.unknowns = in_harmonics(point.unknowns, harmonics_of(from), harmonics_of(to));
  if (!point.coefficients.empty()) {
    std::vector<double> wider(2 * to.harmonics.size());
    for (std::size_t i = 0; i < from.harmonics.size(); ++i) {
      const auto at = std::find(to.harmonics.begin(), to.harmonics.end(), from.harmonics[i]);
      const auto k = static_cast<std::size_t>(at - to.harmonics.begin());
      wider[2 * k] = point.coefficients[2 * i];
      wider[2 * k + 1] = point.coefficients[2 * i + 1];
    }
    point.coefficients = std::move(wider);
  }
  return point;
}

std::vector<Part> parts_to_refine(const ResponseBranch& branch, double allowed) {
  const std::size_t n = branch.points.size();
  if (n == 0) return {};
  std::vector<bool> more(n);
  const auto needs_more = [&](const ResponsePoint& point) {
    return point.truncation_flagged || !(std::abs(point.truncation_estimate) <= allowed);
  };
  for (std::size_t i = 0; i < n; ++i) more[i] = needs_more(branch.points[i]);
  for (const ResponseEvent& event : branch.events)
    if (needs_more(event.point)) more[event.after] = more[std::min(event.after + 1, n - 1)] = true;
  const std::vector<bool> may = may_end(branch);
  std::vector<Growing> growing;
  for (std::size_t i = 0; i < n; ++i) {
    if (!more[i]) continue;
    std::size_t first = i > neighbours ? i - neighbours : 0;
    while (!may[first]) --first;
    if (growing.empty() || first > growing.back().part.last + apart) growing.push_back({{first, first}});
    Growing& last = growing.back();
    last.go_to(branch.points, std::min(i + neighbours, n - 1));
    while (last.part.last + 1 < n && !(may[last.part.last] && last.is_left(branch.points)))
      last.go_to(branch.points, last.part.last + 1);
  }
  std::vector<Part> parts;
  for (const Growing& each : growing) parts.push_back(each.part);
  return parts;
}

ResponseBranch with_parts(const ResponseBranch& branch, const std::vector<Part>& parts,
                          std::vector<ResponseBranch> refined) {
  ResponseBranch whole = branch;
  whole.points.clear();
  whole.events.clear();
  whole.harmonics = refined.front().harmonics;
  whole.solver.unknowns = refined.front().solver.unknowns;
  std::size_t next = 0;  // point of the branch
  const auto keep_until = [&](std::size_t end) {
    const auto shift = static_cast<std::ptrdiff_t>(whole.points.size()) - static_cast<std::ptrdiff_t>(next);
    const std::size_t begin = next;
    const std::size_t first_event = whole.events.size();
    append_events(
        branch.events, [&](std::size_t after) { return after >= begin && after < end; }, shift, whole.events);
    for (std::size_t i = first_event; i < whole.events.size(); ++i)
      whole.events[i].point = in_harmonics(std::move(whole.events[i].point), branch, whole);
    for (; next < end; ++next) whole.points.push_back(in_harmonics(branch.points[next], branch, whole));
  };
  for (std::size_t k = 0; k < parts.size(); ++k) {
    keep_until(parts[k].first);
    append_events(
        refined[k].events, [](std::size_t) { return true; }, static_cast<std::ptrdiff_t>(whole.points.size()),
        whole.events);
    std::move(refined[k].points.begin(), refined[k].points.end(), std::back_inserter(whole.points));
    add(refined[k].solver, whole.solver);
    if (whole.unknown_stability.empty()) whole.unknown_stability = refined[k].unknown_stability;
    next = parts[k].last + 1;
  }
  keep_until(branch.points.size());
  return whole;
}

}  // namespace arcslip::observables
