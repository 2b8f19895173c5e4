#include <arcslip/observables/special_curve.hpp>

#include <arcslip/observables/unbounded.hpp>

#include <arcslip/continuation/corrector.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::observables {
namespace {

using continuation::Accepted;
using continuation::Monitor;
using continuation::StopReason;
using continuation::Vector;

constexpr double beyond_display = 1e6;  // |u| in scales: where it is asked whether the response is bounded
constexpr double grown = 1e5;   // |u| in scales: where it is asked whether a response just ahead is unbounded
constexpr double ahead = 1e-2;  // of the parameter
constexpr const char* window_event = "window";
constexpr const char* fold_event = "fold";
constexpr const char* stick_event = "stick";  // the slope vanishes on this side of a corner
constexpr const char* slip_event = "slip";
constexpr double near_corner = 1e-3;    // relative: where a corner is looked for
constexpr double beside_corner = 1e-6;  // of the parameter: from one part of the curve to the next
constexpr double least_departure =
    1e-2;  // of a smooth part from the corner, relative to the parameter's change
constexpr int most_parts = 64;

Monitor window_monitor(const FrequencyWindow& window) {
  Monitor monitor;
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

SpecialKind peak_kind(const std::shared_ptr<const hbm::HbmProblem>& problem) {
  return {"peak", amplitude_quantity(problem), true};
}

SpecialKind fold_kind() {
  SpecialKind kind;
  kind.event = "fold";
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
                                       std::shared_ptr<CurveSection> section, Progress progress)
    : problem_(std::move(problem)),
      kind_(std::move(kind)),
      way_(std::move(way)),
      window_(window),
      smooth_monitors_(std::move(smooth_monitors)),
      corner_monitors_(std::move(corner_monitors)),
      section_(std::move(section)),
      progress_(std::move(progress)),
      smooth_(continuation::stationary_points(problem_, model::frequency, kind_.quantity)) {}

SpecialCurve SpecialCurveTracer::run(const SpecialPoint& start) {
  Place at{start.x, way_.from, way_.direction()};
  if (start.nonsmooth) {
    const auto corner = to_corner(at);
    if (!corner) {
      result_.stop.reason = StopReason::start_failed;
      result_.stop.message = "it is a corner of the response, but not one where an element begins to slip";
      return std::move(result_);
    }
    at = *corner;
  }
  for (int part = 0; part < most_parts; ++part) {
    const continuation::Branch branch = trace(at);
    result_.stop = branch.stop;
    if (branch.points.empty()) break;
    const continuation::Point& last = branch.points.back();
    result_.end = last.u;
    const bool leaves = branch.stop.reason == StopReason::event;
    const std::string by = leaves ? branch.events.back().monitor : "";
    const bool passes = leaves ? by == stick_event || by == slip_event
                               : at.element < 0 && branch.stop.reason == StopReason::step_too_small;
    result_.left_window = by == window_event;
    result_.vanishes = by == fold_event;
    if (!passes) break;
    const double before = last.tangent[last.tangent.size() - 1];
    const Place end{last.u, last.parameter, before < 0 ? -1 : 1, at.element};
    const auto next = leaves ? from_corner(end, by == slip_event) : to_corner(end);
    if (!next) break;
    result_.events.push_back({arclength_, {"corner", true, true, result_.points.back().point}});
    at = *next;
  }
  std::stable_sort(result_.events.begin(), result_.events.end(),
                   [](const auto& a, const auto& b) { return a.arclength < b.arclength; });
  return std::move(result_);
}

continuation::Branch SpecialCurveTracer::trace(const Place& from) {
  const bool corner = from.element >= 0;
  auto monitors = corner ? corner_monitors_ : smooth_monitors_;
  monitors.push_back(window_monitor(window_));
  if (corner) {
    // Where the curve turns, the branch over the frequency touches the corner.
    monitors.push_back(continuation::fold_monitor());
    monitors.back().terminal = true;
    const auto slopes = std::make_shared<hbm::Corner>(problem_, from.element, kind_.quantity);
    const auto add = [&](const char* name, double hbm::CornerSlopes::*side) {
      Monitor monitor;
      monitor.name = name;
      monitor.value = [=](const Accepted& now) { return slopes->slopes(now.u, now.p).*side; };
      monitor.terminal = true;
      monitors.push_back(std::move(monitor));
    };
    add(stick_event, &hbm::CornerSlopes::stick);
    add(slip_event, &hbm::CornerSlopes::slip);
  }
  const auto second = continuation::cusp_monitor().value;
  const double begin = arclength_;
  bool first = begin > 0;  // of a further part: its first point is where the part before ended
  const auto record = [&](const Accepted& now, const continuation::Event* event) {
    const double arclength = begin + now.arclength;
    const bool terminal = event && (event->monitor == window_event || event->monitor == stick_event ||
                                    event->monitor == slip_event || (corner && event->monitor == fold_event));
    if (event && (!terminal || event->monitor == fold_event)) {
      result_.events.push_back(
          {arclength, {event->monitor, event->nonsmooth, event->located, section_->observe(now)}});
      return true;
    }
    if (std::exchange(first, false)) return true;
    result_.points.push_back({arclength, corner ? 0 : second(now), section_->observe(now)});
    if (terminal) return true;
    const double omega = now.u[now.u.size() - 1];
    if (now.u.head(problem_->size()).norm() > grown * problem_->displacement()) {
      Vector p = parameters(now.u, now.parameter);
      p[way_.index] *= 1 + (now.tangent[now.u.size()] < 0 ? -ahead : ahead);
      if (const auto growth = unboundedness(*problem_, p, now.u.head(problem_->size())); growth.unbounded) {
        result_.unbounded = growth.message;
        return false;
      }
    }
    return progress_(now.parameter, omega);
  };
  continuation::Branch branch =
      continuation::trace(corner ? hbm::stick_limit_points(problem_, from.element) : smooth_,
                          {from.x, parameters(from.x, from.over), way_.index, from.direction}, way_.options(),
                          std::move(monitors), record);
  if (!branch.points.empty()) {  // what was seen beyond a terminal event is none of it
    arclength_ = begin + branch.points.back().arclength;
    const auto beyond = [&](const auto& each) { return each.arclength > arclength_; };
    std::erase_if(result_.events, beyond);
    std::erase_if(result_.points, beyond);
  }
  auto& counts = result_.counts;
  counts.points += branch.counts.points;
  counts.rejected_steps += branch.counts.rejected_steps;
  counts.residuals += branch.counts.residuals;
  counts.jacobians += branch.counts.jacobians;
  counts.factorizations += branch.counts.factorizations;
  counts.solves += branch.counts.solves;
  return branch;
}

Vector SpecialCurveTracer::parameters(const Vector& x, double over) const {
  Vector p = hbm::parameters_at(*problem_, x[x.size() - 1]);
  p[way_.index] = over;
  return p;
}

std::optional<Vector> SpecialCurveTracer::corrected(const continuation::Problem& problem, const Vector& x,
                                                    double over) const {
  continuation::Counts counts;
  continuation::Corrector corrector(problem, parameters(x, over), way_.index, {}, counts);
  const Eigen::Index n = x.size();
  Vector v(n + 1);
  v << x, over;
  if (!corrector.correct(v, Vector::Unit(n + 1, n), false).converged) return {};
  if ((v.head(n) - x).cwiseQuotient(smooth_->scales()).norm() >
      near_corner * (1 + x.cwiseQuotient(smooth_->scales()).norm()))
    return {};
  return v.head(n);
}

// (k_d (max w - min w)/2 - mu F_n) / (mu F_n)
double SpecialCurveTracer::excess(int element, const Vector& x, double over) const {
  hbm::StickLimit limit(*problem_, element);
  Vector dh(problem_->size());
  const auto h = limit.at(x.head(problem_->size()), parameters(x, over), dh);
  return h && limit.limit() > 0 ? *h / limit.limit() : HUGE_VAL;
}

bool SpecialCurveTracer::is_special(int element, const Vector& x, double over) {
  const auto slopes = hbm::Corner(problem_, element, kind_.quantity).slopes(x, parameters(x, over));
  return kind_.maximum ? slopes.is_maximum() : slopes.is_extreme();
}

// The corner beside a place, and which way it is special.
std::optional<SpecialCurveTracer::Place> SpecialCurveTracer::to_corner(const Place& at) {
  const auto& elements = problem_->model().elements;
  for (int e = 0; e < static_cast<int>(elements.size()); ++e) {
    if (elements[static_cast<std::size_t>(e)].law != model::Law::jenkins) continue;
    if (!(std::abs(excess(e, at.x, at.over)) < near_corner)) continue;
    const auto corner = hbm::stick_limit_points(problem_, e);
    for (const int direction : {at.direction, -at.direction}) {
      const double over = at.over * (1 + direction * beside_corner);
      if (!inside(over)) continue;
      const auto x = corrected(*corner, at.x, over);
      if (x && is_special(e, *x, over)) return Place{*x, over, direction, e};
    }
  }
  return {};
}

// The smooth curve that begins where the slope vanishes on one side of a corner.
std::optional<SpecialCurveTracer::Place> SpecialCurveTracer::from_corner(const Place& at, bool slip) {
  const Eigen::Index n = problem_->size();
  hbm::StickLimit limit(*problem_, at.element);
  Vector dh(n), guess = at.x;
  if (!limit.at(at.x.head(n), parameters(at.x, at.over), dh)) return {};
  dh *= (slip ? 1 : -1) * limit.limit() / dh.squaredNorm();
  for (const double beside : {1.0, 10.0, 100.0, 1000.0})
    for (const int direction : {at.direction, -at.direction}) {
      const double over = at.over * (1 + direction * beside * beside_corner);
      if (!inside(over)) continue;
      guess.head(n) = at.x.head(n) + beside * beside_corner * dh;
      const auto x = corrected(*smooth_, guess, over);
      // Away from the corner as the parameter goes on, not along it.
      if (x && (slip ? 1 : -1) * excess(at.element, *x, over) > least_departure * beside * beside_corner)
        return Place{*x, over, direction};
    }
  return {};
}

}  // namespace arcslip::observables
