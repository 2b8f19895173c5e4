#include <arcslip/analyses/branches/harmonic_refinement.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/fourier/harmonics.hpp>
#include <arcslip/observables/histories.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::observables {
namespace {

constexpr std::size_t overlap = 3;         // points on each side that a part takes with it
constexpr std::size_t points_between = 4;  // points between two parts: fewer belong to one
constexpr double most_refined = 0.8;       // of the points: beyond, the whole branch is traced anew
constexpr double same_response = 40;       // times the error allowed: the estimate is at least |dx|/20

std::vector<double> unknowns_in_harmonics(const std::vector<double>& u, const elements::Harmonics& from,
                                          const elements::Harmonics& to) {
  const auto blocks = static_cast<Eigen::Index>(u.size()) / from.size();
  std::vector<double> wider(static_cast<std::size_t>(blocks * to.size()));
  elements::transfer(from, Eigen::Map<const Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size())),
                     to, Eigen::Map<Eigen::VectorXd>(wider.data(), blocks * to.size()));
  return wider;
}

double largest_amplitude(const ResponseBranch& branch, const Part& part) {
  double largest = 0;
  for (std::size_t i = part.first; i <= part.last; ++i)
    largest = std::max(largest, branch.points[i].amplitude);
  for (const ResponseEvent& event : branch.events)
    if (event.after >= part.first && event.after < part.last)
      largest = std::max(largest, event.point.amplitude);
  return largest;
}

double largest_amplitude(const ResponseBranch& branch) {
  return largest_amplitude(branch, {0, branch.points.size() - 1});
}

// The largest difference of a coefficient of the response, m.
double point_distance(const Solution& a, const Solution& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.coefficients.size(); ++i)
    most = std::max(most, std::abs(a.coefficients[i] - b.coefficients[i]));
  return most;
}

// Whether a branch goes on in its direction at each point, and no event lies next to it; true at both ends.
std::vector<bool> may_end(const ResponseBranch& branch) {
  const auto& points = branch.points;
  const std::size_t n = points.size();
  std::vector<bool> may(n, true);
  for (std::size_t i = 1; i + 1 < n; ++i)
    may[i] = (place_of(branch, points[i]) > place_of(branch, points[i - 1])) ==
                 (place_of(branch, points[i + 1]) > place_of(branch, points[i])) &&
             place_of(branch, points[i]) != place_of(branch, points[i - 1]) &&
             place_of(branch, points[i + 1]) != place_of(branch, points[i]);
  for (const ResponseEvent& event : branch.events)
    for (std::size_t i = event.after > 0 ? event.after - 1 : 0; i < std::min(n, event.after + 3); ++i)
      may[i] = false;
  may.front() = may.back() = true;
  return may;
}

// A part whose last point may move on, with the range of the places before that point.
struct Growing {
  Part part;
  double lowest = HUGE_VAL, highest = -HUGE_VAL;

  void go_to(const ResponseBranch& branch, std::size_t last) {
    for (; part.last < last; ++part.last) {
      const double place = place_of(branch, branch.points[part.last]);
      lowest = std::min(lowest, place);
      highest = std::max(highest, place);
    }
  }
  // Whether the last point is beyond all others, above or below.
  bool is_left(const ResponseBranch& branch) const {
    const double place = place_of(branch, branch.points[part.last]);
    return place > highest || place < lowest;
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

double place_of(const ResponseBranch& branch, const Solution& point) {
  return branch.over.empty() ? point.omega : point.over;
}

ResponsePoint in_harmonics(ResponsePoint point, const ResponseBranch& from, const ResponseBranch& to) {
  if (!point.unknowns.empty())
    point.unknowns = unknowns_in_harmonics(point.unknowns, harmonics_of(from), harmonics_of(to));
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
  const auto needs_more = [&](const Solution& point) {
    return point.truncation_flagged || !(std::abs(point.truncation_estimate) <= allowed);
  };
  for (std::size_t i = 0; i < n; ++i) more[i] = needs_more(branch.points[i]);
  for (const ResponseEvent& event : branch.events)
    if (needs_more(event.point)) more[event.after] = more[std::min(event.after + 1, n - 1)] = true;
  const std::vector<bool> may = may_end(branch);
  std::vector<Growing> growing;
  for (std::size_t i = 0; i < n; ++i) {
    if (!more[i]) continue;
    std::size_t first = i > overlap ? i - overlap : 0;
    while (!may[first]) --first;
    if (growing.empty() || first > growing.back().part.last + points_between)
      growing.push_back({{first, first}});
    Growing& last = growing.back();
    last.go_to(branch, std::min(i + overlap, n - 1));
    while (last.part.last + 1 < n && !(may[last.part.last] && last.is_left(branch)))
      last.go_to(branch, last.part.last + 1);
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

std::optional<RefinedBranch> refined_branch(
    const ResponseBranch& branch, double accuracy,
    const std::function<std::optional<ResponseBranch>(const Part&)>& trace) {
  if (branch.status != Status::complete || branch.stop.reason != reasons::boundary) return {};
  const double largest = largest_amplitude(branch), allowed = accuracy * largest;
  const std::vector<Part> parts = parts_to_refine(branch, allowed);
  std::size_t count = 0;
  for (const Part& part : parts) count += part.last - part.first + 1;
  const auto of_all = static_cast<double>(count) / static_cast<double>(branch.points.size());
  if (parts.empty() || of_all > most_refined) return {};
  std::vector<ResponseBranch> traced;
  double change = 0;
  for (const Part& part : parts) {
    auto found = trace(part);
    if (!found) return {};
    for (const auto& [i, now] :
         {std::pair(part.first, &found->points.front()), std::pair(part.last, &found->points.back())}) {
      const ResponsePoint before = in_harmonics(branch.points[i], branch, *found);
      const bool is_inner = i > 0 && i + 1 < branch.points.size();  // there its estimate is small
      if (is_inner && point_distance(before, *now) > same_response * allowed) return {};
      change = std::max(change, std::abs(now->amplitude - before.amplitude));
    }
    change = std::max(change, std::abs(largest_amplitude(*found) - largest_amplitude(branch, part)));
    traced.push_back(std::move(*found));
  }
  return RefinedBranch{with_parts(branch, parts, std::move(traced)), change / largest};
}

}  // namespace arcslip::observables
