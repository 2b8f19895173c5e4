// Start of a trace: from a start point, or from a saved state.

#include <arcslip/continuation/inner_problem.hpp>
#include <arcslip/continuation/jacobian_check.hpp>
#include <arcslip/continuation/reduction.hpp>
#include <arcslip/continuation/start.hpp>
#include <arcslip/continuation/text.hpp>
#include <arcslip/continuation/tracer.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double first_share_of_window = 0.01;  // |dp| of a step by default
constexpr const char* remedy =
    ": at a fold or a branch point p does not determine the direction, and a start needs a tangent "
    "(Start::tangent)";

}  // namespace

Tracer::Tracer(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
               std::vector<Monitor> monitors, Observer observer)
    : problem_(scaled_to_window(given(std::move(problem)), start.free, options.lower, options.upper)),
      options_(options),
      monitors_(std::move(monitors)),
      observer_(std::move(observer)),
      n_(problem_->size()) {
  check(options);
  check_start(*problem_, start, options);
  check_monitors(monitors_);
  s_.free = start.free;
  s_.direction = start.direction;
  s_.p = start.p;
  s_.here.v.resize(n_ + 1);
  s_.here.v << start.u, start.p[s_.free];
  s_.here.tangent = start.tangent;
  make_tools();
}

Tracer::Tracer(std::shared_ptr<const Problem> problem, State state, const Options& options,
               std::vector<Monitor> monitors, Observer observer)
    : problem_(scaled_to_window(given(std::move(problem)), state.free, options.lower, options.upper)),
      options_(options),
      monitors_(std::move(monitors)),
      observer_(std::move(observer)),
      s_(std::move(state)),
      n_(problem_->size()) {
  check(options);
  check_state(*problem_, s_, monitors_.size());
  check_monitors(monitors_);
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
  main_->restore(s_.factors);
  s_.factors = {};
  if (std::any_of(monitors_.begin(), monitors_.end(),
                  [](const Monitor& each) { return each.kind == MonitorKind::branch_point; }))
    modes_ = std::make_unique<ModeCounter>(*problem_, s_.p, s_.free, s_.branch.counts);
  next_ = s_.here;
  next_.tangent.resize(n_ + 1);
  row_.resize(n_ + 1);
  v_.resize(n_ + 1);
}

State Tracer::save() const {
  State state = s_;
  state.factors = main_->memory();
  return state;
}

// Appended to the message that the linearization at the start is singular.
std::string Tracer::singular_start(bool has_tangent) const {
  const std::string doubt = doubt_of_isolation(*problem_, s_.here.v, s_.p, s_.free, options_.linear_solver);
  return !doubt.empty() || has_tangent ? doubt : remedy;
}

bool Tracer::begin() {
  s_.begun = true;
  const bool given = s_.here.tangent.size() != 0;
  if (!given) s_.here.tangent = Vector::Unit(n_ + 1, n_);
  main_->border_row(s_.here.tangent, row_);
  const Correction correction = main_->correct(s_.here.v, row_, false);
  if (correction.singular)
    return end(StopReason::start_failed, correction.last, options_.newton.tolerance,
               "the linearization at the start is singular" + because(main_->failure()) +
                   (main_->failure().empty() ? singular_start(given) : ""));
  if (!correction.converged && correction.evaluated) {
    std::string doubts = doubt(s_.here.v);
    if (doubts.empty() && correction.linear && !given) doubts = std::string("; it converges slowly") + remedy;
    return end(StopReason::start_failed, correction.last, options_.newton.tolerance,
               "the corrector did not converge at the start (" + std::to_string(correction.iterations) +
                   " iterations)" + doubts + because(main_->failure()));
  }
  if (!correction.converged)
    return end(StopReason::not_evaluated, correction.last, options_.newton.tolerance,
               "the problem could not be evaluated at the start" + because(main_->failure()));
  if (!settle(*main_, s_.here)) {
    const std::string& failure = main_->failure();
    return end(failure.empty() ? StopReason::start_failed : StopReason::not_evaluated, 0, 0,
               failure.empty() ? "the linearization at the start is singular" + singular_start(given)
                               : "the problem could not be evaluated at the start: " + failure);
  }
  if (!given && s_.direction < 0) s_.here.reverse();
  s_.branch.linear_solver = main_->factors().name();
  const double to_scale = 1 / main_->parameter_scale();
  const double along = to_scale * std::abs(s_.here.tangent[n_]);
  s_.step = options_.step.initial > 0
                ? options_.step.initial
                : 0.1 * to_scale * options_.step.largest_parameter / std::max(along, 1e-3);
  s_.step = limited(s_.step);
  keep(s_.here, correction);
  evaluate(monitors_, *main_, s_.here);
  warn_of_undefined(s_.here);
  s_.start = s_.before = s_.here;
  s_.factors_fit = false;  // their border row is that of the start
  look_at_jacobian(s_.here.v);
  if (!notify()) return end(StopReason::user, 1, 1, "stopped by the caller");
  return within_limits();
}

// Diagnostics of a trace: wrong Jacobians, and the causes of rejected steps.

namespace {

constexpr long seldom = 8;  // checks of the Jacobian: at the 1st, 8th, 64th ... occasion
constexpr double standstill =
    1e-3;  // of the longest step: a branch with a wrong Jacobian ends at shorter steps
constexpr long many_rejections = 20;  // which are also more than a quarter of the points

}  // namespace

bool Tracer::is_due(long times) {
  while (times > 0 && times % seldom == 0) times /= seldom;
  return times == 1;
}

void Tracer::look_at_jacobian(const Vector& v) {
  if (!options_.check_jacobian || !s_.jacobian_doubt.empty() || !v.allFinite()) return;
  Vector p = s_.p;
  p[s_.free] = v[n_];
  const JacobianError found = doubt_jacobian(*problem_, v.head(n_), p, s_.free);
  if (found.message.empty()) return;
  s_.jacobian_doubt = found.message;
  s_.jacobian_error = found.relative;
  s_.branch.warnings.push_back(found.message + " (at " + text(v[n_]) +
                               "): tangents and events are equally wrong, and the branch may end early");
}

// A correction to v did not converge quadratically.
void Tracer::suspect(const Vector& v) {
  if (!is_due(++s_.slow)) return;
  look_at_jacobian(s_.here.v);
  look_at_jacobian(v);
}

// Appended to the message that Newton's method failed.
std::string Tracer::doubt(const Vector& v) {
  if (s_.jacobian_doubt.empty()) look_at_jacobian(v);
  return s_.jacobian_doubt.empty() ? std::string() : "; " + s_.jacobian_doubt;
}

bool Tracer::gets_on() const {
  if (s_.jacobian_doubt.empty()) return true;
  const Counts& counts = s_.branch.counts;
  return s_.step >= standstill * s_.longest &&
         !(counts.rejected_steps >= many_rejections && 4 * counts.rejected_steps > counts.points);
}

Tracer::Attempt Tracer::refuse(Rejected why, double value, double limit, Attempt as) {
  rejection_.why = why;
  rejection_.value = value;
  rejection_.limit = limit;
  return as;
}

void Tracer::log_rejection() {
  if (!options_.on_rejection) return;
  rejection_.arclength = s_.here.arclength;
  rejection_.parameter = s_.here.v[n_];
  rejection_.step = s_.step;
  rejection_.words = rejection_.why == Rejected::quantity ? monitors_[unresolved_].name : failure_;
  options_.on_rejection(rejection_);
}

}  // namespace arcslip::continuation
