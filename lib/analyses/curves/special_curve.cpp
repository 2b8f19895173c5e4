#include <arcslip/analyses/curves/special_curve.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/unbounded_resonance.hpp>
#include <arcslip/analyses/curves/special_curve_results.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/results/event_kinds.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::observables {
namespace {

using continuation::Accepted;
using continuation::Monitor;
using continuation::StopReason;
using continuation::Vector;

constexpr double grown_size =
    1e5;  // |u| in scales: where it is asked whether a response just ahead is unbounded
constexpr double look_ahead = 1e-2;           // of the parameter
constexpr const char* below_event = "below";  // the slope vanishes on this side of a corner
constexpr const char* above_event = "above";
constexpr int most_curve_parts = 64;  // smooth ones and corners, of one curve

}  // namespace

Monitor window_monitor(const FrequencyWindow& window, Eigen::Index n) {
  Monitor monitor;
  monitor.name = window_event;
  monitor.value = [window, n](const Accepted& now) {
    const double omega = now.u[n], width = window.upper - window.lower;
    return std::min(omega - window.lower, window.upper - omega) / width;
  };
  monitor.terminal = true;
  return monitor;
}

Monitor turn_monitor(Eigen::Index n) {
  Monitor turn{event_kinds::turn, [n](const Accepted& now) { return now.tangent[n]; },
               continuation::Crossing::any, [n](const Accepted& now) { return now.u[n]; }};
  turn.divides_at_kinks = false;
  return turn;
}

SpecialKind peak_kind(const std::shared_ptr<const hbm::HbmProblem>& problem) {
  return {event_kinds::peak, amplitude_quantity(problem), true};
}

SpecialKind fold_kind() {
  SpecialKind kind;
  kind.event = event_kinds::fold;
  kind.quantity.gradient = [](continuation::Evaluator&, continuation::In, continuation::In,
                              continuation::Out dq) { dq.setZero(); };
  kind.quantity.parameter_derivative = [](continuation::Evaluator&, continuation::In, continuation::In,
                                          int k) { return k == model::frequency ? 1.0 : 0.0; };
  return kind;
}

SpecialCurveTracer::SpecialCurveTracer(std::shared_ptr<const hbm::HbmProblem> problem, SpecialKind kind,
                                       OverParameter way, const FrequencyWindow& window,
                                       std::vector<Monitor> smooth_monitors,
                                       std::vector<Monitor> corner_monitors,
                                       std::shared_ptr<CurveSection> section, Report report,
                                       control::Control control)
    : CurveTracer(std::move(problem), std::move(way)),
      kind_(std::move(kind)),
      window_(window),
      smooth_monitors_(std::move(smooth_monitors)),
      corner_monitors_(std::move(corner_monitors)),
      section_(std::move(section)),
      report_(std::move(report)),
      control_(std::move(control)),
      smooth_(continuation::stationary_points(problem_, model::frequency, kind_.quantity)) {}

SpecialCurve SpecialCurveTracer::run(const SpecialPoint& start, int direction) {
  result_ = {};
  arclength_ = 0;
  SpecialCurveEnd& end = result_.end;
  CurveStart at{start.x, start.over, direction, {}};
  end.x = at.x;
  end.over = at.over;
  end.direction = direction;
  if (start.nonsmooth) {
    const auto corner = to_corner(at);
    if (!corner) {
      end.stop.reason = StopReason::start_failed;
      end.stop.message = "it is a kink of the response, but not at slip onset";
      return std::move(result_);
    }
    at = *corner;
  }
  for (int part = 0; part < most_curve_parts; ++part) {
    const std::size_t before_part = result_.points.size();
    const continuation::Branch branch = trace(at);
    end.stop = branch.stop;
    end.closed = part == 0 && branch.stop.reason == StopReason::closed;
    if (branch.points.empty() || end.closed || comes_back(before_part)) break;
    const auto next = part_beyond(branch, at.corner);
    if (!next) break;
    result_.events.push_back({arclength_, {event_kinds::corner, true, true, result_.points.back().point}});
    if (next->direction != end.direction) result_.turns.push_back(arclength_);
    at = *next;
  }
  std::stable_sort(result_.events.begin(), result_.events.end(),
                   [](const auto& a, const auto& b) { return a.arclength < b.arclength; });
  return std::move(result_);
}

// Ends the curve where a part of it ends, and returns the start of the next one, if it continues.
std::optional<SpecialCurveTracer::CurveStart> SpecialCurveTracer::part_beyond(
    const continuation::Branch& branch, const std::optional<hbm::Corner>& corner) {
  SpecialCurveEnd& end = result_.end;
  const continuation::Point& last = branch.points.back();
  end.x = last.u.head(problem_->size() + 1);
  end.over = last.parameter;
  end.direction = last.tangent[last.tangent.size() - 1] < 0 ? -1 : 1;
  const bool leaves = branch.stop.reason == StopReason::event;
  const std::string by = leaves ? branch.events.back().monitor : "";
  end.left_window = by == window_event;
  end.vanishes = by == event_kinds::fold;
  const bool passes = leaves ? by == below_event || by == above_event
                             : !corner && branch.stop.reason == StopReason::step_too_small;
  if (!passes) return {};
  CurveStart place{end.x, end.over, end.direction, corner};
  if (corner) place.corner = hbm::at_angles(*corner, last.u);
  if (auto next = leaves ? leave_corner(place, by == above_event) : to_corner(place)) return next;
  if (kind_.maximum && is_surpassed(place)) end.vanishes = true;
  return end.vanishes ? std::nullopt : seen_beyond(place);
}

std::vector<Monitor> SpecialCurveTracer::monitors_from(const CurveStart& from) const {
  const bool corner = from.corner.has_value();
  auto monitors = corner ? corner_monitors_ : smooth_monitors_;
  monitors.push_back(window_monitor(window_, problem_->size()));
  if (!corner) return monitors;
  // Where the curve turns, the branch over the frequency touches the corner.
  monitors.push_back(continuation::fold_monitor());
  monitors.back().terminal = true;
  const auto slopes = std::make_shared<hbm::CornerSides>(problem_, *from.corner, kind_.quantity);
  const auto add = [&](const char* name, double hbm::CornerSlopes::* side) {
    Monitor monitor;
    monitor.name = name;
    monitor.value = [=](const Accepted& now) { return slopes->slopes(now.u, now.p).*side; };
    monitor.terminal = true;
    monitors.push_back(std::move(monitor));
  };
  add(below_event, &hbm::CornerSlopes::below);
  add(above_event, &hbm::CornerSlopes::above);
  return monitors;
}

ResponsePoint SpecialCurveTracer::observe(const Accepted& now, const CurveStart& from) {
  ResponsePoint point = section_->observe(now, from.corner     ? PointCondition::corner
                                               : kind_.maximum ? PointCondition::extremum
                                                               : PointCondition::fold);
  set_apart(kind_.event, point);
  return point;
}

// Reports why, where the response just ahead grows without bound.
bool SpecialCurveTracer::grows_ahead(const Accepted& now) {
  const Eigen::Index n = problem_->size();
  if (!(now.u.head(n).norm() > grown_size * problem_->displacement())) return false;
  Vector p = parameters(now.u, now.parameter);
  p[way_.index] *= 1 + (now.tangent[now.u.size()] < 0 ? -look_ahead : look_ahead);
  const auto growth = unboundedness(*problem_, p, now.u.head(n));
  if (growth.unbounded) result_.end.unbounded = growth.message;
  return growth.unbounded;
}

// A further part begins with the point where the part before ended, which is not recorded again.
continuation::Observer SpecialCurveTracer::recording(const CurveStart& from) {
  return [this, &from, begin = arclength_, repeated = arclength_ > 0,
          second = continuation::cusp_monitor().value](const Accepted& now,
                                                       const continuation::Event* event) mutable {
    const bool is_end = event && (event->monitor == window_event || event->monitor == below_event ||
                                  event->monitor == above_event);
    const double arclength = begin + now.arclength;
    if (event && !is_end) {
      result_.events.push_back(
          {arclength, {event->monitor, event->nonsmooth, event->located, observe(now, from)}});
      return true;
    }
    if (std::exchange(repeated, false)) return true;
    result_.points.push_back({arclength, from.corner ? 0 : second(now), observe(now, from), from.corner});
    if (from.corner) result_.points.back().corner = hbm::at_angles(*from.corner, now.u);
    if (is_end) return true;
    if (grows_ahead(now)) return false;
    report_(now.parameter, now.u[problem_->size()]);
    return control_.keep_going();
  };
}

continuation::Branch SpecialCurveTracer::trace(const CurveStart& from) {
  const double begin = arclength_;
  auto options = way_.options();
  options.control = control_;
  continuation::Branch branch =
      continuation::trace(from.corner ? hbm::corner_points(problem_, *from.corner) : smooth_,
                          {from.corner ? hbm::with_angles(from.x, *from.corner) : from.x,
                           parameters(from.x, from.over), way_.index, from.direction},
                          options, monitors_from(from), recording(from));
  add_scene_hint(problem_->model(), parameters(from.x, from.over), branch);
  if (!branch.points.empty()) {  // what was seen beyond a terminal event is none of it
    arclength_ = begin + branch.points.back().arclength;
    const auto beyond = [&](const auto& each) { return each.arclength > arclength_; };
    std::erase_if(result_.events, beyond);
    std::erase_if(result_.points, beyond);
  }
  add(branch, result_.solver);
  return branch;
}

Vector CurveTracer::parameters(const Vector& x, double over) const {
  Vector p = hbm::parameters_at(*problem_, x[problem_->size()]);
  p[way_.index] = over;
  return p;
}

}  // namespace arcslip::observables
