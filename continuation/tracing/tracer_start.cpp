// Start of a trace: from a start point, or from a saved state.

#include <arcslip/continuation/correction/first_point.hpp>
#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/continuation/special_points/augmented_problem.hpp>
#include <arcslip/continuation/special_points/dependent_equations.hpp>
#include <arcslip/continuation/special_points/lyapunov_schmidt.hpp>
#include <arcslip/continuation/tracing/start.hpp>
#include <arcslip/continuation/tracing/tracer_impl.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double first_share_of_window = 0.01;  // |dp| of a step by default

// The window cut to the parameter's bounds, and the largest |dp| of a step.
Options within(const Parameter& free, Options options) {
  options.lower = std::max(options.lower, free.lower);
  options.upper = std::min(options.upper, free.upper);
  if (options.step.largest_parameter == 0)
    options.step.largest_parameter = first_share_of_window * (options.upper - options.lower);
  return options;
}

State before_the_start(const Problem& problem, const Start& start) {
  State state;
  state.accepted = start.state.size() != 0 ? start.state : problem.initial_state();
  state.free = start.free.in(problem);
  state.direction = start.direction;
  state.p = start.p;
  state.here.v.resize(start.u.size() + 1);
  state.here.v << start.u, start.p[state.free];
  state.here.tangent = start.tangent;
  return state;
}

bool looks_for_branch_points(const std::vector<Monitor>& monitors) {
  return std::any_of(monitors.begin(), monitors.end(),
                     [](const Monitor& each) { return each.kind == MonitorKind::branch_point; });
}

}  // namespace

Tracer::Tracer(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
               std::vector<Monitor> monitors, Observer observer) {
  const int free = start.free.in(*given(problem));
  problem = scaled_to_window(std::move(problem), free, options.lower, options.upper);
  check(options);
  if (options.stability) check(*options.stability, problem->size());
  check_start(*problem, start, options);
  check_monitors(monitors);
  State state = before_the_start(*problem, start);
  impl_ = std::make_unique<Impl>(std::move(problem), std::move(state), options, std::move(monitors),
                                 std::move(observer));
}

Tracer::Tracer(std::shared_ptr<const Problem> problem, State state, const Options& options,
               std::vector<Monitor> monitors, Observer observer) {
  problem = scaled_to_window(given(std::move(problem)), state.free, options.lower, options.upper);
  check(options);
  if (options.stability) check(*options.stability, problem->size());
  check_state(*problem, state, monitors.size());
  check_monitors(monitors);
  impl_ = std::make_unique<Impl>(std::move(problem), std::move(state), options, std::move(monitors),
                                 std::move(observer));
}

Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;
Tracer::~Tracer() = default;

bool Tracer::step() {
  return impl_->step();
}

State Tracer::save() const {
  return impl_->save();
}

const Branch& Tracer::branch() const {
  return impl_->branch();
}

Branch Tracer::take() {
  return std::move(impl_->branch());
}

Branch trace(std::shared_ptr<const Problem> problem, const Start& start, const Options& options,
             std::vector<Monitor> monitors, Observer observer) {
  Tracer tracer(std::move(problem), start, options, std::move(monitors), std::move(observer));
  while (tracer.step()) {
  }
  return tracer.take();
}

Tracer::Impl::Impl(std::shared_ptr<const Problem> problem, State state, const Options& options,
                   std::vector<Monitor> monitors, Observer observer)
    : problem_(in_state(std::move(problem), s_.accepted)),
      options_(within(problem_->parameters()[static_cast<std::size_t>(state.free)], options)),
      timed_(options_.control.until(options_.seconds)),
      monitors_(std::move(monitors)),
      s_(std::move(state)),
      n_(problem_->size()),
      main_(*problem_, s_.p, s_.free, options_.newton, s_.branch.counts, options_.linear_solver),
      events_(problem_, s_.p, s_.free, options_, monitors_, s_.courses, s_.branch.counts),
      counts_modes_(looks_for_branch_points(monitors_)),
      transverse_(main_, s_),
      control_(options_, s_, main_),
      interpolation_(options_, monitors_, events_.looks_for_kinks(), s_, main_),
      jacobian_(*problem_, options_, s_),
      record_(options_, monitors_, std::move(observer), s_, main_, events_),
      row_(n_ + 1),
      v_(n_ + 1),
      next_state_(s_.accepted.size()),
      rejected_before_(s_.branch.counts.rejected_steps) {
  main_.restore(s_.factors);
  s_.factors = {};
  trial_.end = s_.here;
  trial_.end.tangent.resize(n_ + 1);
}

State Tracer::Impl::save() const {
  State state = s_;
  state.factors = main_.memory();
  return state;
}

// Appended to the message that the linearization at the start is singular.
std::string Tracer::Impl::singular_start(bool has_tangent) const {
  const auto& solver = options_.linear_solver;
  std::string doubt = doubt_of_isolation(*problem_, s_.here.v, s_.p, s_.free, solver);
  if (doubt.empty()) doubt = doubt_of_branch_point(*problem_, s_.here.v, s_.p, s_.free);
  return !doubt.empty() || has_tangent ? doubt : needs_tangent;
}

// No solution was found from the guess: the search is at s_.here.
bool Tracer::Impl::end_at_start(const FirstPoint& first, const Vector& guess, bool has_tangent) {
  const Correction& correction = first.correction;
  const auto end_with = [&](StopReason reason, const std::string& message) {
    return end(reason, correction.last, options_.newton.tolerance, message + because(first.failure));
  };
  if (first.is_stopped) {
    s_.here.v = guess;
    return within_limits() && end(StopReason::user, 1, 1, "stopped by the caller");
  }
  if (correction.singular)
    return end_with(StopReason::start_failed, "the linearization at the start is singular" +
                                                  (first.failure.empty() ? singular_start(has_tangent) : ""));
  if (!correction.evaluated)
    return end_with(StopReason::not_evaluated, "the problem could not be evaluated at the start");
  std::string doubts = jacobian_.doubt(s_.here.v, guess);
  if (doubts.empty() && correction.linear && !has_tangent)
    doubts = std::string("; it converges slowly") + needs_tangent;
  return end_with(StopReason::start_failed, "the corrector did not converge at the start (" +
                                                std::to_string(correction.iterations) + " iterations)" +
                                                doubts);
}

bool Tracer::Impl::begin() {
  s_.begun = true;
  const bool given = s_.here.tangent.size() != 0;
  if (!given) s_.here.tangent = Vector::Unit(n_ + 1, n_);
  main_.border_row(s_.here.tangent, row_);
  const Vector guess = s_.here.v;
  // A start with a tangent is a prediction; without, it may be far from the branch.
  const FirstPoint first = given ? FirstPoint{main_.correct(s_.here.v, row_, false), main_.failure()}
                                 : first_point(*problem_, main_, options_, timed_, row_, s_.here.v);
  const Correction& correction = first.correction;
  if (!correction.converged) return end_at_start(first, guess, given);
  if (!settle(main_, s_.here)) {
    const std::string& failure = main_.failure();
    return end(failure.empty() ? StopReason::start_failed : StopReason::not_evaluated, 0, 0,
               failure.empty() ? "the linearization at the start is singular" + singular_start(given)
                               : "the problem could not be evaluated at the start: " + failure);
  }
  if (!given && s_.direction < 0) s_.here.reverse();
  s_.branch.linear_solver = main_.factors().name();
  const double to_scale = 1 / main_.parameter_scale();
  const double along = to_scale * std::abs(s_.here.tangent[n_]);
  s_.step = options_.step.initial > 0
                ? options_.step.initial
                : 0.1 * to_scale * options_.step.largest_parameter / std::max(along, 1e-3);
  s_.step = control_.limited(s_.step);
  record_.keep(s_.here, correction);
  record_.add_spectrum();
  transverse_.keep(trial_, s_.here);
  evaluate(monitors_, main_, s_.here);
  record_.warn_of_undefined(s_.here);
  s_.start = s_.before = s_.here;
  s_.factors_fit = false;  // their border row is that of the start
  jacobian_.look_at(s_.here.v);
  const bool goes_on = record_.show_last_point(false);
  if (!accept_state()) return false;
  return goes_on ? within_limits() : end(StopReason::user, 1, 1, "stopped by the caller");
}

}  // namespace arcslip::continuation
