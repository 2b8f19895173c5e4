#include <arcslip/observables/special_points.hpp>

#include <arcslip/observables/curve_parts.hpp>
#include <arcslip/observables/event_kinds.hpp>
#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/observables/observe.hpp>
#include <arcslip/observables/reasons.hpp>
#include <arcslip/observables/study_branches.hpp>
#include <arcslip/observables/unbounded.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::observables {
namespace {

using continuation::Accepted;
using continuation::StopReason;
using continuation::Vector;

void add(const ResponsePoint& point, LookedAt& to) {
  if (point.unbounded) return;
  to.amplitude = std::max(to.amplitude, point.amplitude);
  to.estimate = std::fmax(to.estimate, std::abs(point.truncation_estimate));
  to.flagged = to.flagged || point.truncation_flagged;
}

bool others_leave_at(const std::string& kind) {
  return kind == event_kinds::symmetry_breaking || kind == event_kinds::period_doubling ||
         kind == event_kinds::branch_point;
}

// From a place to the next pole, or to the end of the window. Returns where the branch goes on beyond that
// pole, or the end of the window that it reached.
BeyondPole add_points(const std::shared_ptr<const model::Model>& model, double over, const BeyondPole& place,
                      int direction, const FrequencyWindow& window, const std::vector<std::string>& kinds,
                      const GoOn& go_on, SpecialPoints& found) {
  const double from = place.starts.front();
  if (const auto growth = unbounded_resonance(model, from); growth.unbounded) {
    found.unbounded = growth.message;
    return beyond_pole_at_start(from, window.upper - window.lower);
  }
  const std::size_t before = found.points.size();
  PoleWatch watch(window.lower, window.upper);
  const bool stability = std::any_of(kinds.begin(), kinds.end(), is_bifurcation);
  const auto record = [&](Observer& observer, const Accepted& now, const continuation::Event* event) {
    if (event) {
      if (stability && others_leave_at(event->monitor))
        found.leaving.push_back({event->monitor, event->point.parameter});
      if (std::find(kinds.begin(), kinds.end(), event->monitor) == kinds.end()) return true;
      const ResponsePoint point = observer.observe(now);
      if (event->monitor == event_kinds::peak && is_rounding(point)) return true;
      Vector x(now.u.size() + 1);
      x << now.u, now.parameter;
      found.points.push_back({{}, over, std::move(x), event->nonsmooth, event->monitor, point.amplitude});
      return true;
    }
    if (stability) add(observer.observe(now), found.looked_at);
    return !watch.is_next_to_pole(observer.problem(), now.p, now.u);
  };
  const bool phase = std::find(kinds.begin(), kinds.end(), event_kinds::phase_resonance) != kinds.end();
  const auto swept = frequency_branch(model, window, from, record, direction, Steps::curve, go_on,
                                      {.stability = stability, .phase = phase, .branch_points = stability},
                                      place.displacement);
  if (swept.branch.stop.reason == StopReason::start_failed && place.starts.size() > 1) {
    const BeyondPole farther{{place.starts.begin() + 1, place.starts.end()}, place.displacement};
    return add_points(model, over, farther, direction, window, kinds, go_on, found);
  }
  found.unknown_stability = swept.unknown_stability;
  for (std::size_t i = before; i < found.points.size(); ++i) found.points[i].problem = swept.problem;
  if (watch.growth().unbounded) {
    found.unbounded = watch.growth().message;
    return watch.beyond();
  }
  if (swept.branch.stop.reason == StopReason::boundary) return {{swept.branch.stop.value}};
  found.failure = swept.branch.stop.message;
  return {{window.upper}};
}

}  // namespace

SpecialPoints special_points(const OverParameter& way, double over, const FrequencyWindow& window,
                             const std::vector<std::string>& kinds, const GoOn& go_on) {
  SpecialPoints found;
  const auto model = way.at(over);
  BeyondPole from{{window.lower}};
  bool turned_back = false;
  for (int piece = 0; piece <= 2 * model->dofs && from.starts.front() < window.upper && !turned_back;
       ++piece) {
    BeyondPole reached = add_points(model, over, from, 1, window, kinds, go_on, found);
    turned_back = reached.starts.front() <= from.starts.front();
    from = std::move(reached);
  }
  // Responses above the fold at which it turned back are on another branch, or reached from above.
  if (turned_back) add_points(model, over, {{window.upper}}, -1, window, kinds, go_on, found);
  return found;
}

SpecialPoints special_points_of_all(const OverParameter& way, double over, const FrequencyWindow& window,
                                    const std::vector<std::string>& kinds, const BranchLimits& limits,
                                    scene::FrequencyUnit unit, const ProgressCallback& progress) {
  const double per_unit = scene::to_rad_per_s(unit);
  FrequencyRange range{window.lower / per_unit, window.upper / per_unit};
  range.branches = Branches::all;
  range.limits = limits;
  const auto all = traced_branches(way.at(over), unit, range, Steps::events, progress);
  SpecialPoints found;
  found.branches = static_cast<int>(all.size());
  for (const TracedBranch& branch : all) {
    const ResponseBranch& response = branch.response;
    for (const ResponsePoint& point : response.points) add(point, found.looked_at);
    for (const ResponseEvent& event : response.events) add(event.point, found.looked_at);
    for (const ResponseEvent& event : response.events) {
      if (std::find(kinds.begin(), kinds.end(), event.kind) == kinds.end()) continue;
      const auto n = static_cast<Eigen::Index>(event.point.unknowns.size());
      Vector x(n + 1);
      x << Eigen::Map<const Vector>(event.point.unknowns.data(), n), event.point.omega;
      found.points.push_back(
          {branch.problem, over, std::move(x), event.nonsmooth, event.kind, event.point.amplitude});
    }
    if (found.unknown_stability.empty()) found.unknown_stability = response.unknown_stability;
    if (found.failure.empty() && response.status == Status::failed) found.failure = response.stop.message;
    if (response.stop.reason == reasons::unbounded) found.unbounded = response.stop.message;
    found.untraced.insert(found.untraced.end(), response.untraced.begin(), response.untraced.end());
  }
  return found;
}

}  // namespace arcslip::observables
