#include <arcslip/continuation/diagrams/branch_parts.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double empty_step = 1e-14;  // relative arclength: two points at one place
void reverse_point(Point& point) {
  point.tangent = -point.tangent;
  point.arclength = -point.arclength;
}

void reverse_event(Event& event) {
  reverse_point(event.point);
  if (auto* kink = std::get_if<Kink>(&event.data)) {
    std::swap(kink->before, kink->after);
    kink->before = -kink->before;
    kink->after = -kink->after;
  }
  if (auto* crossing = std::get_if<BranchPoint>(&event.data)) {
    for (Vector& tangent : crossing->tangents) tangent = -tangent;
    if (!simple(event)) std::swap(crossing->tangents.front(), crossing->tangents.back());
  }
}

// In the other direction a range of stability begins at its last point, which then has to say what the first
// one did where not every point has a spectrum.
void count_at_ends(Branch& branch) {
  for (const StabilityRange& range : stability_ranges(branch))
    if (auto& spectrum = branch.points[range.last].spectrum; !spectrum)
      spectrum = Spectrum{{}, range.unstable, range.complete, {}};
}

}  // namespace

Vector joined(const Vector& u, double parameter) {
  Vector v(u.size() + 1);
  v << u, parameter;
  return v;
}

bool simple(const Event& event) {
  return event.located && !event.nonsmooth;
}

void shift(Branch& branch, double arclength) {
  for (Point& point : branch.points) point.arclength += arclength;
  for (Event& event : branch.events) event.point.arclength += arclength;
}

void reverse(Branch& branch) {
  count_at_ends(branch);
  std::reverse(branch.points.begin(), branch.points.end());
  std::reverse(branch.events.begin(), branch.events.end());
  for (Point& point : branch.points) reverse_point(point);
  for (Event& event : branch.events) reverse_event(event);
}

void append(Branch& branch, Branch&& next) {
  std::move(next.points.begin(), next.points.end(), std::back_inserter(branch.points));
  std::move(next.events.begin(), next.events.end(), std::back_inserter(branch.events));
  branch.stop = std::move(next.stop);
  branch.state = std::move(next.state);
  for (std::string& warning : next.warnings)
    if (std::find(branch.warnings.begin(), branch.warnings.end(), warning) == branch.warnings.end())
      branch.warnings.push_back(std::move(warning));
  branch.counts += next.counts;
}

void number(Branch& branch) {
  for (Event& event : branch.events) {
    const auto beyond = std::upper_bound(branch.points.begin(), branch.points.end(), event.point.arclength,
                                         [](double s, const Point& point) { return s < point.arclength; });
    event.after = static_cast<std::size_t>(std::max<std::ptrdiff_t>(beyond - branch.points.begin(), 1) - 1);
  }
}

void drop_empty_step(Branch& branch) {
  auto& points = branch.points;
  if (points.size() < 2) return;
  const auto last = points.end() - 1;
  if (last->arclength - (last - 1)->arclength <= empty_step * (1 + last->arclength)) points.erase(last - 1);
  number(branch);
}

void cut(Branch& branch, const Event& end, double miss, double reach) {
  const double s = end.point.arclength;
  while (!branch.points.empty() && branch.points.back().arclength >= s) branch.points.pop_back();
  while (!branch.events.empty() && branch.events.back().point.arclength > s) branch.events.pop_back();
  branch.points.push_back(end.point);
  branch.stop = {StopReason::closed, miss, reach,
                 "returned to the branch point it left: the branch is closed"};
}

}  // namespace arcslip::continuation
