#include <arcslip/analyses/branches/stop_reason.hpp>
#include <arcslip/optimize/curve/curve_of_optima.hpp>
#include <arcslip/optimize/evaluation/reasons.hpp>
#include <arcslip/optimize/peaks/peak_unknowns.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <utility>

namespace arcslip::optimize {
namespace {

using continuation::Accepted;
using continuation::Event;
using continuation::Monitor;
using continuation::StopReason;
using observables::Status;
using Kind = Inequality::Kind;

constexpr double nearly_as_high = 1e-3;  // relative: peaks that may be active at the first optimum
constexpr double nearly_bound = 1e-6;    // of y
constexpr int most_exchanges = 20;       // of the active set at the first optimum
constexpr double flat_slope = 1e-5;      // d ln A / dsigma of less: an extreme over s
constexpr double smallest_step = 1e-8;   // relative to 1 + |z|: the equations hold to 1e-11
constexpr double same_point = 1e-9;      // of y and sigma

// Of the monitor of an inequality that may change.
std::string change_name(std::size_t i) {
  return text("change ", i);
}

bool is_change(const Event& event) {
  return event.monitor != event_kinds::minimum && event.monitor != event_kinds::maximum &&
         event.monitor != event_kinds::turning_point;
}

std::vector<KnownPeak> peaks_of(const OptimumPoint& point) {
  std::vector<KnownPeak> all;
  for (const OptimumPeak& peak : point.peaks) all.push_back({peak.kind, peak.omega, point.amplitude});
  return all;
}

// The one of `count` inequalities that ended a piece; count: another peak joins. An extremum or a turn may
// follow at the same point.
std::size_t last_change(const continuation::Branch& branch, std::size_t count) {
  const auto last = std::find_if(branch.events.rbegin(), branch.events.rend(), is_change);
  std::size_t i = 0;
  while (i < count && last->monitor != change_name(i)) ++i;
  return i;
}

}  // namespace

CurveOfOptima::CurveOfOptima(const scene::Scene& scene, const OptimumProblem& problem,
                             const DesignVariable& along, const OptimumCurveOptions& options)
    : scene_(scene),
      problem_(problem),
      along_(along),
      options_(options),
      control_(options.search.control.until(options.seconds)),
      space_(scene, with_along(problem, along)),
      unit_(scene::to_rad_per_s(scene.frequency_unit)),
      peaks_(space_.model(), space_.parameters(),
             {problem.frequency_from * unit_, problem.frequency_to * unit_},
             control_.child({.grace = grace})) {
  scaled_ = space_.scales();
  curve_.along = along.name;
  if (!(options.points >= 1)) throw OptionsError(text("points is ", options.points, ", must be >= 1"));
  if (!(options.seconds >= 0)) throw OptionsError(text("seconds is ", options.seconds, ", must be >= 0"));
  if (!(options.step > 0 && options.step <= 1))
    throw OptionsError(text("step is ", options.step, ", must be > 0 and <= 1"));
}

OptimumCurve CurveOfOptima::run() {
  try {
    if (begin())
      while (!ended_) {
        piece();
        if (!ended_) guard();
      }
  } catch (const Interrupted&) {
    end_interrupted();
  } catch (const std::exception& thrown) {
    end(Status::failed, reasons::objective_failed,
        text("an evaluation threw \"", thrown.what(), "\" at ", place(here_.sigma)));
  }
  if (curve_.status == Status::complete) check_window();
  finish();
  return std::move(curve_);
}

OptimumProblem CurveOfOptima::with_along(OptimumProblem problem, const DesignVariable& along) {
  if (!problem.cases.empty() || !problem.scatter.empty())
    throw OptionsError("an optimum over several cases cannot be continued over \"" + along.name +
                       "\"; omit the cases, or optimize at single values of it");
  if (!problem.limits.empty() || !problem.linear_limits.empty())
    throw OptionsError("an optimum with limits cannot be continued over \"" + along.name +
                       "\"; omit the limits, or optimize at single values of it");
  problem.over.push_back(along);
  return problem;
}

bool CurveOfOptima::end(Status status, const results::Reason& reason, std::string message) {
  curve_.status = status;
  curve_.stop.reason = reason;
  curve_.stop.message = std::move(message);
  ended_ = true;
  return false;
}

bool CurveOfOptima::end_interrupted() {
  const observables::Stop why = interruption(control_, phase_);
  return end(Status::stopped, why.reason,
             why.message + (curve_.points.empty() ? "" : " at " + place(here_.sigma)));
}

bool CurveOfOptima::begin() {
  scene::Scene at = scene_;
  scene::set(at, along_.name, along_.lower);
  OptimumOptions search = options_.search;
  search.certificate = false;
  search.control = control_;
  curve_.start = optimum(at, problem_, search);
  if (!control_.keep_going()) return end_interrupted();
  phase_ = "the curve";
  const Optimum& first = curve_.start;
  const std::string where = text("at ", along_.name, " = ", along_.lower, ": ");
  const bool found = first.status == Status::complete || first.stop.reason == reasons::end_of_window;
  if (!found || first.stop.reason == reasons::flat || first.design.empty())
    return end(first.status == Status::complete ? Status::failed : first.status, first.stop.reason,
               where + first.stop.message);
  std::vector<double> design = first.design;
  design.push_back(along_.lower);
  const PeakState& state = peaks_.trace(design);
  if (state.peaks.empty() || !state.complete)
    return end(Status::failed, reasons::no_response, where + state.message);
  reference_ = state.amplitude();
  here_.sigma = sigma().scaled(along_.lower);
  here_.active.held.assign(size(), 0);
  for (std::size_t i = 0; i < state.peaks.size(); ++i)
    if (state.peaks[i].amplitude >= (1 - nearly_as_high) * reference_ && !state.peaks[i].rises_inwards())
      here_.active.peaks.push_back(i);
  for (std::size_t k = 0; k < size(); ++k)
    for (const int side : {-1, 1})
      if (side * (scaled_[k].scaled(scaled_[k].bound(side)) - scaled_[k].scaled(design[k])) < nearly_bound)
        here_.active.held[k] = side;
  if (!hold_flat(design))
    return end(Status::failed, reasons::flat,
               text(where, "the amplitude does not depend on ", flat_,
                    " there, but does elsewhere within its bounds: the optimum to continue is not unique"));
  return settle(design);
}

bool CurveOfOptima::hold_flat(std::vector<double>& design) {
  const auto result = setting().hold_flat(here_.active, design);
  for (const auto& [k, value] : result.moved)
    curve_.notes.push_back(text("at ", place(here_.sigma), " ", problem_.over[k].name, " = ", value,
                                " has no influence, and was moved to its bound ", design[k]));
  if (result.flat) flat_ = problem_.over[*result.flat].name;
  return !result.flat;
}

bool CurveOfOptima::settle(const std::vector<double>& design) {
  for (int k = 0; k < most_exchanges; ++k) {
    if (!peaks_.follow_to(design, here_.active.peaks)) break;
    Vector weights;
    here_.z = setting().estimate(here_.active, weights);
    OptimalityEvaluator at(data());
    if (!here_.correct(at)) {
      auto& peaks = here_.active.peaks;
      if (peaks.size() < 2) break;
      peaks.erase(peaks.begin() + (std::min_element(weights.begin(), weights.end()) - weights.begin()));
      continue;
    }
    if (exchange(here_.active, at)) continue;
    here_.take(at);
    curve_.points.push_back(point(at));
    set_safe();
    return true;
  }
  return end(Status::failed, reasons::no_exchange,
             text("at ", along_.name, " = ", along_.lower,
                  ": the optimum was found, but no set of equally high peaks satisfies its equations; it may "
                  "be at a kink, or a parameter may have no influence"));
}

const OptimalityEvaluator& CurveOfOptima::evaluator(const Accepted& now) {
  return static_cast<const OptimalityEvaluator&>(now.at);
}

OptimumPoint CurveOfOptima::point(const OptimalityEvaluator& at) {
  OptimumPoint p;
  p.along = at.design().back();
  p.design.assign(at.design().begin(), at.design().end() - 1);
  p.amplitude = reference_ * std::exp(at.level());
  for (std::size_t i = 0; i < at.active_peaks().size(); ++i)
    p.peaks.push_back({at.active_peaks()[i].kind, at.active_peaks()[i].omega(),
                       at.weights()[static_cast<Eigen::Index>(i)]});
  Eigen::Index heaviest = 0;
  at.weights().maxCoeff(&heaviest);
  p.response = peaks_.observe(at.active_peaks()[static_cast<std::size_t>(heaviest)]);
  p.at_bound = here_.active.held;
  p.minimum = at.is_minimum();
  return p;
}

// An inequality of the active set that changes, or another peak that joins, ends the piece.
std::vector<Monitor> CurveOfOptima::monitors(const std::vector<Inequality>& may_change) const {
  using continuation::Crossing;
  std::vector<Monitor> all;
  for (std::size_t i = 0; i < may_change.size(); ++i)
    all.push_back(
        {.name = change_name(i),
         .value = [each = may_change[i]](const Accepted& now) { return evaluator(now).slack(each); },
         .crossing = Crossing::falling,
         .terminal = true});
  all.push_back({.name = event_kinds::peak_joins,
                 .value = [](const Accepted& now) { return evaluator(now).distance_of_others(); },
                 .crossing = Crossing::falling,
                 .terminal = true});
  const Eigen::Index tau = here_.active.unknowns() - 1;
  const auto slope = [tau](const Accepted& now) { return now.tangent[tau]; };
  const auto level = [tau](const Accepted& now) { return now.u[tau]; };
  all.push_back(
      {.name = event_kinds::minimum, .value = slope, .crossing = Crossing::rising, .quantity = level});
  all.push_back(
      {.name = event_kinds::maximum, .value = slope, .crossing = Crossing::falling, .quantity = level});
  all.push_back(continuation::fold_monitor());
  all.back().name = event_kinds::turning_point;
  return all;
}

continuation::Options CurveOfOptima::trace_options() {
  continuation::Options options;
  options.lower = sigma().scaled(along_.lower);
  options.upper = sigma().scaled(along_.upper);
  options.check_jacobian = false;
  options.step.largest_parameter = options_.step * (options.upper - options.lower);
  options.step.initial = step_;
  options.step.smallest = smallest_step;
  options.points = std::max<long>(1, options_.points - static_cast<long>(curve_.points.size()) + 1);
  options.control = control_;
  return options;
}

CurveOfOptima::Piece CurveOfOptima::trace_piece() {
  Piece piece;
  piece.may_change = inequalities(here_.active);
  std::exception_ptr thrown;
  const auto observe = [&](const Accepted& now, const Event*) {
    ActiveSetPoint there = here_;
    there.tangent = now.tangent;
    there.orient(evaluator(now));
    Seen& seen = piece.seen[now.arclength];
    seen = {point(evaluator(now)), evaluator(now).slope_along(), there.orientation};
    try {
      if (options_.progress) options_.progress(seen.point);
    } catch (...) {
      thrown = std::current_exception();
      return false;
    }
    piece.response_due = way_since_response(seen.point) >= interval_;
    return !piece.response_due && control_.keep_going();
  };
  const continuation::Start start{here_.z, Vector::Constant(1, here_.sigma), 0, 1, here_.tangent};
  continuation::Branch& branch = piece.branch;
  branch =
      continuation::trace(optimality(data()), start, trace_options(), monitors(piece.may_change), observe);
  end_at_u_turn(branch);
  ++curve_.work.pieces;
  curve_.work.points += branch.counts.points;
  curve_.work.evaluations += branch.counts.residuals;
  curve_.work.hessians += branch.counts.jacobians;
  keep(branch, piece.seen);
  if (thrown) std::rethrow_exception(thrown);
  return piece;
}

void CurveOfOptima::piece() {
  Piece piece = trace_piece();
  const continuation::Branch& branch = piece.branch;
  if (branch.points.empty()) return lost(branch.stop);
  const auto at = move_to_end(piece);
  if (!at) {
    end(Status::stopped, reasons::lost_peak,
        "at " + place(here_.sigma) + " a newly traced response does not have the tracked peaks");
    return;
  }
  switch (branch.stop.reason) {
    case StopReason::boundary:
      verify();
      if (!ended_ && !rewound_) end_at_boundary(branch.points.back().parameter);
      return;
    case StopReason::event:
      change(last_change(branch, piece.may_change.size()), piece.may_change, *at);
      return;
    case StopReason::user:
      if (!control_.keep_going())
        end_interrupted();
      else
        verify();
      return;
    case StopReason::step_too_small:
    case StopReason::not_evaluated:
    case StopReason::start_failed:
      lost(branch.stop);
      return;
    default:
      stop_with(branch.stop);
  }
}

// here_ becomes the end of the piece, with its equations, and the inequalities get the indices of the peaks
// there. Null if a new response does not have them.
std::unique_ptr<OptimalityEvaluator> CurveOfOptima::move_to_end(Piece& piece) {
  const auto& points = piece.branch.points;
  const auto& last = points.back();
  here_.z = last.u;
  here_.sigma = last.parameter;
  here_.tangent = last.tangent;
  if (points.size() > 1) step_ = last.arclength - points[points.size() - 2].arclength;
  const std::vector<std::size_t> indices = here_.active.peaks;
  auto at = at_last_point();
  if (!at) return nullptr;
  here_.design = at->design();
  here_.peaks = peaks_of(curve_.points.back());
  here_.orientation = std::prev(piece.seen.upper_bound(last.arclength))->second.orientation;  // of all of it
  for (Inequality& each : piece.may_change)
    if (each.kind == Kind::peak)
      each.index = here_.active.peaks[static_cast<std::size_t>(
          std::find(indices.begin(), indices.end(), each.index) - indices.begin())];
  return at;
}

// As of a single optimum, unless the first one lies there and has no resonance beyond.
void CurveOfOptima::check_window() {
  const auto at_end = [](const OptimumPoint& point) {
    return std::any_of(point.peaks.begin(), point.peaks.end(),
                       [](const OptimumPeak& peak) { return is_end(peak.kind); });
  };
  if (curve_.start.status == Status::complete && at_end(curve_.points.front())) return;
  std::size_t count = 0;
  double from = 0, to = 0;
  for (const OptimumPoint& point : curve_.points) {
    if (!at_end(point)) continue;
    if (count++ == 0) from = point.along;
    to = point.along;
  }
  if (count == 0) return;
  end(Status::stopped, reasons::end_of_window,
      text(curve_.stop.message, ", but at ", count, " of its ", curve_.points.size(), " points, from ",
           along_.name, " = ", from, " to ", to,
           ", the amplitude is largest at an end of the window, where it is no resonance "
           "peak: take a window that contains the resonance"));
}

void CurveOfOptima::end_at_boundary(double s) {
  if (s >= sigma().scaled(along_.upper))
    end(Status::complete, reasons::boundary, "the optimum was continued to " + place(s));
  else
    end(Status::stopped, reasons::turned_back,
        "the curve of optima turned back and left the range at " + place(s));
}

std::unique_ptr<OptimalityEvaluator> CurveOfOptima::at_last_point() {
  auto at = std::make_unique<OptimalityEvaluator>(data());
  const OptimumPoint& last = curve_.points.back();
  if (here_.move(*at) && at->residual().cwiseAbs().maxCoeff() <= same_level) return at;
  std::vector<double> design = last.design;
  design.push_back(last.along);
  here_.active.peaks = find_again(peaks_.trace(design), peaks_of(last), same_level);
  if (here_.active.peaks.empty()) return nullptr;
  at = std::make_unique<OptimalityEvaluator>(data());
  return here_.move(*at) ? std::move(at) : nullptr;
}

void CurveOfOptima::stop_with(const continuation::BranchStop& stop) {
  end(Status::stopped, observables::reason_of(stop.reason), "at " + place(here_.sigma) + ": " + stop.message);
}

void CurveOfOptima::end_at_u_turn(continuation::Branch& branch) {
  for (std::size_t i = 0; i < branch.events.size(); ++i) {
    const Event& event = branch.events[i];
    const std::size_t after = event.after;
    if (event.monitor != event_kinds::turning_point || !event.nonsmooth ||
        after + 1 >= branch.points.size() ||
        branch.points[after].tangent.dot(branch.points[after + 1].tangent) > u_turn)
      continue;
    branch.stop = {StopReason::step_too_small, 0, 0, "the curve turns back onto itself"};
    branch.points.resize(after + 1);
    branch.events.erase(branch.events.begin() + static_cast<std::ptrdiff_t>(i), branch.events.end());
    return;
  }
}

void CurveOfOptima::keep(const continuation::Branch& branch, const std::map<double, Seen>& seen) {
  const auto find = [&](double arclength) {
    const auto at = seen.find(arclength);
    return at == seen.end() ? nullptr : &at->second;
  };
  std::vector<std::size_t> index;
  for (const auto& each : branch.points) {
    const Seen* at = find(each.arclength);
    if (at && (curve_.points.empty() || distance(at->point, curve_.points.back()) > same_point))
      curve_.points.push_back(at->point);
    index.push_back(curve_.points.empty() ? 0 : curve_.points.size() - 1);
  }
  for (const Event& event : branch.events) {
    const Seen* at = find(event.point.arclength);
    // Along the curve the amplitude is also stationary at turning points, but not over s.
    const bool only_turns =
        event.monitor != event_kinds::turning_point && at && std::abs(at->slope) > flat_slope;
    if (!is_change(event) && !only_turns && at)
      curve_.events.push_back({event.monitor, "", 0, event.nonsmooth, at->point, index[event.after]});
  }
}

double CurveOfOptima::distance(const OptimumPoint& a, const OptimumPoint& b) const {
  double most = std::abs(sigma().scaled(a.along) - sigma().scaled(b.along));
  for (std::size_t k = 0; k < size(); ++k)
    most = std::max(most, std::abs(scaled_[k].scaled(a.design[k]) - scaled_[k].scaled(b.design[k])));
  return most;
}

double CurveOfOptima::way_since_response(const OptimumPoint& at) {
  if (!checked_) return 0;
  return distance(at, *checked_);
}

void CurveOfOptima::finish() {
  curve_.work.peaks = peaks_.work();
  curve_.work.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  if (curve_.points.empty()) return;
  const OptimumPoint& last = curve_.points.back();
  std::vector<double> design = last.design;
  design.push_back(last.along);
  curve_.stop.message += text("; the last amplitude is ", last.amplitude, " m at ", space_.text(design));
}

OptimumCurve optimum_curve(const scene::Scene& scene, const OptimumProblem& problem,
                           const DesignVariable& along, const OptimumCurveOptions& options) {
  return CurveOfOptima(scene, problem, along, options).run();
}

}  // namespace arcslip::optimize
