#include <arcslip/continuation/tracing/tracer_impl.hpp>

#include <arcslip/continuation/events/monitor_calls.hpp>
#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/continuation/special_points/lyapunov_schmidt.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double rejection = 0.25;             // of the step after a rejection
constexpr int rejections_before_a_corner = 2;  // in one stretch of the branch
constexpr int rejections_across_kinks = 4;     // the same, where kinks are passed: most are weak
constexpr double parameter_overrun = 1.5;      // of the largest |dp| of a step
constexpr double parameter_rounding = 1e-9;    // relative changes of p below this give no direction
// A turn of which this share remains in a step shortened by this factor is a kink.
constexpr double kink_turn = 0.7, kink_step = 0.25;
constexpr double endless_tail = 1e-12;  // of the parameter's scale: end this close to an unreached bound
constexpr double tail_before = 1e-9;    // with its last point this close
constexpr double same_state =
    1e-6;  // change of the state of a problem over a closed loop, relative to the largest one on it
constexpr double been_away = 3;  // roundings of the distance from the start: closer, it has not returned
constexpr long first_looked_at = 3, each_looked_at = 16;  // of points accepted by an expected error
constexpr double large_contraction = 0.1;
constexpr double unusual = 2;            // times the contraction at the last point
constexpr double singular_bound = 1e-6;  // relative to p: a singular bound this close is reached

// Both tangents point the same way in p, but p changed the other way: another branch, or two folds in
// one step.
bool went_back(const CurvePoint& from, const CurvePoint& to) {
  const Eigen::Index n = to.v.size() - 1;
  const double a = from.tangent[n], b = to.tangent[n], dp = to.v[n] - from.v[n];
  return a * b > 0 && a * dp < 0 && std::abs(dp) > parameter_rounding * std::abs(from.v[n]);
}

}  // namespace

bool Tracer::Impl::step() try {
  if (s_.ended) return false;
  if (!s_.begun) return begin();
  events_.forget();
  trial_.forget_refusal();
  while (may_try()) {
    switch (attempt()) {
      case Outcome::accepted:
        return !s_.ended;
      case Outcome::ended:
        return false;
      case Outcome::again:
        break;
      case Outcome::unresolved:
        count_rejection();
        s_.step *= control_.share_after_unresolved(trial_);
        trial_.keep_refusal();
        break;
      case Outcome::rejected:
        count_rejection();
        if (passes_corner_instead()) return !s_.ended;
        s_.step *= rejection;
        break;
    }
  }
  return false;
} catch (const MonitorFailure& failure) {
  return end(StopReason::monitor_failed, failure.parameter, 0, failure.what());
}

// Asks of a corrected prediction what a step has to keep to be accepted: one branch, the length of dp, the
// curve, the quantities.
Tracer::Impl::Outcome Tracer::Impl::attempt() {
  trial_.begin();
  if (const auto refused = correct()) return *refused;
  if (const auto refused = keep_to_branch()) return *refused;
  const double moved = std::abs(trial_.end.v[n_] - s_.here.v[n_]), most = control_.largest_parameter_step();
  if (moved > parameter_overrun * most)  // the tangent may turn towards the parameter, or at a kink
    return refuse(Rejected::parameter_step, moved, most, Outcome::unresolved);
  locate_corners();
  if (!settle_signs()) return refuse(Rejected::singular, 0, 0);
  interpolation_.measure_curve(trial_);
  divide();
  if (trial_.curve_error > 1 || interpolation_.misses_kinks(trial_))
    return refuse(Rejected::curve, trial_.curve_error, 1, Outcome::unresolved);
  if (!interpolation_.resolves_quantities(trial_))
    return refuse(Rejected::quantity, 0, 0, Outcome::unresolved);
  if (!is_as_expected()) {
    if (std::isnan(trial_.error)) {
      trial_.evaluated = false;
      trial_.failure = main_.failure();
      return refuse(Rejected::not_evaluated, trial_.error, 0);
    }
    jacobian_.suspect(trial_.end.v);
    return Outcome::again;
  }
  return take(trial_.kink ? s_.turn.step * kink_step : control_.after(trial_));
}

// Corrects the prediction, and measures the step to it.
std::optional<Tracer::Impl::Outcome> Tracer::Impl::correct() {
  CurvePoint& end = trial_.end;
  control_.predict(end.v);
  main_.border_row(s_.here.tangent, row_);
  trial_.usual_contraction = main_.memory().contraction;
  trial_.correction =
      main_.correct(end.v, row_, s_.factors_fit,
                    s_.expected < 0 || options_.stability ? Accept::last_correction : Accept::expected_error);
  const Correction& correction = trial_.correction;
  trial_.evaluated = correction.evaluated && main_.failure().empty();
  trial_.failure = main_.failure();
  if (!correction.converged)
    return refuse(correction.singular ? Rejected::singular
                  : trial_.evaluated  ? Rejected::not_converged
                                      : Rejected::not_evaluated,
                  correction.last, options_.newton.tolerance);
  if (correction.linear) jacobian_.suspect(end.v);
  v_ = end.v - s_.here.v;
  trial_.length = std::sqrt(main_.dot(v_, v_));
  if (!(trial_.length > 0) || !settle(main_, end)) return refuse(Rejected::singular, trial_.length, 0);
  trial_.turn = angle_between(
      std::min(main_.dot(end.tangent, s_.here.tangent), main_.dot(v_, s_.here.tangent) / trial_.length));
  return {};
}

// Whether the step stays on the branch, in its direction: it turns little, or at a kink, and passes branch
// points that are located.
std::optional<Tracer::Impl::Outcome> Tracer::Impl::keep_to_branch() {
  if (went_back(s_.here, trial_.end)) return refuse(Rejected::another_branch, 0, 0);
  if (!(trial_.turn > options_.step.largest_angle)) return look_for_crossing();
  trial_.kink = is_kink();
  if (trial_.kink && trial_.end.orientation == s_.here.orientation) return {};
  return refuse(Rejected::turn, trial_.turn, options_.step.largest_angle);
}

// Evaluates the monitors, and finds the kinks on the way; the step is longer by way of them.
void Tracer::Impl::locate_corners() {
  CurvePoint& end = trial_.end;
  end.arclength = s_.here.arclength + trial_.length;
  evaluate(monitors_, main_, end);
  if (!interpolation_.passes_kinks(trial_))
    trial_.corners = events_.corners(s_.here, end, interpolation_.kink_accuracy());
  if (trial_.corners.empty()) return;
  const CurvePoint& last = trial_.corners.back().beyond;
  trial_.length = last.arclength - s_.here.arclength + distance(main_, last.v, end.v);
  end.arclength = s_.here.arclength + trial_.length;
}

Tracer::Impl::Outcome Tracer::Impl::refuse(Rejected why, double value, double limit, Outcome as) {
  trial_.rejection.why = why;
  trial_.rejection.value = value;
  trial_.rejection.limit = limit;
  return as;
}

// Whether a further step is to be tried; otherwise the branch has ended.
bool Tracer::Impl::may_try() {
  if (!options_.control.keep_going()) return end(StopReason::user, 1, 1, "stopped by the caller");
  if (!jacobian_.can_continue())
    return end(StopReason::wrong_jacobian, s_.jacobian_error, largest_jacobian_error,
               "the branch cannot be continued: " + s_.jacobian_doubt);
  const double smallest = control_.smallest();
  if (!(s_.step < smallest)) return true;
  if (!trial_.evaluated)
    return end(StopReason::not_evaluated, s_.step, smallest,
               "the problem could not be evaluated at the next point, even with the smallest step" +
                   because(trial_.failure));
  return end(StopReason::step_too_small, s_.step, smallest, why_too_small());
}

std::string Tracer::Impl::why_too_small() {
  const bool rejected = s_.branch.counts.rejected_steps > rejected_before_;
  std::string why = rejected ? std::string() : control_.option_below_smallest();
  if (!why.empty()) return why;
  why = "the step size fell below its minimum";
  why += rejected ? " after rejections" : ", each step shorter than the one before";
  why += jacobian_.doubt(s_.here.v, s_.here.v);
  return why + doubt_of_isolation(*problem_, s_.here.v, s_.p, s_.free, options_.linear_solver);
}

void Tracer::Impl::count_rejection() {
  ++s_.branch.counts.rejected_steps;
  s_.factors_fit = false;
  if (!options_.on_rejection) return;
  Rejection& now = trial_.rejection;
  now.arclength = s_.here.arclength;
  now.parameter = s_.here.v[n_];
  now.step = s_.step;
  now.words = now.why == Rejected::quantity ? monitors_[trial_.unresolved].name : trial_.failure;
  options_.on_rejection(now);
}

// After a rejection: the next attempt goes by the tangent, and after several of them in one stretch of the
// branch, across a corner. True: it has passed one, or ended there.
bool Tracer::Impl::passes_corner_instead() {
  if (trial_.rejection.why == Rejected::not_converged) jacobian_.suspect(trial_.end.v);
  s_.has_before = false;
  if (!main_.failure().empty()) {
    trial_.evaluated = false;
    trial_.failure = main_.failure();
  }
  if (s_.here.arclength > s_.trouble_end) {
    s_.trouble_end = s_.here.arclength + s_.step;
    s_.rejections = 0;
  }
  const int enough = options_.step.pass_kinks ? rejections_across_kinks : rejections_before_a_corner;
  if (++s_.rejections >= enough && corner()) return true;
  s_.factors_fit = false;
  return false;
}

// Whether too large a turn of the tangent is a kink: the piece changes, and the turn does not decrease with
// the step. A turn is first met with a long step and rejected; it counts as the same one until its arclength
// is passed.
bool Tracer::Impl::is_kink() {
  if (trial_.end.piece == s_.here.piece) return false;
  const State::Turn now{trial_.turn, s_.step, s_.here.arclength + 2 * s_.step};
  if (s_.here.arclength > s_.turn.end) s_.turn = now;
  if (s_.step > kink_step * s_.turn.step) return false;
  if (trial_.turn >= kink_turn * s_.turn.angle) return true;
  s_.turn = now;  // it decreased, but may persist from here on
  return false;
}

// The monitors at the solution of the last correction.
bool Tracer::Impl::measure() {
  evaluate(monitors_, main_, trial_.end);
  return settle_signs();
}

// The factors of the last correction, and thus the tangent, belong to a point within the corrector's
// tolerance, which near a sharp peak can change the sign of a monitor: a sign change is accepted only with
// the linearization at the solution itself.
bool Tracer::Impl::settle_signs() {
  CurvePoint& place = trial_.end;
  if (!events_.changes_sign(trial_.last_section(s_.here), place)) return true;
  main_.border_row(place.tangent, v_);
  if (!main_.linearize(place.v, v_) || !settle(main_, place)) return false;
  evaluate(monitors_, main_, place);
  return true;
}

// Divides the step into sections with constant Monitor::part.
void Tracer::Impl::divide() {
  std::vector<PassedKink> all;
  std::size_t k = 0;
  trial_.all_sections(s_.here, [&](const CurvePoint& from, const CurvePoint& to) {
    auto found = events_.divisions(from, to);
    all.insert(all.end(), std::move_iterator(found.begin()), std::move_iterator(found.end()));
    if (k < trial_.corners.size()) all.push_back(trial_.corners[k++]);
    return true;
  });
  trial_.corners = std::move(all);
}

// Whether the error of a point that was accepted by an expected one is within the tolerance. With a wrong
// Jacobian, or at a kink that F does not declare, corrections contract less than expected, and less than
// before. Looked at are the first points, a sample, and those with such a contraction; and all of them where
// an observer wants F there.
bool Tracer::Impl::is_as_expected() {
  if (!trial_.correction.expected) return true;
  const double contraction = trial_.correction.last_contraction;
  trial_.is_looked_at = record_.has_observer() || s_.expected < first_looked_at ||
                        s_.expected % each_looked_at == 0 || contraction > large_contraction ||
                        contraction > unusual * trial_.usual_contraction;
  if (!trial_.is_looked_at) {
    ++s_.expected;
    return true;
  }
  trial_.error = main_.size(main_.correction_at(trial_.end.v), trial_.end.v);
  const bool is_within = trial_.error <= options_.newton.tolerance;
  if (!std::isnan(trial_.error)) s_.expected = is_within ? s_.expected + 1 : -1;
  return is_within;
}

// Accepts the step; or ends the branch, at the bound of the window or at its start.
Tracer::Impl::Outcome Tracer::Impl::take(double next_step) {
  trial_.end.arclength = s_.here.arclength + trial_.length;
  if (const auto exit = cut_at_exit({options_.lower, options_.upper}, s_.here, trial_))
    return end_at_bound(*exit);
  if (const auto closed = close_loop()) return *closed;
  s_.longest = std::max(s_.longest, trial_.length);
  trial_.evaluated = true;
  s_.has_before = !trial_.kink || !trial_.corners.empty();
  s_.factors_fit = !trial_.kink;
  if (!accept()) return Outcome::ended;
  s_.step = control_.limited(next_step);
  const double scale = main_.parameter_scale();
  for (const double bound : {options_.lower, options_.upper})
    if (std::abs(bound - s_.here.v[n_]) <= endless_tail * scale &&
        std::abs(bound - s_.before.v[n_]) <= tail_before * scale &&
        approaches_asymptotically(main_, s_.before, s_.here, bound)) {
      end_in_tail(bound);
      return Outcome::ended;
    }
  return within_limits() ? Outcome::accepted : Outcome::ended;
}

Tracer::Impl::Outcome Tracer::Impl::end_at_bound(const Exit& exit) {
  trial_.is_looked_at = false;
  const double bound = exit.bound;
  const CurvePoint& from = trial_.last_section(s_.here);
  CurvePoint& place = trial_.end;
  auto& crossing = trial_.crossing;
  // A branch point within the step changes the sign.
  const bool crossed = crossing && from.arclength + exit.share * (place.arclength - from.arclength) >
                                       crossing->place.arclength;
  const int orientation = crossed ? place.orientation : s_.here.orientation;
  if (!correct_to_bound(main_, from, exit, orientation, place, row_) || !measure()) {
    const double left = std::abs(bound - s_.here.v[n_]), scale = main_.parameter_scale();
    if (left > singular_bound * std::max(std::abs(bound), scale))
      return refuse(Rejected::end_of_window, left, 0);
    if (!approaches_asymptotically(main_, s_.before, s_.here, bound)) {
      end(StopReason::boundary, s_.here.v[n_], bound,
          "reached the end of the window at " + text(bound) + ", a singular point");
    } else if (left > endless_tail * scale) {
      return refuse(Rejected::end_of_window, left, 0);
    } else {
      end_in_tail(bound);
    }
    return Outcome::ended;
  }
  if (crossing && (crossing->place.v[n_] < options_.lower || crossing->place.v[n_] > options_.upper))
    crossing.reset();
  if (accept()) end(StopReason::boundary, bound, bound, "reached the end of the window at " + text(bound));
  return Outcome::ended;
}

// Where the step comes back to the start, or to a kink at which the branch began: there it ends.
std::optional<Tracer::Impl::Outcome> Tracer::Impl::close_loop() {
  CurvePoint& place = trial_.end;
  const double rounding = closing_tolerance(main_, s_.start, options_.newton.rounding_level);
  if (!trial_.kink &&
      may_close(main_, s_.start, s_.here, place, trial_.length, options_.step.largest_angle, v_)) {
    trial_.is_looked_at = false;
    // The nearby branch is that of the start if it has the same solution in the start's plane.
    v_ += main_.dot(s_.start.v - v_, s_.start.tangent) * s_.start.tangent;
    main_.border_row(s_.start.tangent, row_);
    const bool converged = main_.correct(v_, row_, false).converged;
    const double miss = distance(main_, v_, s_.start.v);
    if (converged && miss <= rounding && leaves_the_state_of_the_start()) {
      place = s_.start;
      place.arclength = s_.here.arclength + distance(main_, s_.here.v, place.v);
      if (accept()) end(StopReason::closed, miss, rounding, "returned to the start: the branch is closed");
      return Outcome::ended;
    }
    main_.border_row(place.tangent, row_);
    if (!main_.linearize(place.v, row_)) return refuse(Rejected::singular, 0, 0);
  }
  for (std::size_t k = 0; k < trial_.corners.size() && s_.here.arclength > 0; ++k) {
    const CurvePoint& at = trial_.corners[k].before;
    const double miss = distance(main_, at.v, s_.start.v);
    if (miss > rounding || at.arclength < been_away * rounding) continue;
    if (!leaves_the_state_of_the_start()) {
      main_.border_row(place.tangent, row_);
      if (!main_.linearize(place.v, row_)) return refuse(Rejected::singular, 0, 0);
      continue;
    }
    place = s_.start;
    place.arclength = at.arclength;
    trial_.corners.resize(k);
    if (accept())
      end(StopReason::closed, miss, rounding, "returned to the start, a kink: the branch is closed");
    return Outcome::ended;
  }
  return {};
}

// Whether the branch would be the same once more. One of a problem with a state may be back at its start on
// another path.
bool Tracer::Impl::leaves_the_state_of_the_start() {
  if (s_.accepted.size() == 0) return true;
  return s_.left_at_start.size() == s_.accepted.size() && main_.next_state(s_.start.v, next_state_) &&
         (next_state_ - s_.left_at_start).norm() <= same_state * s_.largest_accepted;
}

bool Tracer::Impl::accept() {
  const std::size_t events = s_.branch.events.size();
  const bool keep_going = record_.events_of(trial_);
  const bool is_there = trial_.is_looked_at && s_.branch.events.size() == events;
  if (record_.terminal()) return end_at(*record_.terminal());
  CurvePoint& place = trial_.end;
  record_.warn_of_undefined(place);
  record_.keep(place, trial_.correction);
  record_.add_spectrum();
  transverse_.keep(trial_, place);
  s_.last_step = place.arclength - trial_.last_section(s_.here).arclength;
  s_.curve_error = trial_.curve_error;
  if (trial_.corners.empty())
    std::swap(s_.before, s_.here);
  else
    s_.before = trial_.corners.back().beyond;
  std::swap(s_.here, place);
  rejected_before_ = s_.branch.counts.rejected_steps;
  jacobian_.check_some();
  const bool is_stopped = !keep_going || !record_.show_last_point(is_there);
  if (!accept_state()) return false;
  return !is_stopped || end(StopReason::user, 1, 1, "stopped by the caller");
}

// The last point is accepted with the state that it leaves. Up to here all that was evaluated on the way to
// it, rejected steps, events, checks and monitors, went by the state of the point before.
bool Tracer::Impl::accept_state() {
  if (s_.accepted.size() == 0) return true;
  if (!main_.next_state(s_.here.v, next_state_))
    return end(StopReason::not_evaluated, s_.here.v[n_], 0,
               "the state that the point at " + text(s_.here.v[n_]) + " leaves could not be computed" +
                   because(main_.failure()));
  if (s_.left_at_start.size() == 0) s_.left_at_start = next_state_;
  s_.largest_accepted = std::max(s_.largest_accepted, next_state_.norm());
  s_.accepted = next_state_;
  main_.set_state(s_.accepted);
  events_.set_state(s_.accepted);
  if (modes_) modes_->set_state(s_.accepted);
  s_.branch.state = s_.accepted;
  if (options_.keep_states) s_.branch.points.back().state = s_.accepted;
  return true;
}

// Ends the branch at a terminal event: points and events beyond it, found while it was pending, are dropped.
bool Tracer::Impl::end_at(const LocatedEvent& found) {
  const CurvePoint& terminal = found.place;
  if (found.accepted.size() != 0) main_.set_state(found.accepted);
  auto& points = s_.branch.points;
  auto& events = s_.branch.events;
  while (!points.empty() && points.back().arclength > terminal.arclength) points.pop_back();
  while (!events.empty() && events.back().point.arclength > terminal.arclength) events.pop_back();
  record_.keep(terminal, {});
  if (options_.stability && main_.move_to(terminal.v, Needs::jacobian)) record_.add_spectrum(true);
  s_.before = s_.here;
  s_.here = terminal;
  if (!accept_state()) return false;
  const Event& last = events.back();
  return end(StopReason::event, last.value, 0,
             "reached the terminal event \"" + last.monitor + "\" at " + text(terminal.v[n_]));
}

void Tracer::Impl::end_in_tail(double bound) {
  end(StopReason::boundary, s_.here.v[n_], bound,
      "came within " + text(std::abs(bound - s_.here.v[n_])) + " of the end of the window at " + text(bound) +
          " without reaching it: the branch goes to infinity, |u| = " + text(main_.norm_u(s_.here.v)) +
          " in scales");
}

bool Tracer::Impl::within_limits() {
  const auto stop = limit_reached(options_, timed_, s_.branch, n_, main_.norm_u(s_.here.v), s_.here.v[n_]);
  return !stop || end(stop->reason, stop->value, stop->limit, stop->message);
}

bool Tracer::Impl::end(StopReason reason, double value, double limit, std::string message) {
  s_.branch.stop = {reason, value, limit, std::move(message)};
  s_.ended = true;
  return false;
}

}  // namespace arcslip::continuation
