#include <arcslip/observables/special_curve.hpp>

#include <arcslip/observables/unbounded.hpp>

#include <algorithm>
#include <utility>

namespace arcslip::observables {
namespace {

using continuation::Accepted;
using continuation::StopReason;
using continuation::Vector;

constexpr double beyond_display = 1e6;  // |u| in scales: where it is asked whether the response is bounded
constexpr const char* window_event = "window";

continuation::Monitor window_monitor(const FrequencyWindow& window) {
  continuation::Monitor monitor;
  monitor.name = window_event;
  monitor.value = [window](const Accepted& now) {
    const double omega = now.u[now.u.size() - 1], width = window.upper - window.lower;
    return std::min(omega - window.lower, window.upper - omega) / width;
  };
  monitor.terminal = true;
  return monitor;
}

}  // namespace

SpecialPoints special_points(const OverParameter& way, const FrequencyWindow& window,
                             const std::string& kind) {
  SpecialPoints found;
  if (const auto growth = unbounded_resonance(way.model, window.lower); growth.unbounded) {
    found.unbounded = true;
    found.failure = growth.message;
    return found;
  }
  const auto record = [&](Observer& observer, const Accepted& now, const continuation::Event* event) {
    if (event) {
      if (event->monitor != kind) return true;
      Vector x(now.u.size() + 1);
      x << now.u, now.parameter;
      found.points.push_back({std::move(x), event->nonsmooth});
      return true;
    }
    if (now.u.norm() <= beyond_display * observer.problem().displacement()) return true;
    const auto growth = unboundedness(observer.problem(), now.p, now.u);
    found.unbounded = growth.unbounded;
    if (growth.unbounded) found.failure = growth.message;
    return !growth.unbounded;
  };
  const auto swept = frequency_branch(way.model, window, window.lower, record);
  found.problem = swept.problem;
  if (found.failure.empty() && swept.branch.stop.reason != StopReason::boundary)
    found.failure = swept.branch.stop.message;
  return found;
}

SpecialCurve follow(const std::shared_ptr<const hbm::HbmProblem>& problem,
                    const std::shared_ptr<const continuation::Problem>& curve, const OverParameter& way,
                    const FrequencyWindow& window, const Vector& start,
                    const std::shared_ptr<CurveSection>& section, std::vector<continuation::Monitor> monitors,
                    const std::function<bool(double, double)>& progress) {
  SpecialCurve result;
  monitors.push_back(window_monitor(window));
  const auto second = continuation::cusp_monitor().value;
  const auto record = [&](const Accepted& now, const continuation::Event* event) {
    if (event) {
      if (event->monitor == window_event)
        result.points.push_back({now.arclength, second(now), section->observe(now)});
      else if (!(event->nonsmooth && event->value == 0))  // constant beyond: no extreme
        result.events.push_back(
            {now.arclength, {event->monitor, event->nonsmooth, event->located, section->observe(now)}});
      return true;
    }
    result.points.push_back({now.arclength, second(now), section->observe(now)});
    const double omega = now.u[now.u.size() - 1];
    if (now.u.norm() > beyond_display * problem->displacement()) {
      Vector p = now.p;
      p[model::frequency] = omega;
      if (const auto growth = unboundedness(*problem, p, now.u.head(problem->size())); growth.unbounded) {
        result.unbounded = growth.message;
        return false;
      }
    }
    return progress(now.parameter, omega);
  };
  const Vector p = hbm::parameters_at(*problem, start[start.size() - 1]);
  continuation::Branch branch = continuation::trace(curve, {start, p, way.index, way.direction()},
                                                    way.options(), std::move(monitors), record);
  result.left_window = branch.stop.reason == StopReason::event;
  if (!branch.points.empty()) result.end = branch.points.back().u;
  branch.points.clear();
  std::stable_sort(result.events.begin(), result.events.end(),
                   [](const auto& a, const auto& b) { return a.arclength < b.arclength; });
  result.branch = std::move(branch);
  return result;
}

}  // namespace arcslip::observables
