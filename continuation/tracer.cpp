#include <arcslip/continuation/tracer.hpp>

#include <arcslip/continuation/ends.hpp>
#include <arcslip/continuation/jacobian_check.hpp>
#include <arcslip/continuation/monitor_calls.hpp>
#include <arcslip/continuation/reduction.hpp>
#include <arcslip/continuation/text.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double rejection = 0.25;             // of the step after a rejection
constexpr int rejections_before_a_corner = 2;  // in one section of the branch
constexpr double parameter_overrun = 1.5;      // of the largest |dp| of a step
constexpr double visible_corner = 0.05;        // rad: smaller kinks are invisible in a plotted curve
constexpr double endless_tail = 1e-12;  // of the parameter's scale: end this close to an unreached bound
constexpr double tail_before = 1e-9;    // with its last point this close
constexpr double least_power = 0.1;     // of the distance from a bound: u converges at least like this power
constexpr double been_away = 3;  // roundings of the distance from the start: closer, it has not returned
constexpr double singular_bound = 1e-6;  // relative to p: a singular bound this close is reached

}  // namespace

bool Tracer::end(StopReason reason, double value, double limit, std::string message) {
  s_.branch.stop = {reason, value, limit, std::move(message)};
  s_.ended = true;
  return false;
}

// For the observer, the evaluator moves by the last correction onto the point itself.
bool Tracer::notify() {
  if (!observer_) return true;
  main_->move_to(s_.here.v);
  return observer_(accepted(*main_, s_.here), nullptr);
}

bool Tracer::step() try {
  if (s_.ended) return false;
  if (!s_.begun) return begin();
  events_->forget();
  for (;;) {
    if (options_.go_on && !options_.go_on()) return end(StopReason::user, 1, 1, "stopped by the caller");
    if (!gets_on())
      return end(StopReason::wrong_jacobian, s_.jacobian_error, largest_jacobian_error,
                 "the branch cannot be continued: " + s_.jacobian_doubt);
    const double smallest = options_.step.smallest * (1 + main_->norm_u(s_.here.v));
    if (s_.step < smallest)
      return end(evaluated_ ? StopReason::step_too_small : StopReason::not_evaluated, s_.step, smallest,
                 evaluated_
                     ? "the step size fell below its minimum after rejections" + doubt(s_.here.v) +
                           doubt_of_isolation(*problem_, s_.here.v, s_.p, s_.free, options_.linear_solver)
                     : "the problem could not be evaluated at the next point, even with the smallest step" +
                           because(failure_));
    switch (attempt()) {
      case Attempt::accepted:
        return !s_.ended;
      case Attempt::ended:
        return false;
      case Attempt::unresolved:
        ++s_.branch.counts.rejected_steps;
        log_rejection();
        s_.factors_fit = false;
        s_.step *= unresolved_factor();
        break;
      case Attempt::rejected:
        ++s_.branch.counts.rejected_steps;
        log_rejection();
        if (rejection_.why == Rejected::not_converged) suspect(next_.v);
        s_.factors_fit = false;
        s_.has_before = false;
        if (!main_->failure().empty()) {
          evaluated_ = false;
          failure_ = main_->failure();
        }
        if (s_.here.arclength > s_.trouble_end) {
          s_.trouble_end = s_.here.arclength + s_.step;
          s_.rejections = 0;
        }
        if (++s_.rejections >= rejections_before_a_corner && corner()) return !s_.ended;
        s_.factors_fit = false;
        s_.step *= rejection;
        break;
    }
  }
} catch (const MonitorFailure& failure) {
  return end(StopReason::monitor_failed, failure.parameter, 0, failure.what());
}

// The monitors at the solution of the last correction. Its factors, and thus the tangent, belong to a point
// within the corrector's tolerance, which near a sharp peak can change the sign of a monitor: a sign change
// is accepted only with the linearization at the solution itself.
bool Tracer::measure(Place& place) {
  evaluate(monitors_, *main_, place);
  if (!events_->changes_sign(last_section(), place)) return true;
  main_->border_row(place.tangent, v_);
  if (!main_->linearize(place.v, v_) || !settle(*main_, place)) return false;
  evaluate(monitors_, *main_, place);
  return true;
}

// Divides the step into sections with constant Monitor::part.
void Tracer::divide() {
  std::vector<Corner> all;
  const Place* from = &s_.here;
  for (std::size_t k = 0; k <= corners_.size(); ++k) {
    const Place& to = k < corners_.size() ? corners_[k].before : next_;
    auto found = events_->divisions(*from, to);
    all.insert(all.end(), std::move_iterator(found.begin()), std::move_iterator(found.end()));
    if (k == corners_.size()) break;
    from = &corners_[k].beyond;
    all.push_back(corners_[k]);
  }
  corners_ = std::move(all);
}

Tracer::Attempt Tracer::attempt() {
  crossing_.reset();
  corners_.clear();
  curve_error_ = 0;
  predict(next_.v);
  main_->border_row(s_.here.tangent, row_);
  const Correction correction = main_->correct(next_.v, row_, s_.factors_fit, options_.newton.corrector);
  evaluated_ = correction.evaluated && main_->failure().empty();
  failure_ = main_->failure();
  if (!correction.converged)
    return refuse(correction.singular ? Rejected::singular
                  : evaluated_        ? Rejected::not_converged
                                      : Rejected::not_evaluated,
                  correction.last, options_.newton.tolerance);
  if (correction.linear) suspect(next_.v);

  v_ = next_.v - s_.here.v;
  double length = std::sqrt(main_->dot(v_, v_));
  if (!(length > 0) || !settle(*main_, next_)) return refuse(Rejected::singular, length, 0);
  if (went_back(next_)) return refuse(Rejected::another_branch, 0, 0);

  const double turn = angle_between(
      std::min(main_->dot(next_.tangent, s_.here.tangent), main_->dot(v_, s_.here.tangent) / length));
  bool kink = false;
  if (turn > options_.step.largest_angle) {
    kink = is_kink(turn, next_);
    if (!kink || next_.orientation != s_.here.orientation)
      return refuse(Rejected::turn, turn, options_.step.largest_angle);
  } else if (const auto refused = look_for_crossing(length)) {
    return *refused;
  }
  // The tangent may turn towards the parameter within the step, or at a kink.
  const double moved = std::abs(next_.v[n_] - s_.here.v[n_]);
  if (moved > parameter_overrun * largest_parameter_step())
    return refuse(Rejected::parameter_step, moved, largest_parameter_step(), Attempt::unresolved);
  next_.arclength = s_.here.arclength + length;
  corners_ = events_->corners(s_.here, next_);
  if (!corners_.empty()) {
    const Place& last = corners_.back().beyond;
    length = last.arclength - s_.here.arclength + distance(*main_, last.v, next_.v);
    next_.arclength = s_.here.arclength + length;
  }
  if (!measure(next_)) return refuse(Rejected::singular, 0, 0);
  curve_error_ = curve_error();
  divide();
  if (curve_error_ > 1) return refuse(Rejected::curve, curve_error_, 1, Attempt::unresolved);
  if (hides_a_piece(length)) return refuse(Rejected::curve, curve_error_, 1, Attempt::unresolved);
  if (!resolved(length)) return refuse(Rejected::quantity, 0, 0, Attempt::unresolved);
  const double next_ds = kink ? s_.turn.step * kink_step : choose_step(turn, correction);
  return take(length, next_ds, kink, correction);
}

// Cuts the step where it leaves the window: next_ becomes the end of that section, and later kinks
// are dropped.
std::optional<Exit> Tracer::exit(bool kink) {
  const Window window{options_.lower, options_.upper};
  const Place* from = &s_.here;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const Place& to = corners_[k].before;
    if (const auto found = leaves(window, *from, to, to.arclength - from->arclength, false)) {
      next_ = to;
      corners_.resize(k);
      return found;
    }
    from = &corners_[k].beyond;
  }
  return leaves(window, *from, next_, next_.arclength - from->arclength, kink && corners_.empty());
}

// Accepts next_, or, beyond the window, ends the branch at its bound.
Tracer::Attempt Tracer::take(double length, double next_ds, bool kink, const Correction& correction) {
  next_.arclength = s_.here.arclength + length;
  if (const auto exit = this->exit(kink)) {
    const double bound = exit->bound;
    const Place& from = last_section();
    // A branch point within the step changes the sign.
    const bool crossed = crossing_ && from.arclength + exit->share * (next_.arclength - from.arclength) >
                                          crossing_->place.arclength;
    const int orientation = crossed ? next_.orientation : s_.here.orientation;
    if (!draw_back(*main_, from, *exit, orientation, next_, row_) || !measure(next_)) {
      const double left = std::abs(bound - s_.here.v[n_]);
      if (left > singular_bound * std::max(std::abs(bound), main_->parameter_scale()))
        return refuse(Rejected::end_of_window, left, 0);
      if (!runs_along(bound)) {
        end(StopReason::boundary, s_.here.v[n_], bound,
            "reached the end of the window at " + text(bound) + ", a singular point");
      } else if (left > endless_tail * main_->parameter_scale()) {
        return refuse(Rejected::end_of_window, left, 0);
      } else {
        end_in_tail(bound);
      }
      return Attempt::ended;
    }
    if (crossing_ && (crossing_->place.v[n_] < options_.lower || crossing_->place.v[n_] > options_.upper))
      crossing_.reset();
    if (accept(std::move(next_), correction))
      end(StopReason::boundary, bound, bound, "reached the end of the window at " + text(bound));
    return Attempt::ended;
  }
  if (!kink && may_come_home(*main_, s_.start, s_.here, next_, length, options_.step.largest_angle, v_)) {
    // The nearby branch is that of the start if it has the same solution in the start's plane.
    v_ += main_->dot(s_.start.v - v_, s_.start.tangent) * s_.start.tangent;
    main_->border_row(s_.start.tangent, row_);
    const bool converged = main_->correct(v_, row_, false).converged;
    const double miss = distance(*main_, v_, s_.start.v);
    const double rounding = rounding_of_home(*main_, s_.start, options_.newton.rounding_level);
    if (converged && miss <= rounding) {
      next_ = s_.start;
      next_.arclength = s_.here.arclength + distance(*main_, s_.here.v, next_.v);
      if (accept(std::move(next_), correction))
        end(StopReason::closed, miss, rounding, "returned to the start: the branch is closed");
      return Attempt::ended;
    }
    main_->border_row(next_.tangent, row_);
    if (!main_->linearize(next_.v, row_)) return refuse(Rejected::singular, 0, 0);
  }
  const double rounding = rounding_of_home(*main_, s_.start, options_.newton.rounding_level);
  for (std::size_t k = 0; k < corners_.size() && s_.here.arclength > 0; ++k) {
    const Place& at = corners_[k].before;
    const double miss = distance(*main_, at.v, s_.start.v);
    if (miss > rounding || at.arclength < been_away * rounding) continue;
    next_ = s_.start;
    next_.arclength = at.arclength;
    corners_.resize(k);
    if (accept(std::move(next_), correction))
      end(StopReason::closed, miss, rounding, "returned to the start, a kink: the branch is closed");
    return Attempt::ended;
  }
  s_.longest = std::max(s_.longest, length);
  evaluated_ = true;
  s_.has_before = !kink || !corners_.empty();
  s_.factors_fit = !kink;
  if (!accept(std::move(next_), correction)) return Attempt::ended;
  s_.step = limited(next_ds);
  for (const double bound : {options_.lower, options_.upper})
    if (std::abs(bound - s_.here.v[n_]) <= endless_tail * main_->parameter_scale() &&
        std::abs(bound - s_.before.v[n_]) <= tail_before * main_->parameter_scale() && runs_along(bound)) {
      end_in_tail(bound);
      return Attempt::ended;
    }
  return within_limits() ? Attempt::accepted : Attempt::ended;
}

// Whether the branch approaches a bound of the window asymptotically: with the distance x = |p - bound|,
// x |du/dp| is the change of u while x decreases by the factor e. Towards a point at the bound it decreases
// like a power of x, 1/2 at a fold; if u goes to infinity it does not.
bool Tracer::runs_along(double bound) const {
  const auto change = [&](const Place& at) {
    return std::abs(bound - at.v[n_]) * main_->norm_u(at.tangent) / std::abs(at.tangent[n_]);
  };
  const double x = std::abs(bound - s_.here.v[n_]), x_before = std::abs(bound - s_.before.v[n_]);
  if (!(x > 0 && x < x_before)) return false;
  const double now = change(s_.here), before = change(s_.before);
  return std::isfinite(now) && std::log(now / before) > least_power * std::log(x / x_before);
}

void Tracer::end_in_tail(double bound) {
  end(StopReason::boundary, s_.here.v[n_], bound,
      "came within " + text(std::abs(bound - s_.here.v[n_])) + " of the end of the window at " + text(bound) +
          " without reaching it: the branch goes to infinity, |u| = " + text(main_->norm_u(s_.here.v)) +
          " in scales");
}

bool Tracer::within_limits() {
  double seconds = 0;
  if (options_.seconds > 0)
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  const auto stop = limit_reached(options_, s_.branch, n_, main_->norm_u(s_.here.v), s_.here.v[n_], seconds);
  return !stop || end(stop->reason, stop->value, stop->limit, stop->message);
}

void Tracer::keep(const Place& place, const Correction& correction) {
  Point kept = point(place, correction);
  if (!options_.keep_points) kept.u = kept.tangent = {};
  s_.branch.points.push_back(std::move(kept));
  ++s_.branch.counts.points;
}

// Moves to a kink, from the start of a section, and across it. A visible corner becomes a point of
// the branch.
bool Tracer::pass(const Place& from, const Corner& corner) {
  const Place& kink = corner.before;
  bool go_on = report(events_->between(from, kink));
  if (!go_on || terminal_) return go_on;
  go_on = report(events_->across(corner));
  if (terminal_ || angle_between(main_->dot(kink.tangent, corner.beyond.tangent)) < visible_corner)
    return go_on;
  keep(kink, {});
  if (!go_on || !observer_) return go_on;
  const auto now = events_->look_at(kink);
  return !now || observer_(*now, nullptr);
}

bool Tracer::accept(Place&& place, const Correction& correction) {
  bool go_on = true;
  const Place* from = &s_.here;
  for (const Corner& corner : corners_) {
    if (!go_on || terminal_) break;
    go_on = pass(*from, corner);
    from = &corner.beyond;
  }
  const bool crossed = crossing_ && crossing_->event.located && !crossing_->event.nonsmooth &&
                       crossing_->place.arclength > from->arclength;
  if (go_on && !terminal_)
    go_on = report(with_crossing(crossed ? events_->past(*from, crossing_->place, place)
                                         : events_->between(*from, place)));
  if (terminal_) return end_at(*terminal_);
  warn_of_undefined(place);
  keep(place, correction);
  s_.last_step = place.arclength - from->arclength;
  s_.curve_error = curve_error_;
  if (corners_.empty())
    std::swap(s_.before, s_.here);
  else
    s_.before = corners_.back().beyond;
  std::swap(s_.here, place);
  if (is_due(s_.branch.counts.points)) look_at_jacobian(s_.here.v);
  if (!go_on || !notify()) return end(StopReason::user, 1, 1, "stopped by the caller");
  return true;
}

// Ends the branch at a terminal event: points and events beyond it, found while it was pending, are dropped.
bool Tracer::end_at(const Place& place) {
  auto& points = s_.branch.points;
  auto& events = s_.branch.events;
  while (!points.empty() && points.back().arclength > place.arclength) points.pop_back();
  while (!events.empty() && events.back().point.arclength > place.arclength) events.pop_back();
  keep(place, {});
  s_.before = s_.here;
  s_.here = place;
  const Event& last = events.back();
  return end(StopReason::event, last.value, 0,
             "reached the terminal event \"" + last.monitor + "\" at " + text(place.v[n_]));
}

Branch trace(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
             std::vector<Monitor> monitors, Observer observer) {
  Tracer tracer(std::move(problem), start, options, std::move(monitors), std::move(observer));
  while (tracer.step()) {
  }
  return tracer.take();
}

}  // namespace arcslip::continuation
