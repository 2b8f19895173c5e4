#include <arcslip/optimize/nlopt/run.hpp>

#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/optimize/nlopt/interrupted.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::optimize {

using continuation::text;
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::string list_of(const std::vector<double>& x) {
  std::string list;
  for (double xi : x) list += text(list.empty() ? "" : ", ", xi);
  return "(" + list + ")";
}

std::string tolerance(double relative, double absolute) {  // 0: not looked at
  const std::string first = text(relative, " relative"), second = text(absolute, " absolute");
  return absolute == 0 ? first : relative == 0 ? second : first + " or " + second;
}

std::string what(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const std::exception& e) {
    return e.what();
  } catch (...) {
    return "something other than a std::exception";
  }
}

}  // namespace

Run::Run(const NonlinearProgram& problem, const MinimizeOptions& options, nlopt_opt handle)
    : problem_(problem),
      options_(options),
      handle_(handle),
      values_(problem.constraints.size() + 1, not_a_number) {}

double Run::objective(std::span<const double> x, std::span<double> gradient) noexcept {
  // Some algorithms check their limit only once in several calls.
  if (!interrupted_ && evaluations_ >= options_.evaluations) interrupt(MinimizeReason::evaluation_limit);
  const double value = call(0, problem_.objective, x, gradient);
  return std::isfinite(value) ? value : barrier();
}

double Run::constraint(std::size_t k, std::span<const double> x, std::span<double> gradient) noexcept {
  const double value = call(k + 1, problem_.constraints[k].function, x, gradient);
  return std::isfinite(value) ? value : 0;
}

// NaN once the run is to stop.
double Run::call(std::size_t k, const Function& function, std::span<const double> x,
                 std::span<double> gradient) noexcept {
  if (interrupted_) {
    // Not earlier: GN_ORIG_DIRECT of NLopt 2.7.1 reads an index that was never set when its first call is its
    // last.
    nlopt_force_stop(handle_);
    std::fill(gradient.begin(), gradient.end(), 0.0);
    return not_a_number;
  }
  std::fill(gradient.begin(), gradient.end(), not_a_number);
  if (std::any_of(x.begin(), x.end(), [](double xi) { return !std::isfinite(xi); })) {
    interrupt(MinimizeReason::rounding);  // SLSQP divides by zero where no step keeps two constraints
    std::fill(gradient.begin(), gradient.end(), 0.0);
    return not_a_number;
  }

  double value = not_a_number;
  std::size_t called = k;
  try {
    if (k == 0) ++evaluations_;
    value = function(x, gradient);
    take(k, x, gradient, value);
    called = problem_.constraints.size() + 1;
    if (k == 0 && !interrupted_) report(x, value);
  } catch (const Interrupted&) {
    interrupt(MinimizeReason::user);
  } catch (...) {
    thrown_ = std::current_exception();
    interrupt(MinimizeReason::objective_failed, called);
  }
  if (!interrupted_ && options_.seconds > 0 && seconds() >= options_.seconds)
    interrupt(MinimizeReason::time_limit);
  if (!std::isfinite(value)) std::fill(gradient.begin(), gradient.end(), 0.0);  // it has no meaning there
  return value;
}

// Checks the result of function k.
void Run::take(std::size_t k, std::span<const double> x, std::span<const double> gradient, double value) {
  if (k == 0 && value == HUGE_VAL && worst_ > -HUGE_VAL) return;  // outside the domain, but not at the start
  const auto odd =
      std::find_if_not(gradient.begin(), gradient.end(), [](double g) { return std::isfinite(g); });
  if (!std::isfinite(value)) {
    odd_ = value;
    return interrupt(MinimizeReason::not_finite, k);
  }
  if (odd != gradient.end()) {
    odd_ = *odd;
    odd_entry_ = static_cast<std::size_t>(odd - gradient.begin());
    return interrupt(MinimizeReason::not_finite, k);
  }
  if (k == 0) worst_ = std::max(worst_, value);

  if (!std::equal(x.begin(), x.end(), x_.begin(), x_.end())) {
    x_.assign(x.begin(), x.end());
    std::fill(values_.begin(), values_.end(), not_a_number);
  }
  values_[k] = value;
  keep_if_best();
}

// Objective and constraints are called one after the other at the same x, in an order that depends on the
// algorithm. The point can be assessed once all are known.
void Run::keep_if_best() {
  if (std::any_of(values_.begin(), values_.end(), [](double v) { return std::isnan(v); })) return;
  double excess = 0;
  for (std::size_t k = 0; k < problem_.constraints.size(); ++k)
    if (values_[k + 1] > problem_.constraints[k].tolerance) excess = std::max(excess, values_[k + 1]);
  if (excess < best_excess_ || (excess == best_excess_ && values_[0] < best_value_)) {
    best_x_ = x_;
    best_value_ = values_[0];
    best_excess_ = excess;
  }
}

void Run::report(std::span<const double> x, double value) {
  if (!options_.progress) return;
  const double best = best_excess_ == 0 ? best_value_ : HUGE_VAL;
  if (!options_.progress({evaluations_, x, value, best})) interrupt(MinimizeReason::user);
}

// The value passed to an algorithm for an infinite objective: above all others, but finite, since algorithms
// fit models to it.
double Run::barrier() const noexcept {
  if (worst_ == -HUGE_VAL) return 0;
  const double spread = best_value_ < worst_ ? worst_ - best_value_ : 0;
  const double above = std::max(std::abs(worst_), spread);
  return worst_ + (above > 0 ? above : 1);
}

void Run::interrupt(MinimizeReason reason, std::size_t blamed) noexcept {
  interrupted_ = reason;
  blamed_ = blamed;
}

double Run::seconds() const noexcept {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

MinimizeResult Run::result(int nlopt_result, const char* nlopt_message) const {
  MinimizeResult r;
  r.x = best_x_;
  r.value = best_value_;
  r.feasible = best_excess_ == 0;
  r.evaluations = evaluations_;
  r.seconds = seconds();
  r.reason = interrupted_.value_or(reason_of(nlopt_result));
  r.cause = cause(r, nlopt_message);
  r.message = message(r);
  return r;
}

std::string Run::blamed_name() const {
  if (blamed_ == 0) return "the objective";
  if (blamed_ <= problem_.constraints.size())
    return "constraint \"" + problem_.constraints[blamed_ - 1].name + "\"";
  return "the progress callback";
}

std::string Run::message(const MinimizeResult& r) const {
  const std::string excess = r.feasible ? "" : text(", where a constraint is exceeded by ", best_excess_);
  const std::string best = r.x.empty() ? "; no evaluation succeeded"
                                       : text("; the best value is ", r.value, " at ", list_of(r.x), excess);
  if (r.reason == MinimizeReason::evaluation_limit) return r.cause + best;
  return r.cause + text(" after ", r.evaluations, r.evaluations == 1 ? " evaluation" : " evaluations", best);
}

std::string Run::cause(const MinimizeResult& r, const char* nlopt_message) const {
  const Tolerances& t = options_.tolerances;
  const std::string& algorithm = options_.algorithm;
  const std::string said = nlopt_message ? text(": ", nlopt_message) : "";
  switch (r.reason) {
    case MinimizeReason::converged:
      return algorithm + " found a minimum";
    case MinimizeReason::converged_value:
      return "a step changed the value by less than " + tolerance(t.f_relative, t.f_absolute);
    case MinimizeReason::converged_step:
      return "a step changed the variables by less than " + tolerance(t.x_relative, t.x_absolute);
    case MinimizeReason::target:
      return text("the value reached the target ", options_.target);
    case MinimizeReason::evaluation_limit:
      return text("the limit of ", options_.evaluations, " evaluations was reached");
    case MinimizeReason::time_limit:
      return text("the limit of ", options_.seconds, " s was reached at ", r.seconds, " s");
    case MinimizeReason::user:
      return "the progress callback stopped the run";
    case MinimizeReason::rounding:
      return "rounding errors prevented further progress";
    case MinimizeReason::objective_failed:
      return blamed_name() + " threw \"" + what(thrown_) + "\"";
    case MinimizeReason::not_finite:
      return (odd_entry_ ? text("entry ", *odd_entry_, " of the gradient of ") : "") + blamed_name() +
             text(" is ", odd_);
    case MinimizeReason::invalid_arguments:
      return "NLopt refused to run " + algorithm + said;
    case MinimizeReason::out_of_memory:
      return algorithm + " ran out of memory";
    case MinimizeReason::failed:
      return algorithm + " gave up" + said;
  }
  return "";
}

}  // namespace arcslip::optimize
