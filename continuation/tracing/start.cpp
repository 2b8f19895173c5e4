#include <arcslip/continuation/tracing/start.hpp>

#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/continuation/special_points/augmented_problem.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace arcslip::continuation {
namespace {

// Distances are measured in scales: invalid ones are rejected here, not found by a failing branch.
void check_scales(const Problem& problem) {
  const Vector scales = problem.scales();
  if (scales.size() != problem.size())
    throw std::invalid_argument("the problem has " + std::to_string(scales.size()) + " scales for " +
                                std::to_string(problem.size()) + " unknowns");
  if (!scales.allFinite() || !(scales.minCoeff() > 0))
    throw std::invalid_argument("the scales of the unknowns must be positive and finite");
  for (const Parameter& parameter : problem.parameters())
    if (!(parameter.scale >= 0 && std::isfinite(parameter.scale)))
      throw std::invalid_argument("the scale of the parameter \"" + parameter.name + "\" is " +
                                  text(parameter.scale) +
                                  ", must be positive and finite, or 0 for the width of its window");
}

}  // namespace

namespace {

std::string no_parameter(int free, std::size_t count) {
  return "the free parameter has index " + std::to_string(free) + ", but the problem has " +
         std::to_string(count) +
         (count == 1 ? " parameter, with index 0" : " parameters, with indices from 0");
}

// A parameter that can be free, and its window.
void check_free(const Problem& problem, int free, const Options& options) {
  const auto parameters = problem.parameters();
  if (free < 0 || static_cast<std::size_t>(free) >= parameters.size())
    throw std::invalid_argument(no_parameter(free, parameters.size()));
  const Parameter& parameter = parameters[static_cast<std::size_t>(free)];
  if (problem.is_unknown(free))
    throw std::invalid_argument("the parameter \"" + parameter.name +
                                "\" is among the unknowns of this problem: another one has to be free");
  if (!(std::max(options.lower, parameter.lower) < std::min(options.upper, parameter.upper)))
    throw std::invalid_argument("the window [" + text(options.lower) + ", " + text(options.upper) +
                                "] has no part within the bounds [" + text(parameter.lower) + ", " +
                                text(parameter.upper) + "] of the parameter \"" + parameter.name + "\"");
}

// Of a problem with a state.
void check_state_of_problem(const Problem& problem, const Vector& state, const char* whose) {
  const Eigen::Index size = problem.initial_state().size();
  if (state.size() != size)
    throw std::invalid_argument(
        text("the state of ", whose, " has ", state.size(), " numbers, that of the problem ", size));
  if (!state.allFinite()) throw std::invalid_argument(text("the state of ", whose, " is not finite"));
}

}  // namespace

void check_start(const Problem& problem, const Start& start, const Options& options) {
  const int n = problem.size();
  const auto parameters = problem.parameters();
  if (n < 1) throw std::invalid_argument("the problem has no unknowns");
  check_parameters(parameters);
  if (start.u.size() != n)
    throw std::invalid_argument("the start has " + std::to_string(start.u.size()) +
                                " unknowns, the problem " + std::to_string(n));
  if (start.p.size() != static_cast<Eigen::Index>(parameters.size()))
    throw std::invalid_argument("the start has " + std::to_string(start.p.size()) +
                                " parameters, the problem " + std::to_string(parameters.size()));
  const int index = start.free.in(problem);
  check_free(problem, index, options);
  if (start.tangent.size() != 0 && (start.tangent.size() != n + 1 || !start.tangent.allFinite()))
    throw std::invalid_argument("the tangent of the start needs " + std::to_string(n + 1) +
                                " finite entries, not " + std::to_string(start.tangent.size()));
  if (start.tangent.size() != 0 && start.tangent.isZero(0))
    throw std::invalid_argument("the tangent of the start is zero");
  if (start.direction != 1 && start.direction != -1)
    throw std::invalid_argument("the direction of the start is " + std::to_string(start.direction) +
                                ", must be +1 or -1");
  const double p = start.p[index];
  if (!start.u.allFinite() || !std::isfinite(p))
    throw std::invalid_argument("the start has non-finite values");
  if (p < options.lower || p > options.upper)
    throw std::invalid_argument("the start is at " + text(p) + ", outside the window [" +
                                text(options.lower) + ", " + text(options.upper) + "]");
  const Parameter& free = parameters[static_cast<std::size_t>(index)];
  if (p < free.lower || p > free.upper)
    throw std::invalid_argument("the start is at " + text(p) + ", outside the bounds [" + text(free.lower) +
                                ", " + text(free.upper) + "] of the parameter \"" + free.name + "\"");
  if (start.state.size() != 0) check_state_of_problem(problem, start.state, "the start");
  check_scales(problem);
}

void check_state(const Problem& problem, const State& state, std::size_t monitors) {
  const int n = problem.size();
  if (state.free < 0 || static_cast<std::size_t>(state.free) >= problem.parameters().size())
    throw std::invalid_argument("of the state: " + no_parameter(state.free, problem.parameters().size()));
  if (state.here.v.size() != n + 1 ||
      state.p.size() != static_cast<Eigen::Index>(problem.parameters().size()) ||
      state.courses.size() != monitors)
    throw std::invalid_argument("the state has " + std::to_string(state.here.v.size() - 1) + " unknowns, " +
                                std::to_string(state.p.size()) + " parameters and " +
                                std::to_string(state.courses.size()) + " monitors, the problem has " +
                                std::to_string(n) + ", " + std::to_string(problem.parameters().size()) +
                                " and " + std::to_string(monitors));
  check_state_of_problem(problem, state.accepted, "the trace");
  check_scales(problem);
}

void check_monitors(const std::vector<Monitor>& monitors) {
  for (const Monitor& monitor : monitors)
    if (!monitor.value)
      throw std::invalid_argument("the monitor \"" + monitor.name + "\" has no value function");
}

namespace {

constexpr double smallest_width = 1e-150, largest_width = 1e150;  // whose squares are numbers

// The problem of the user, but for what a trace knows better.
class ProblemOfTrace : public Problem {
 public:
  explicit ProblemOfTrace(std::shared_ptr<const Problem> problem) : problem_(std::move(problem)) {}
  int size() const override { return problem_->size(); }
  std::span<const Parameter> parameters() const override { return problem_->parameters(); }
  Vector scales() const override { return problem_->scales(); }
  bool metric(In v, Out Mv) const override { return problem_->metric(v, Mv); }
  std::unique_ptr<Evaluator> evaluator() const override { return problem_->evaluator(); }
  Vector initial_state() const override { return problem_->initial_state(); }
  bool cheap_residual() const override { return problem_->cheap_residual(); }
  bool chord_pays() const override { return problem_->chord_pays(); }
  bool smooth() const override { return problem_->smooth(); }
  bool is_unknown(int k) const override { return problem_->is_unknown(k); }
  const Problem* made_of(PlaceOfProblem& place) const override { return problem_->made_of(place); }
  std::unique_ptr<LinearSolver> linear_solver() const override { return problem_->linear_solver(); }

 private:
  std::shared_ptr<const Problem> problem_;
};

class ScaledProblem final : public ProblemOfTrace {
 public:
  ScaledProblem(std::shared_ptr<const Problem> problem, std::size_t free, double scale)
      : ProblemOfTrace(std::move(problem)) {
    const auto all = ProblemOfTrace::parameters();
    parameters_.assign(all.begin(), all.end());
    parameters_[free].scale = scale;
  }
  std::span<const Parameter> parameters() const override { return parameters_; }

 private:
  std::vector<Parameter> parameters_;
};

class ProblemInState final : public ProblemOfTrace {
 public:
  ProblemInState(std::shared_ptr<const Problem> problem, const Vector& accepted)
      : ProblemOfTrace(std::move(problem)), accepted_(accepted) {}
  std::unique_ptr<Evaluator> evaluator() const override {
    auto made = ProblemOfTrace::evaluator();
    made->set_state(accepted_);
    return made;
  }
  Vector initial_state() const override { return accepted_; }
  // The other problem is not in this state.
  const Problem* made_of(PlaceOfProblem&) const override { return nullptr; }

 private:
  const Vector& accepted_;
};

}  // namespace

std::shared_ptr<const Problem> scaled_to_window(std::shared_ptr<const Problem> problem, int free,
                                                double lower, double upper) {
  const auto index = static_cast<std::size_t>(free);
  if (!problem || free < 0 || index >= problem->parameters().size()) return problem;  // rejected elsewhere
  const Parameter& parameter = problem->parameters()[index];
  if (parameter.scale != 0) return problem;
  const double width = std::clamp(std::min(upper, parameter.upper) - std::max(lower, parameter.lower),
                                  smallest_width, largest_width);
  if (auto scaled = problem->with_scale(free, width)) return scaled;
  return std::make_shared<const ScaledProblem>(std::move(problem), index, width);
}

std::shared_ptr<const Problem> in_state(std::shared_ptr<const Problem> problem, const Vector& accepted) {
  if (problem->initial_state().size() == 0) return problem;
  return std::make_shared<const ProblemInState>(std::move(problem), accepted);
}

}  // namespace arcslip::continuation
