#include <arcslip/continuation/tracer.hpp>

#include <arcslip/continuation/jacobian_check.hpp>

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
constexpr double parameter_overrun = 1.5;      // of the largest |dp| of a step
constexpr double unresolved_rejection = 0.5;   // of the step where a quantity is not told by its slopes
constexpr double unresolved_change = 0.5;      // of a quantity, against its slopes
constexpr double unresolved_share = 1.0 / 50;  // of the step that was first found unresolved: not shorter
constexpr double quantity_rounding = 1e-9;     // relative changes of a quantity below are not looked at
constexpr double curve_safety = 0.9;           // of the step that the curve's error allows
constexpr double middle_share = 0.7;           // of the largest error of the curve, in the middle of a step
constexpr int window_samples = 16;             // of a step that may pass a bound between its ends
constexpr double singular_bound = 1e-6;  // relative to p: so near to a singular bound a branch has reached it
constexpr int home_bisections = 30;
constexpr double home = 0.05;          // of a step: a start so near to it may lie on it
constexpr double home_rounding = 10;   // of the corrector: two solutions nearer than that are one
constexpr int largest_to_check = 500;  // unknowns, where a failure asks for a check of the Jacobian
constexpr double corner_step = 1e-3;   // beyond a kink, of the step, to linearize there

double angle_between(double cosine) {
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

std::string text(double x) {
  std::ostringstream s;
  s.precision(10);
  s << x;
  return s.str();
}

std::string because(const std::string& failure) {
  return failure.empty() ? failure : ": " + failure;
}

// What to say of a Jacobian that differs from the differences of F, where Newton's method failed.
std::string doubt_of_jacobian(const Problem& problem, In u, In p) {
  if (problem.size() > largest_to_check) return {};
  try {
    const std::string doubt = check_jacobian(problem, u, p).message;
    return doubt.empty() ? doubt : "; " + doubt;
  } catch (const std::exception&) {
    return {};
  }
}

// Distances are measured in them: a wrong one is no place to find out that a branch goes nowhere.
void check_scales(const Problem& problem) {
  const Vector scales = problem.scales();
  if (scales.size() != problem.size())
    throw std::invalid_argument("the problem has " + std::to_string(scales.size()) + " scales for " +
                                std::to_string(problem.size()) + " unknowns");
  if (!scales.allFinite() || !(scales.minCoeff() > 0))
    throw std::invalid_argument("the scales of the unknowns must be positive and finite");
  for (const Parameter& parameter : problem.parameters())
    if (!(parameter.scale > 0 && std::isfinite(parameter.scale)))
      throw std::invalid_argument("the scale of the parameter \"" + parameter.name + "\" is " +
                                  text(parameter.scale) + ", must be positive and finite");
}

// Of the step, where the curve's error is `error` times that allowed: it falls with the fourth power.
double curve_factor(double error) {
  return std::clamp(curve_safety / std::sqrt(std::sqrt(error)), shrinkage, growth);
}

}  // namespace

Tracer::Tracer(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
               std::vector<Monitor> monitors, Observer observer)
    : problem_(std::move(problem)),
      options_(options),
      monitors_(std::move(monitors)),
      observer_(std::move(observer)),
      n_(problem_->size()) {
  check(options);
  const auto parameters = problem_->parameters();
  if (n_ < 1) throw std::invalid_argument("the problem has no unknowns");
  if (start.u.size() != n_)
    throw std::invalid_argument("the start has " + std::to_string(start.u.size()) +
                                " unknowns, the problem " + std::to_string(n_));
  if (start.p.size() != static_cast<Eigen::Index>(parameters.size()))
    throw std::invalid_argument("the start has " + std::to_string(start.p.size()) +
                                " parameters, the problem " + std::to_string(parameters.size()));
  if (start.free < 0 || static_cast<std::size_t>(start.free) >= parameters.size())
    throw std::invalid_argument("the free parameter is number " + std::to_string(start.free) + " of " +
                                std::to_string(parameters.size()));
  if (start.tangent.size() != 0 && (start.tangent.size() != n_ + 1 || !start.tangent.allFinite()))
    throw std::invalid_argument("the tangent of the start needs " + std::to_string(n_ + 1) +
                                " finite entries, not " + std::to_string(start.tangent.size()));
  s_.free = start.free;
  s_.direction = start.direction < 0 ? -1 : 1;
  s_.p = start.p;
  s_.here.v.resize(n_ + 1);
  s_.here.v << start.u, start.p[s_.free];
  if (!s_.here.v.allFinite()) throw std::invalid_argument("the start has numbers that are not finite");
  if (s_.here.v[n_] < options.lower || s_.here.v[n_] > options.upper)
    throw std::invalid_argument("the start is at " + text(s_.here.v[n_]) + ", outside the window [" +
                                text(options.lower) + ", " + text(options.upper) + "]");
  s_.here.tangent = start.tangent;
  check_scales(*problem_);
  make_tools();
}

Tracer::Tracer(std::shared_ptr<const Problem> problem, State state, const Options& options,
               std::vector<Monitor> monitors, Observer observer)
    : problem_(std::move(problem)),
      options_(options),
      monitors_(std::move(monitors)),
      observer_(std::move(observer)),
      s_(std::move(state)),
      n_(problem_->size()) {
  check(options);
  if (s_.free < 0 || static_cast<std::size_t>(s_.free) >= problem_->parameters().size())
    throw std::invalid_argument("the free parameter of the state is number " + std::to_string(s_.free) +
                                " of " + std::to_string(problem_->parameters().size()));
  if (s_.here.v.size() != n_ + 1 || s_.p.size() != static_cast<Eigen::Index>(problem_->parameters().size()) ||
      s_.courses.size() != monitors_.size())
    throw std::invalid_argument("the state is of " + std::to_string(s_.here.v.size() - 1) + " unknowns, " +
                                std::to_string(s_.p.size()) + " parameters and " +
                                std::to_string(s_.courses.size()) + " monitors, the problem of " +
                                std::to_string(n_) + ", " + std::to_string(problem_->parameters().size()) +
                                " and " + std::to_string(monitors_.size()));
  check_scales(*problem_);
  make_tools();
}

void Tracer::make_tools() {
  const Parameter& free = problem_->parameters()[static_cast<std::size_t>(s_.free)];
  options_.lower = std::max(options_.lower, free.lower);
  options_.upper = std::min(options_.upper, free.upper);
  if (options_.step.largest_parameter == 0)
    options_.step.largest_parameter = first_share_of_window * (options_.upper - options_.lower);
  main_ = std::make_unique<Corrector>(*problem_, s_.p, s_.free, options_.newton, s_.branch.counts,
                                      options_.linear_solver);
  events_ = std::make_unique<EventLocator>(problem_, s_.p, s_.free, options_, monitors_, s_.courses,
                                           s_.branch.counts);
  factors_fit_ = false;
  next_ = s_.here;
  next_.tangent.resize(n_ + 1);
  row_.resize(n_ + 1);
  v_.resize(n_ + 1);
}

State Tracer::save() {
  make_tools();
  return s_;
}

bool Tracer::end(StopReason reason, double value, double limit, std::string message) {
  s_.branch.stop = {reason, value, limit, std::move(message)};
  s_.ended = true;
  return false;
}

// For the user's eyes, the evaluator moves the last correction further, onto the point itself.
bool Tracer::notify() {
  if (!observer_) return true;
  main_->move_to(s_.here.v);
  return observer_(accepted(*main_, s_.here), nullptr);
}

bool Tracer::begin() {
  s_.begun = true;
  const bool given = s_.here.tangent.size() != 0;
  if (!given) s_.here.tangent = Vector::Unit(n_ + 1, n_);
  main_->border_row(s_.here.tangent, row_);
  const Correction correction = main_->correct(s_.here.v, row_, false);
  if (correction.singular)
    return end(StopReason::start_failed, correction.last, options_.newton.tolerance,
               "the linearization at the start is singular" + because(main_->failure()));
  if (!correction.converged)
    return end(correction.evaluated ? StopReason::start_failed : StopReason::not_evaluated, correction.last,
               options_.newton.tolerance,
               (correction.evaluated ? "the corrector did not converge at the start (" +
                                           std::to_string(correction.iterations) + " iterations)" +
                                           doubt_of_jacobian(*problem_, s_.here.v.head(n_), s_.p)
                                     : "the problem could not be evaluated at the start") +
                   because(main_->failure()));
  if (!settle(*main_, s_.here))
    return end(StopReason::start_failed, 0, 0, "the linearization at the start is singular");
  if (!given && s_.direction < 0) s_.here.reverse();
  s_.branch.linear_solver = main_->factors().name();
  const double to_scale = 1 / main_->parameter_scale();
  const double along = to_scale * std::abs(s_.here.tangent[n_]);
  s_.step = options_.step.initial > 0
                ? options_.step.initial
                : 0.1 * to_scale * options_.step.largest_parameter / std::max(along, 1e-3);
  s_.step = limited(s_.step);
  evaluate(monitors_, *main_, s_.here);
  s_.start = s_.before = s_.here;
  keep(s_.here, correction);
  factors_fit_ = false;  // their border row is that of the start
  if (!notify()) return end(StopReason::user, 1, 1, "stopped by the caller");
  return within_limits();
}

double Tracer::largest_parameter_step() const {
  const double relative = options_.step.relative_parameter * std::abs(s_.here.v[n_]);
  const double limit = options_.step.largest_parameter;
  return relative > 0 ? std::min(limit, relative) : limit;  // at p = 0 there is no relative limit
}

double Tracer::limited(double ds) const {
  ds = std::min(ds, options_.step.relative_state * (1 + main_->norm_u(s_.here.v)));
  if (options_.step.largest > 0) ds = std::min(ds, options_.step.largest);
  const double along = std::abs(s_.here.tangent[n_]), limit = largest_parameter_step();
  return along * ds > limit ? limit / along : ds;
}

// By the cubic or the secant of the last two points, or, after a kink, at the start or far out, the tangent.
void Tracer::predict(Vector& v) const {
  const Predictor predictor = options_.step.predictor;
  if (predictor != Predictor::tangent && s_.has_before && s_.step <= largest_extrapolation * s_.last_step) {
    const double share = s_.step / s_.last_step;
    if (predictor == Predictor::cubic)
      hermite(s_.before.v, s_.before.tangent, s_.here.v, s_.here.tangent, s_.last_step, 1 + share, v);
    else
      v = s_.here.v + share * (s_.here.v - s_.before.v);
    return;
  }
  v = s_.here.v + s_.step * s_.here.tangent;
}

bool Tracer::step() {
  if (s_.ended) return false;
  if (!s_.begun) return begin();
  for (;;) {
    const double smallest = options_.step.smallest * (1 + main_->norm_u(s_.here.v));
    if (s_.step < smallest)
      return end(evaluated_ ? StopReason::step_too_small : StopReason::not_evaluated, s_.step, smallest,
                 evaluated_ ? "the step fell below its smallest size after rejections" +
                                  doubt_of_jacobian(*problem_, s_.here.v.head(n_), main_->parameters())
                            : "the problem could not be evaluated ahead, however short the step" +
                                  because(failure_));
    switch (attempt()) {
      case Attempt::accepted:
        return !s_.ended;
      case Attempt::ended:
        return false;
      case Attempt::unresolved:
        ++s_.branch.counts.rejected_steps;
        factors_fit_ = false;
        s_.step *= curve_error_ > 1 ? curve_factor(curve_error_) : unresolved_rejection;
        break;
      case Attempt::rejected:
        ++s_.branch.counts.rejected_steps;
        factors_fit_ = false;
        s_.has_before = false;
        if (s_.here.arclength > s_.trouble_end) {
          s_.trouble_end = s_.here.arclength + s_.step;
          s_.rejections = 0;
        }
        if (++s_.rejections >= rejections_before_a_corner && corner()) return !s_.ended;
        factors_fit_ = false;
        s_.step *= rejection;
        break;
    }
  }
}

// Both tangents point one way in p, and p went the other way: another branch, or two folds in one step.
bool Tracer::went_back(const Place& next) const {
  const double a = s_.here.tangent[n_], b = next.tangent[n_], dp = next.v[n_] - s_.here.v[n_];
  return a * b > 0 && a * dp < 0 && std::abs(dp) > parameter_rounding * std::abs(s_.here.v[n_]);
}

// The monitors at the solution of the last correction. Its factors, and so the tangent, are those of a place
// within the corrector's tolerance, which near a sharp peak is enough to turn the sign of a monitor: a change
// of sign is believed from the linearization at the solution itself.
bool Tracer::measure(Place& place) {
  evaluate(monitors_, *main_, place);
  if (!events_->changes_sign(s_.here, place)) return true;
  main_->border_row(place.tangent, v_);
  if (!main_->linearize(place.v, v_) || !settle(*main_, place)) return false;
  evaluate(monitors_, *main_, place);
  return true;
}

// Whether the change of each monitored quantity is that of its slopes at both ends, by the trapezoid. Beside
// a kink it is not, however short the step: in one stretch the step is shortened no further than to a part of
// the first one.
bool Tracer::resolved(const Place& from, const Place& to, double length) {
  if (s_.here.arclength <= s_.unresolved_end && s_.step <= unresolved_share * s_.unresolved_step) return true;
  for (std::size_t m = 0; m < monitors_.size(); ++m) {
    if (!monitors_[m].quantity) continue;
    const double a = from.monitors[m] * length, b = to.monitors[m] * length;
    const double change = to.quantities[m] - from.quantities[m];
    const double size = std::max(std::abs(a), std::abs(b));
    if (std::abs(change - 0.5 * (a + b)) <= unresolved_change * size ||
        size <= quantity_rounding * std::abs(to.quantities[m]))
      continue;
    if (s_.here.arclength > s_.unresolved_end) {
      s_.unresolved_end = s_.here.arclength + length;
      s_.unresolved_step = s_.step;
    }
    return false;
  }
  return true;
}

// Whether a turn of the tangent that is too large is a kink: the piece changes, and the turn does not shrink
// with the step. A turn is first met with a long step and rejected; it is the same one as long as its place
// is not passed.
bool Tracer::is_kink(double turn, const Place& next) {
  if (next.piece == s_.here.piece) return false;
  const State::Turn now{turn, s_.step, s_.here.arclength + 2 * s_.step};
  if (s_.here.arclength > s_.turn.end) s_.turn = now;
  if (s_.step > kink_step * s_.turn.step) return false;
  if (turn >= kink_turn * s_.turn.angle) return true;
  s_.turn = now;  // it shrank, but may stay from here on
  return false;
}

Tracer::Attempt Tracer::attempt() {
  crossing_.reset();
  curve_error_ = 0;
  predict(next_.v);
  main_->border_row(s_.here.tangent, row_);
  const Correction correction = main_->correct(next_.v, row_, factors_fit_, options_.newton.corrector);
  evaluated_ = correction.evaluated && main_->failure().empty();
  failure_ = main_->failure();
  if (!correction.converged) return Attempt::rejected;

  v_ = next_.v - s_.here.v;
  const double length = std::sqrt(main_->dot(v_, v_));
  if (!(length > 0) || !settle(*main_, next_) || went_back(next_)) return Attempt::rejected;

  const double turn = angle_between(
      std::min(main_->dot(next_.tangent, s_.here.tangent), main_->dot(v_, s_.here.tangent) / length));
  bool kink = false;
  if (turn > options_.step.largest_angle) {
    kink = is_kink(turn, next_);
    if (!kink || next_.orientation != s_.here.orientation) return Attempt::rejected;
  } else if (next_.orientation != s_.here.orientation) {
    // A jump to a branch near by, unless branches cross here, or it stays however short the step.
    next_.arclength = s_.here.arclength + length;
    crossing_ = events_->branch_point(s_.here, next_);
    if (!crossing_ && s_.step > branch_point_step * (1 + main_->norm_u(s_.here.v))) return Attempt::rejected;
    if (!crossing_) crossing_ = unlocated_branch_point(s_.here, next_);
  }
  // The tangent may turn towards the parameter within the step.
  const double moved = std::abs(next_.v[n_] - s_.here.v[n_]);
  if (!kink && moved > parameter_overrun * largest_parameter_step()) return Attempt::unresolved;
  if (!measure(next_)) return Attempt::rejected;
  if (next_.piece == s_.here.piece) curve_error_ = curve_error(length);
  if (curve_error_ > 1 || !resolved(s_.here, next_, length)) return Attempt::unresolved;
  const double next_ds = kink ? s_.turn.step * kink_step : choose_step(turn, correction);
  return take(length, next_ds, kink, correction);
}

// Where the branch turns by any angle at a kink just ahead: goes to the kink, linearizes beyond it, and steps
// along the tangent there, whose direction the sign of the determinant tells.
bool Tracer::corner() {
  crossing_.reset();
  curve_error_ = 0;
  v_ = s_.here.v + s_.step * s_.here.tangent;
  if (!main_->move_to(v_) || main_->evaluator().piece() == s_.here.piece) return false;
  Place kink;
  Correction correction;
  if (!locate_kink(*main_, s_.here, s_.step, kink, correction)) return false;
  Corner sides;
  const double way = kink.arclength - s_.here.arclength;
  bool has_sides = look_beside(kink, kink.tangent, -corner_step * way, sides.before) &&
                   sides.before.piece == s_.here.piece;
  sides.before.v = kink.v;
  sides.before.arclength = kink.arclength;
  curve_error_ = 0;
  if (has_sides && !resolved(s_.here, sides.before, way)) return false;
  next_.v = kink.v + corner_step * s_.step * s_.here.tangent;
  main_->border_row(s_.here.tangent, row_);
  if (!main_->linearize(next_.v, row_) ||
      !settle(*main_, next_)) {  // at a right angle, a row that is neither
    row_.setZero();
    row_[n_] = 1;
    if (!main_->linearize(next_.v, row_) || !settle(*main_, next_)) return false;
  }
  if (next_.piece == s_.here.piece) return false;
  if (next_.orientation != s_.here.orientation) next_.tangent = -next_.tangent;
  const Vector beyond = next_.tangent;
  next_.v = kink.v + s_.step * beyond;
  main_->border_row(beyond, row_);
  correction = main_->correct(next_.v, row_, false);
  if (!correction.converged || !settle(*main_, next_)) return false;
  v_ = next_.v - kink.v;
  const double length = std::sqrt(main_->dot(v_, v_));
  if (next_.piece == s_.here.piece || next_.orientation != s_.here.orientation || !(length > 0) ||
      angle_between(main_->dot(next_.tangent, beyond)) > options_.step.largest_angle ||
      angle_between(main_->dot(v_, beyond) / length) > options_.step.largest_angle)
    return false;
  if (!measure(next_)) return false;
  has_sides = has_sides && look_beside(kink, beyond, corner_step * s_.step, sides.beyond) &&
              sides.beyond.piece != s_.here.piece;
  if (has_sides && !resolved(sides.beyond, next_, length)) return false;
  return take(way + length, s_.step, true, correction, has_sides ? &sides : nullptr) != Attempt::rejected;
}

// A place shortly before (way < 0) or beyond a kink, on the branch, with its monitors.
bool Tracer::look_beside(const Place& kink, const Vector& tangent, double way, Place& side) {
  side.v = kink.v + way * tangent;
  side.tangent = tangent;
  side.arclength = kink.arclength + way;
  main_->border_row(tangent, v_);
  if (!main_->correct(side.v, v_, false).converged || !main_->linearize(side.v, v_) || !settle(*main_, side))
    return false;
  evaluate(monitors_, *main_, side);
  return true;
}

// Accepts next_, or, beyond the window, ends the branch at its bound.
Tracer::Attempt Tracer::take(double length, double next_ds, bool kink, const Correction& correction,
                             const Corner* corner) {
  next_.arclength = s_.here.arclength + length;
  if (const auto [share, bound] = leaves_window(kink ? 0 : length); share <= 1) {
    if (!to_boundary(next_, bound, share)) {
      const double left = std::abs(bound - s_.here.v[n_]);
      if (left > singular_bound * std::max(std::abs(bound), main_->parameter_scale()))
        return Attempt::rejected;
      end(StopReason::boundary, s_.here.v[n_], bound,
          "reached the end of the window at " + text(bound) + ", a singular point");
      return Attempt::ended;
    }
    if (crossing_ && (crossing_->place.v[n_] < options_.lower || crossing_->place.v[n_] > options_.upper))
      crossing_.reset();
    if (accept(std::move(next_), correction))
      end(StopReason::boundary, bound, bound, "reached the end of the window at " + text(bound));
    return Attempt::ended;
  }
  if (!kink && comes_home(length)) {
    // The branch that passes so near is that of the start if it has the same solution in the start's plane.
    v_ += main_->dot(s_.start.v - v_, s_.start.tangent) * s_.start.tangent;
    main_->border_row(s_.start.tangent, row_);
    const bool converged = main_->correct(v_, row_, false).converged;
    const double miss = distance(*main_, v_, s_.start.v);
    const double rounding = rounding_of_home();
    if (converged && miss <= rounding) {
      next_ = s_.start;
      next_.arclength = s_.here.arclength + distance(*main_, s_.here.v, next_.v);
      if (accept(std::move(next_), correction))
        end(StopReason::closed, miss, rounding, "came back to the start: the branch is closed");
      return Attempt::ended;
    }
    main_->border_row(next_.tangent, row_);
    if (!main_->linearize(next_.v, row_)) return Attempt::rejected;
  }
  if (corner && s_.here.arclength > 0 &&
      distance(*main_, corner->before.v, s_.start.v) <= rounding_of_home()) {
    next_ = s_.start;
    next_.arclength = corner->before.arclength;
    if (accept(std::move(next_), correction))
      end(StopReason::closed, distance(*main_, corner->before.v, s_.start.v), rounding_of_home(),
          "came back to the start, a kink: the branch is closed");
    return Attempt::ended;
  }
  s_.last_step = length;
  s_.has_before = !kink;
  factors_fit_ = !kink;
  if (!accept(std::move(next_), correction, corner)) return Attempt::ended;
  s_.step = limited(next_ds);
  return within_limits() ? Attempt::accepted : Attempt::ended;
}

// Whether the start may lie on the step from here to next_: v_ is where their cubic meets its plane.
bool Tracer::comes_home(double length) const {
  if (s_.here.arclength == 0) return false;
  const Place& start = s_.start;
  const auto ahead = [&](const Vector& v) { return main_->dot(start.v - v, start.tangent); };
  double lower = 0, upper = 1, a = ahead(s_.here.v), b = ahead(next_.v);
  if (!(a > 0 && b <= home * length) || distance(*main_, s_.here.v, start.v) > (1 + home) * length)
    return false;
  if (main_->dot(start.tangent, next_.tangent) < std::cos(options_.step.largest_angle)) return false;
  v_ = next_.v;
  for (int k = 0; k < home_bisections && b < 0; ++k) {
    const double middle = lower + (upper - lower) * std::clamp(a / (a - b), 0.1, 0.9);
    hermite(s_.here.v, s_.here.tangent, next_.v, next_.tangent, length, middle, v_);
    const double at = ahead(v_);
    (at > 0 ? lower : upper) = middle;
    (at > 0 ? a : b) = at;
  }
  return distance(*main_, v_, start.v) <= home * length;
}

double Tracer::rounding_of_home() const {
  const double size = 1 + main_->norm_u(s_.start.v) + std::abs(s_.start.v[n_]) / main_->parameter_scale();
  return home_rounding * options_.newton.rounding_level * size;
}

bool Tracer::within_limits() {
  const double state = main_->norm_u(s_.here.v);
  if (state > options_.largest_state)
    return end(StopReason::state_too_large, state, options_.largest_state,
               "the solution grows without bound near " + text(s_.here.v[n_]));
  const auto points = s_.branch.counts.points;
  if (points >= options_.points)
    return end(StopReason::point_limit, static_cast<double>(points), static_cast<double>(options_.points),
               "reached the largest number of points, " + std::to_string(options_.points));
  if (options_.seconds > 0) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
    if (seconds >= options_.seconds)
      return end(StopReason::time_limit, seconds, options_.seconds,
                 "reached the time limit of " + text(options_.seconds) + " s");
  }
  if (options_.memory > 0) {
    const std::size_t each = sizeof(Point) + (options_.keep_points ? sizeof(double) * (2 * n_ + 1) : 0);
    const std::size_t bytes = each * s_.branch.points.size();
    if (bytes >= options_.memory)
      return end(StopReason::memory_limit, static_cast<double>(bytes), static_cast<double>(options_.memory),
                 "the points of the branch fill the " + std::to_string(options_.memory) + " bytes allowed");
  }
  return true;
}

// Of the cubic between here and next_, over that allowed: at its middle, where it is largest but for what the
// fourth derivative changes within the step.
double Tracer::curve_error(double length) {
  const double allowed = middle_share * options_.step.curve_tolerance * (1 + main_->norm_u(next_.v));
  if (!(allowed > 0)) return 0;
  hermite(s_.here.v, s_.here.tangent, next_.v, next_.tangent, length, 0.5, v_);
  const double error = main_->distance_from_branch(v_) / allowed;
  return std::isfinite(error) ? error : 1 / shrinkage;
}

double Tracer::choose_step(double angle, const Correction& correction) const {
  double factor = angle > 0 ? options_.step.angle / angle : growth;
  const bool contraction_counts = correction.first > std::sqrt(options_.newton.tolerance);
  if (contraction_counts && correction.contraction > 0)
    factor = std::min(factor, std::sqrt(options_.step.contraction / correction.contraction));
  if (curve_error_ > 0) factor = std::min(factor, curve_factor(curve_error_));
  return s_.step * std::clamp(factor, shrinkage, growth);
}

// From `place`, beyond the window, back to p = bound.
bool Tracer::to_boundary(Place& place, double bound, double share) {
  const double length = distance(*main_, s_.here.v, place.v);
  hermite(s_.here.v, s_.here.tangent, place.v, place.tangent, length, share, v_);
  v_[n_] = bound;
  place.v = v_;
  row_ = Vector::Unit(n_ + 1, n_);
  if (!main_->correct(place.v, row_, false).converged) return false;
  place.v[n_] = bound;
  if (distance(*main_, v_, place.v) > length || !settle(*main_, place)) return false;  // on another branch
  if (main_->dot(place.tangent, s_.here.tangent) < 0) place.reverse();
  place.arclength = s_.here.arclength + distance(*main_, s_.here.v, place.v);
  return measure(place);
}

// Where the cubic from here to next_, of that length, first leaves the window: as a share of it, with the
// bound. Beyond 1: nowhere. Length 0: the straight line, for a step with a kink.
std::pair<double, double> Tracer::leaves_window(double length) const {
  const double p0 = s_.here.v[n_], p1 = next_.v[n_];
  const double t0 = length * s_.here.tangent[n_], t1 = length * next_.tangent[n_];
  const auto p = [&](double x) {
    const double y = 1 - x;
    return y * y * (1 + 2 * x) * p0 + x * x * (3 - 2 * x) * p1 + x * y * (y * t0 - x * t1);
  };
  const double p_end = std::clamp(p1, options_.lower, options_.upper);
  if (p1 == p_end && t0 * t1 >= 0) return {2, 0};
  if (length == 0) return p1 == p_end ? std::pair{2.0, 0.0} : std::pair{(p_end - p0) / (p1 - p0), p_end};
  double inside = 0;
  for (int k = 1; k <= window_samples; ++k) {
    const double share = static_cast<double>(k) / window_samples, at = k == window_samples ? p1 : p(share);
    const double bound = std::clamp(at, options_.lower, options_.upper);
    if (at == bound) {
      inside = share;
      continue;
    }
    double outside = share;
    for (int bisection = 0; bisection < 50; ++bisection) {
      const double middle = 0.5 * (inside + outside), here = p(middle);
      (here == std::clamp(here, options_.lower, options_.upper) ? inside : outside) = middle;
    }
    return {outside, bound};
  }
  return {2, 0};
}

// In the order of arclength: an event may have waited for a few points until it was certain.
const Event* Tracer::add(Event&& event) {
  const double s = event.point.arclength;
  const auto after = std::upper_bound(s_.branch.points.begin(), s_.branch.points.end(), s,
                                      [](double x, const Point& y) { return x < y.arclength; });
  event.after = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - s_.branch.points.begin(), 1) - 1);
  const auto place = std::upper_bound(s_.branch.events.begin(), s_.branch.events.end(), s,
                                      [](double x, const Event& y) { return x < y.point.arclength; });
  return &*s_.branch.events.insert(place, std::move(event));
}

bool Tracer::report(std::vector<LocatedEvent>&& all) {
  bool go_on = true;
  for (LocatedEvent& found : all) {
    const Event* event = add(std::move(found.event));
    if (observer_ && go_on) {
      const auto now = events_->look_at(found.place);
      if (!now) main_->move_to(found.place.v);  // at a branch point B may be singular to the last bit
      go_on = observer_(now ? *now : accepted(*main_, found.place), event);
    }
    const bool terminal = std::any_of(monitors_.begin(), monitors_.end(), [&](const Monitor& m) {
      return m.terminal && m.name == event->monitor;
    });
    if (terminal && !terminal_) terminal_ = std::move(found.place);
  }
  return go_on;
}

void Tracer::keep(const Place& place, const Correction& correction) {
  Point kept = point(place, correction);
  if (!options_.keep_points) kept.u = kept.tangent = {};
  s_.branch.points.push_back(std::move(kept));
  ++s_.branch.counts.points;
}

// Where pieces of F meet at it, or a branch point that is not simple.
std::optional<LocatedEvent> Tracer::unlocated_branch_point(const Place& from, const Place& to) const {
  LocatedEvent found;
  for (const Monitor& monitor : monitors_)
    if (monitor.kind == MonitorKind::branch_point) found.event.monitor = monitor.name;
  found.event.nonsmooth = from.piece != to.piece;
  found.event.located = found.event.nonsmooth;
  found.event.point = point(from, {});
  BranchPoint half_branches;
  half_branches.tangents = {from.tangent, to.tangent};
  found.event.data = std::move(half_branches);
  found.place = from;
  return found;
}

// The events of a step in the order of arclength: the first terminal one ends the branch.
std::vector<LocatedEvent> Tracer::with_crossing(std::vector<LocatedEvent>&& found) {
  if (crossing_ && !crossing_->event.monitor.empty()) {
    const auto place =
        std::upper_bound(found.begin(), found.end(), crossing_->place.arclength,
                         [](double s, const LocatedEvent& each) { return s < each.event.point.arclength; });
    found.insert(place, std::move(*crossing_));
  }
  crossing_.reset();
  curve_error_ = 0;
  return std::move(found);
}

bool Tracer::accept(Place&& place, const Correction& correction, const Corner* corner) {
  const bool go_on = corner ? report(events_->between(s_.here, corner->before)) &&
                                  report(events_->across(corner->before, corner->beyond)) &&
                                  report(events_->between(corner->beyond, place))
                            : report(with_crossing(events_->between(s_.here, place)));
  if (terminal_) return end_at(*terminal_);
  keep(place, correction);
  std::swap(s_.before, s_.here);
  std::swap(s_.here, place);
  if (!go_on || !notify()) return end(StopReason::user, 1, 1, "stopped by the caller");
  return true;
}

// The branch ends at a terminal event: what was found beyond it, while it was not certain, is dropped.
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
