#include <arcslip/continuation/tracer.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double first_share_of_window = 0.01;   // |dp| of a step where the user names none
constexpr double growth = 2.0, shrinkage = 0.3;  // of the step, at most
constexpr double rejection = 0.25;               // of the step after a rejection
// A turn that keeps so much of itself over so much shorter a step is a kink.
constexpr double kink_step = 0.25, kink_turn = 0.7;
constexpr int rejections_before_a_corner = 2;  // in one stretch of the branch
constexpr double branch_point_step = 1e-7;   // relative to 1 + |u|: no shorter step tells two branches apart
constexpr double parameter_rounding = 1e-9;  // relative changes of p below tell no direction
constexpr double largest_extrapolation = 2.5;  // in last steps, for the cubic predictor
constexpr double unresolved_rejection = 0.5;   // of the step where a quantity is not told by its slopes
constexpr double unresolved_change = 0.5;      // of a quantity, against its slopes
constexpr double unresolved_share = 1.0 / 50;  // of the step that was first found unresolved: not shorter
constexpr double quantity_rounding = 1e-9;     // relative changes of a quantity below are not looked at
constexpr double corner_step = 1e-3;           // beyond a kink, of the step, to linearize there

double angle_between(double cosine) {
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

std::string text(double x) {
  std::ostringstream s;
  s.precision(10);
  s << x;
  return s.str();
}

}  // namespace

Tracer::Tracer(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
               std::vector<Monitor> monitors, Observer observer)
    : problem_(std::move(problem)),
      options_(options),
      observer_(std::move(observer)),
      n_(problem_->size()),
      free_(start.free),
      direction_(start.direction < 0 ? -1 : 1),
      main_(*problem_, start.p, start.free, options.newton, branch_.counts),
      events_(problem_, start.p, start.free, options, std::move(monitors), branch_.counts) {
  check(options);
  const auto parameters = problem_->parameters();
  if (start.u.size() != n_)
    throw std::invalid_argument("the start has " + std::to_string(start.u.size()) +
                                " unknowns, the problem " + std::to_string(n_));
  if (start.p.size() != static_cast<Eigen::Index>(parameters.size()))
    throw std::invalid_argument("the start has " + std::to_string(start.p.size()) +
                                " parameters, the problem " + std::to_string(parameters.size()));
  here_.v.resize(n_ + 1);
  here_.v << start.u, start.p[free_];
  if (!here_.v.allFinite()) throw std::invalid_argument("the start has numbers that are not finite");
  if (here_.v[n_] < options.lower || here_.v[n_] > options.upper)
    throw std::invalid_argument("the start is at " + text(here_.v[n_]) + ", outside the window [" +
                                text(options.lower) + ", " + text(options.upper) + "]");
  if (options_.step.largest_parameter == 0)
    options_.step.largest_parameter = first_share_of_window * (options.upper - options.lower);
  here_.tangent = Vector::Zero(n_ + 1);
  next_ = before_ = here_;
  row_.resize(n_ + 1);
  v_.resize(n_ + 1);
}

bool Tracer::end(StopReason reason, double value, double limit, std::string message) {
  branch_.stop = {reason, value, limit, std::move(message)};
  ended_ = true;
  return false;
}

// For the user's eyes, the evaluator moves the last correction further, onto the point itself.
bool Tracer::notify() {
  if (!observer_) return true;
  main_.move_to(here_.v);
  return observer_(accepted(main_, here_), nullptr);
}

bool Tracer::begin() {
  begun_ = true;
  row_.setZero();
  row_[n_] = 1;
  const Correction correction = main_.correct(here_.v, row_, false);
  if (!correction.converged)
    return end(correction.evaluated ? StopReason::start_failed : StopReason::not_evaluated, correction.last,
               options_.newton.tolerance,
               correction.evaluated ? "the corrector did not converge at the start (" +
                                          std::to_string(correction.iterations) + " iterations)"
                                    : "the problem could not be evaluated at the start");
  if (!settle(main_, here_))
    return end(StopReason::start_failed, 0, 0, "the linearization at the start is singular");
  if (direction_ < 0) here_.reverse();
  const double to_scale = std::sqrt(main_.weights()[n_]);
  const double along = to_scale * std::abs(here_.tangent[n_]);
  ds_ = options_.step.initial > 0 ? options_.step.initial
                                  : 0.1 * to_scale * options_.step.largest_parameter / std::max(along, 1e-3);
  ds_ = limited(ds_);
  evaluate(events_.monitors(), main_, here_);
  branch_.points.push_back(point(here_, correction));
  ++branch_.counts.points;
  factors_fit_ = false;  // their border row is that of the start
  if (!notify()) return end(StopReason::user, 1, 1, "stopped by the caller");
  return true;
}

double Tracer::limited(double ds) const {
  ds = std::min(ds, options_.step.relative_state * (1 + main_.norm_u(here_.v)));
  const double along = std::abs(here_.tangent[n_]);
  double limit = options_.step.largest_parameter;
  if (options_.step.relative_parameter > 0)
    limit = std::min(limit, options_.step.relative_parameter * std::abs(here_.v[n_]));
  return along * ds > limit && limit > 0 ? limit / along : ds;
}

// The cubic through the last two points, or, after a kink, at the start or far out, the tangent.
void Tracer::predict(Vector& v) const {
  if (has_before_ && ds_ <= largest_extrapolation * last_ds_) {
    hermite(before_.v, before_.tangent, here_.v, here_.tangent, last_ds_, 1 + ds_ / last_ds_, v);
    return;
  }
  v = here_.v + ds_ * here_.tangent;
}

bool Tracer::step() {
  if (ended_) return false;
  if (!begun_) return begin();
  for (;;) {
    const double smallest = options_.step.smallest * (1 + main_.norm_u(here_.v));
    if (ds_ < smallest)
      return end(evaluated_ ? StopReason::step_too_small : StopReason::not_evaluated, ds_, smallest,
                 evaluated_ ? "the step fell below its smallest size after rejections"
                            : "the problem could not be evaluated ahead, however short the step");
    switch (attempt()) {
      case Attempt::accepted:
        return !ended_;
      case Attempt::ended:
        return false;
      case Attempt::unresolved:
        ++branch_.counts.rejected_steps;
        factors_fit_ = false;
        ds_ *= unresolved_rejection;
        break;
      case Attempt::rejected:
        ++branch_.counts.rejected_steps;
        factors_fit_ = false;
        has_before_ = false;
        if (here_.arclength > trouble_end_) {
          trouble_end_ = here_.arclength + ds_;
          rejections_ = 0;
        }
        if (++rejections_ >= rejections_before_a_corner && corner()) return !ended_;
        factors_fit_ = false;
        ds_ *= rejection;
        break;
    }
  }
}

// Both tangents point one way in p, and p went the other way: another branch, or two folds in one step.
bool Tracer::went_back(const Place& next) const {
  const double a = here_.tangent[n_], b = next.tangent[n_], dp = next.v[n_] - here_.v[n_];
  return a * b > 0 && a * dp < 0 && std::abs(dp) > parameter_rounding * std::abs(here_.v[n_]);
}

// The monitors at the solution of the last correction. Its factors, and so the tangent, are those of a place
// within the corrector's tolerance, which near a sharp peak is enough to turn the sign of a monitor: a change
// of sign is believed from the linearization at the solution itself.
void Tracer::measure(Place& place) {
  evaluate(events_.monitors(), main_, place);
  if (!events_.changes_sign(here_, place)) return;
  v_ = place.tangent.cwiseProduct(main_.weights());
  if (main_.linearize(place.v, v_) && settle(main_, place)) evaluate(events_.monitors(), main_, place);
}

// Whether the change of each monitored quantity is that of its slopes at both ends, by the trapezoid. Beside
// a kink it is not, however short the step: in one stretch the step is shortened no further than to a part of
// the first one.
bool Tracer::resolved(const Place& from, const Place& to, double length) {
  if (here_.arclength <= unresolved_end_ && ds_ <= unresolved_share * unresolved_step_) return true;
  for (std::size_t m = 0; m < events_.monitors().size(); ++m) {
    if (!events_.monitors()[m].quantity) continue;
    const double a = from.monitors[m] * length, b = to.monitors[m] * length;
    const double change = to.quantities[m] - from.quantities[m];
    const double size = std::max(std::abs(a), std::abs(b));
    if (std::abs(change - 0.5 * (a + b)) <= unresolved_change * size ||
        size <= quantity_rounding * std::abs(to.quantities[m]))
      continue;
    if (here_.arclength > unresolved_end_) {
      unresolved_end_ = here_.arclength + length;
      unresolved_step_ = ds_;
    }
    return false;
  }
  return true;
}

// Whether a turn of the tangent that is too large is a kink: the piece changes, and the turn does not shrink
// with the step. A turn is first met with a long step and rejected; it is the same one as long as its place
// is not passed.
bool Tracer::is_kink(double turn, const Place& next) {
  if (next.piece == here_.piece) return false;
  const Turn now{turn, ds_, here_.arclength + 2 * ds_};
  if (here_.arclength > turn_.end) turn_ = now;
  if (ds_ > kink_step * turn_.step) return false;
  if (turn >= kink_turn * turn_.angle) return true;
  turn_ = now;  // it shrank, but may stay from here on
  return false;
}

Tracer::Attempt Tracer::attempt() {
  predict(next_.v);
  row_ = here_.tangent.cwiseProduct(main_.weights());
  const Correction correction = main_.correct(next_.v, row_, factors_fit_);
  evaluated_ = correction.evaluated;
  if (!correction.converged) return Attempt::rejected;

  v_ = next_.v - here_.v;
  const double length = std::sqrt(main_.dot(v_, v_));
  if (!(length > 0) || !settle(main_, next_) || went_back(next_)) return Attempt::rejected;

  const double turn = std::max(angle_between(main_.dot(next_.tangent, here_.tangent)),
                               angle_between(main_.dot(v_, here_.tangent) / length));
  bool kink = false;
  if (turn > options_.step.largest_angle) {
    kink = is_kink(turn, next_);
    if (!kink) return Attempt::rejected;
    if (next_.orientation != here_.orientation) next_.reverse();
  } else if (next_.orientation != here_.orientation &&
             ds_ > branch_point_step * (1 + main_.norm_u(here_.v))) {
    // A jump to a branch near by, unless it stays however short the step: a branch point.
    return Attempt::rejected;
  }
  measure(next_);
  if (!resolved(here_, next_, length)) return Attempt::unresolved;
  const double next_ds = kink ? turn_.step * kink_step : choose_step(turn, correction);
  return take(length, next_ds, kink, correction);
}

// Where the branch turns by any angle at a kink just ahead: goes to the kink, linearizes beyond it, and steps
// along the tangent there, whose direction the sign of the determinant tells.
bool Tracer::corner() {
  v_ = here_.v + ds_ * here_.tangent;
  if (!main_.move_to(v_) || main_.evaluator().piece() == here_.piece) return false;
  Place kink;
  Correction correction;
  if (!locate_kink(main_, here_, ds_, kink, correction)) return false;
  Corner sides;
  const double way = kink.arclength - here_.arclength;
  bool has_sides =
      look_beside(kink, kink.tangent, -corner_step * way, sides.before) && sides.before.piece == here_.piece;
  sides.before.v = kink.v;
  sides.before.arclength = kink.arclength;
  if (has_sides && !resolved(here_, sides.before, way)) return false;
  next_.v = kink.v + corner_step * ds_ * here_.tangent;
  row_ = here_.tangent.cwiseProduct(main_.weights());
  if (!main_.linearize(next_.v, row_) || !settle(main_, next_)) {  // at a right angle, a row that is neither
    row_.setZero();
    row_[n_] = 1;
    if (!main_.linearize(next_.v, row_) || !settle(main_, next_)) return false;
  }
  if (next_.piece == here_.piece) return false;
  if (next_.orientation != here_.orientation) next_.tangent = -next_.tangent;
  const Vector beyond = next_.tangent;
  next_.v = kink.v + ds_ * beyond;
  row_ = beyond.cwiseProduct(main_.weights());
  correction = main_.correct(next_.v, row_, false);
  if (!correction.converged || !settle(main_, next_)) return false;
  v_ = next_.v - kink.v;
  const double length = std::sqrt(main_.dot(v_, v_));
  if (next_.piece == here_.piece || next_.orientation != here_.orientation || !(length > 0) ||
      angle_between(main_.dot(next_.tangent, beyond)) > options_.step.largest_angle ||
      angle_between(main_.dot(v_, beyond) / length) > options_.step.largest_angle)
    return false;
  measure(next_);
  has_sides = has_sides && look_beside(kink, beyond, corner_step * ds_, sides.beyond) &&
              sides.beyond.piece != here_.piece;
  if (has_sides && !resolved(sides.beyond, next_, length)) return false;
  return take(way + length, ds_, true, correction, has_sides ? &sides : nullptr) != Attempt::rejected;
}

// A place shortly before (way < 0) or beyond a kink, on the branch, with its monitors.
bool Tracer::look_beside(const Place& kink, const Vector& tangent, double way, Place& side) {
  side.v = kink.v + way * tangent;
  side.tangent = tangent;
  side.arclength = kink.arclength + way;
  v_ = tangent.cwiseProduct(main_.weights());
  if (!main_.correct(side.v, v_, false).converged || !main_.linearize(side.v, v_) || !settle(main_, side))
    return false;
  evaluate(events_.monitors(), main_, side);
  return true;
}

// Accepts next_, or, beyond the window, ends the branch at its bound.
Tracer::Attempt Tracer::take(double length, double next_ds, bool kink, const Correction& correction,
                             const Corner* corner) {
  next_.arclength = here_.arclength + length;
  const double p = next_.v[n_], bound = std::clamp(p, options_.lower, options_.upper);
  if (p != bound) {
    if (!to_boundary(next_, bound)) return Attempt::rejected;
    if (accept(std::move(next_), correction))
      end(StopReason::boundary, bound, bound, "reached the end of the window at " + text(bound));
    return Attempt::ended;
  }
  last_ds_ = length;
  has_before_ = !kink;
  factors_fit_ = !kink;
  if (!accept(std::move(next_), correction, corner)) return Attempt::ended;
  ds_ = limited(next_ds);
  const double state = main_.norm_u(here_.v);
  if (state > options_.largest_state) {
    end(StopReason::state_too_large, state, options_.largest_state,
        "the solution grows without bound near " + text(here_.v[n_]));
    return Attempt::ended;
  }
  if (branch_.counts.points >= options_.points) {
    end(StopReason::point_limit, static_cast<double>(branch_.counts.points),
        static_cast<double>(options_.points),
        "reached the largest number of points, " + std::to_string(options_.points));
    return Attempt::ended;
  }
  return Attempt::accepted;
}

double Tracer::choose_step(double angle, const Correction& correction) const {
  double factor = angle > 0 ? options_.step.angle / angle : growth;
  const bool contraction_counts = correction.first > std::sqrt(options_.newton.tolerance);
  if (contraction_counts && correction.contraction > 0)
    factor = std::min(factor, std::sqrt(options_.step.contraction / correction.contraction));
  return ds_ * std::clamp(factor, shrinkage, growth);
}

// From `place`, beyond the window, back to p = bound.
bool Tracer::to_boundary(Place& place, double bound) {
  const double share = (bound - here_.v[n_]) / (place.v[n_] - here_.v[n_]);
  place.v = here_.v + share * (place.v - here_.v);
  place.v[n_] = bound;
  v_.setZero();
  v_[n_] = 1;
  if (!main_.correct(place.v, v_, false).converged) return false;
  place.v[n_] = bound;
  if (!settle(main_, place)) return false;
  if (main_.dot(place.tangent, here_.tangent) < 0) place.reverse();
  place.arclength = here_.arclength + distance(main_, here_.v, place.v);
  measure(place);
  return true;
}

// In the order of arclength: an event may have waited for a few points until it was certain.
const Event* Tracer::add(Event&& event) {
  const double s = event.point.arclength;
  const auto after = std::upper_bound(branch_.points.begin(), branch_.points.end(), s,
                                      [](double x, const Point& y) { return x < y.arclength; });
  event.after = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - branch_.points.begin(), 1) - 1);
  const auto place = std::upper_bound(branch_.events.begin(), branch_.events.end(), s,
                                      [](double x, const Event& y) { return x < y.point.arclength; });
  return &*branch_.events.insert(place, std::move(event));
}

bool Tracer::report(std::vector<LocatedEvent>&& all) {
  bool go_on = true;
  for (LocatedEvent& found : all) {
    const Event* event = add(std::move(found.event));
    if (!observer_ || !go_on) continue;
    if (const auto now = events_.look_at(found.place)) go_on = observer_(*now, event);
  }
  return go_on;
}

bool Tracer::accept(Place&& place, const Correction& correction, const Corner* corner) {
  const bool go_on = corner ? report(events_.between(here_, corner->before)) &&
                                  report(events_.across(corner->before, corner->beyond)) &&
                                  report(events_.between(corner->beyond, place))
                            : report(events_.between(here_, place));
  branch_.points.push_back(point(place, correction));
  ++branch_.counts.points;
  std::swap(before_, here_);
  std::swap(here_, place);
  if (!go_on || !notify()) return end(StopReason::user, 1, 1, "stopped by the caller");
  return true;
}

Branch trace(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
             std::vector<Monitor> monitors, Observer observer) {
  Tracer tracer(std::move(problem), start, options, std::move(monitors), std::move(observer));
  while (tracer.step()) {
  }
  return tracer.take();
}

}  // namespace arcslip::continuation
