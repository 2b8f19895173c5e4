#include <arcslip/analyses/curves/bifurcation_curve.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/phase_resonance.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::observables {
namespace {

using continuation::Accepted;
using continuation::Monitor;
using continuation::StopReason;
using continuation::Vector;

constexpr double both_at_minus_one = 1e-3;  // two multipliers, at a resonance
constexpr double reaches[] = {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2};  // in scales, beyond an end
constexpr double jump_width = 1e-12;  // in scales: the sides of a jump
constexpr double jumps = 1e-3;        // by more, on both sides of it

Monitor kappa_monitor(const results::EventKind& kind, Eigen::Index at, double kappa, bool terminal) {
  Monitor monitor;
  monitor.name = kind;
  monitor.value = [=](const Accepted& now) { return now.u[at] - kappa; };
  monitor.terminal = terminal;
  return monitor;
}

}  // namespace

BifurcationTracer::BifurcationTracer(std::shared_ptr<const hbm::HbmProblem> problem, std::string kind,
                                     OverParameter way, const FrequencyWindow& window,
                                     std::shared_ptr<CurveSection> section, Report report,
                                     control::Control control)
    : CurveTracer(std::move(problem), std::move(way)),
      kind_(std::move(kind)),
      window_(window),
      section_(std::move(section)),
      report_(std::move(report)),
      control_(std::move(control)),
      equations_(
          continuation::test_function_zeros(problem_, model::frequency, test_functions(problem_, kind_))) {}

SpecialCurve BifurcationTracer::run(const SpecialPoint& start, int direction) {
  SpecialCurve result;
  SpecialCurveEnd& end = result.end;
  end.x = start.x;
  end.over = start.over;
  end.direction = direction;
  const auto x = start_of(start);
  if (!x) {
    end.stop.reason = StopReason::start_failed;
    end.stop.message = "its multipliers are not known";
    return result;
  }
  const Eigen::Index n = problem_->size();
  const auto record = [&](const Accepted& now, const continuation::Event* event) {
    const ResponsePoint point = observe(now);
    const bool terminal = event && ends_curve(event->monitor);
    if (event && event->monitor != window_event)
      result.events.push_back({now.arclength, {event->monitor, event->nonsmooth, event->located, point}});
    if (event && !terminal) return true;
    result.points.push_back({now.arclength, 0, point, {}, is_pair() ? now.u[n + 1] : 0});
    if (!terminal) report_(now.parameter, now.u[n]);
    return terminal || control_.keep_going();
  };
  auto options = way_.options();
  options.control = control_;
  continuation::Branch branch = continuation::trace(
      equations_, {*x, parameters(start.x, start.over), way_.index, direction}, options, monitors(), record);
  add_scene_hint(problem_->model(), parameters(start.x, start.over), branch);
  add(branch, result.solver);
  end.stop = branch.stop;
  if (branch.points.empty()) return result;
  const continuation::Point& last = branch.points.back();
  std::erase_if(result.points, [&](const auto& each) { return each.arclength > last.arclength; });
  end.x = last.u.head(n + 1);
  end.over = last.parameter;
  end.direction = last.tangent[last.tangent.size() - 1] < 0 ? -1 : 1;
  set_end(branch, end);
  return result;
}

bool BifurcationTracer::ends_curve(const std::string& event) const {
  return event == window_event ||
         (is_pair() && (event == event_kinds::resonance_1_1 || event == event_kinds::resonance_1_2));
}

void BifurcationTracer::set_end(const continuation::Branch& branch, SpecialCurveEnd& end) const {
  const continuation::StopReason reason = branch.stop.reason;
  end.closed = reason == StopReason::closed;
  if (reason == StopReason::event) {
    const std::string& by = branch.events.back().monitor;
    end.left_window = by == window_event;
    if (end.left_window) return;
    const bool half = problem_->harmonics().odd, folds = by == event_kinds::resonance_1_1;
    end.reason = &reasons::resonance;
    end.why = std::string("the pair of multipliers becomes real at ") + (folds ? "1" : "-1") +
              (half ? ", of the map over half a period" : "") + ", a resonance 1:" + (folds ? "1" : "2") +
              ": the curve ends on one of " +
              (folds  ? "folds"
               : half ? "breaks of symmetry"
                      : "period doublings");
    return;
  }
  if (is_phase()) return;
  if (reason != StopReason::step_too_small && reason != StopReason::not_evaluated) return;
  if (const auto jump = jump_beyond(branch.points.back())) {
    end.reason = &reasons::jump;
    end.why = "the multipliers jump by " + to_digits(*jump, 3) +
              ", where a phase of contact begins or ends, and none is where the bifurcation is";
  }
}

// The unknowns of the equations at a special point of a branch.
std::optional<Vector> BifurcationTracer::start_of(const SpecialPoint& start) const {
  if (!is_pair()) return start.x;
  const Eigen::Index n = problem_->size();
  const Vector p = parameters(start.x, start.over);
  const auto at = problem_->hbm_evaluator();
  StabilityAnalysis stability;
  if (at->move_to(start.x.head(n), p, continuation::Needs::residual) != continuation::Evaluated::ok ||
      !stability.move_to(*problem_, *at, p))
    return {};
  const auto kappa = kappa_of(of_map(stability, *problem_));
  if (!kappa) return {};
  Vector x(n + 2);
  x << start.x, *kappa;
  return x;
}

std::vector<Monitor> BifurcationTracer::monitors() const {
  const Eigen::Index n = problem_->size();
  std::vector<Monitor> all{turn_monitor(n), continuation::fold_monitor(), window_monitor(window_, n)};
  if (is_phase()) {
    for (Monitor& extremum : amplitude_monitors(section_)) all.push_back(std::move(extremum));
    return all;
  }
  if (is_pair()) {
    all.push_back(kappa_monitor(event_kinds::resonance_1_1, n + 1, 1, true));
    all.push_back(kappa_monitor(event_kinds::resonance_1_2, n + 1, -1, true));
    all.push_back(kappa_monitor(event_kinds::resonance_1_3, n + 1, -0.5, false));
    all.push_back(kappa_monitor(event_kinds::resonance_1_4, n + 1, 0, false));
    return all;
  }
  // Where a second multiplier is -1, too: their sum is smooth there.
  const auto nearest = [this](const Accepted& now) {
    const StabilityAnalysis* found = section_->stability(now);
    return nearest_two(found ? of_map(*found, *problem_) : Multipliers{}, -1);
  };
  Monitor both;
  both.name = event_kinds::resonance_1_2;
  both.value = [=](const Accepted& now) {
    const auto two = nearest(now);
    return (2.0 + two[0] + two[1]).real();
  };
  both.is_event = [=](const Accepted& now) { return std::abs(1.0 + nearest(now)[1]) < both_at_minus_one; };
  all.push_back(std::move(both));
  return all;
}

bool BifurcationTracer::is_pair() const {
  return kind_ == event_kinds::neimark_sacker;
}

bool BifurcationTracer::is_phase() const {
  return kind_ == event_kinds::phase_resonance;
}

ResponsePoint BifurcationTracer::observe(const Accepted& now) {
  ResponsePoint point = section_->observe(now, PointCondition::parameter);
  if (point.stability && !is_phase())
    set_apart(kind_, problem_->harmonics().odd, is_pair() ? now.u[problem_->size() + 1] : 0,
              *point.stability);
  return point;
}

// By how much the multipliers change at once, just beyond the end of a curve, between two solutions on both
// sides of a change of the contacts. Nothing: they do not.
std::optional<double> BifurcationTracer::jump_beyond(const continuation::Point& last) const {
  const Eigen::Index n = problem_->size();
  const auto at = problem_->hbm_evaluator();
  StabilityAnalysis stability;
  struct Side {
    std::uint64_t piece;
    Multipliers multipliers;
  };
  const auto look = [&](double reach) -> std::optional<Side> {
    const Vector x = last.u.head(n + 1) + reach * last.tangent.head(n + 1);
    const Vector p = parameters(x, last.parameter + reach * last.tangent[last.tangent.size() - 1]);
    const auto u = hbm::response_near(*problem_, p, x.head(n));
    if (!u || at->move_to(*u, p, continuation::Needs::residual) != continuation::Evaluated::ok ||
        !stability.move_to(*problem_, *at, p))
      return {};
    return Side{at->piece(), stability.multipliers()};
  };
  auto before = look(0);
  if (!before) return {};
  double from = 0;
  for (const double reach : reaches) {
    auto beyond = look(reach);
    if (!beyond) return {};
    if (beyond->piece == before->piece) {
      from = reach;
      before = std::move(beyond);
      continue;
    }
    for (double to = reach; to - from > jump_width;) {
      const double middle = 0.5 * (from + to);
      if (!(middle > from && middle < to)) break;
      auto between = look(middle);
      if (!between) return {};
      const bool is_before = between->piece == before->piece;
      (is_before ? from : to) = middle;
      (is_before ? before : beyond) = std::move(between);
    }
    const double change = std::max(distance(before->multipliers, beyond->multipliers),
                                   distance(beyond->multipliers, before->multipliers));
    if (change > jumps) return change;
    return {};
  }
  return {};
}

bool BifurcationTracer::passes(const SpecialCurve& curve, const SpecialPoint& through) const {
  const Eigen::Index n = problem_->size();
  const auto lies_on = [&](const SpecialCurve::At& a, const SpecialCurve::At& b, const Vector& guess,
                           const Vector& row) {
    const Eigen::Index size = equations_->size();
    Vector x(size), border = Vector::Zero(size + 1);
    x.head(n + 1) = guess.head(n + 1);
    if (is_pair()) x[n + 1] = 0.5 * (a.kappa + b.kappa);
    border.head(n + 1) = row.head(n + 1);
    border[size] = row[n + 1];
    const auto v = corrected(*equations_, x, guess[n + 1], border, HUGE_VAL);
    return v && is_at(*v, through);
  };
  return passage(curve, curve.points.size(), through, lies_on) > 0;
}

}  // namespace arcslip::observables
