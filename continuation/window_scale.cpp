#include <arcslip/continuation/window_scale.hpp>

#include <arcslip/continuation/linear_solver.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace arcslip::continuation {
namespace {

constexpr double smallest_width = 1e-150, largest_width = 1e150;  // whose squares are numbers

class ScaledProblem final : public Problem {
 public:
  ScaledProblem(std::shared_ptr<const Problem> problem, std::size_t free, double scale)
      : problem_(std::move(problem)) {
    const auto all = problem_->parameters();
    parameters_.assign(all.begin(), all.end());
    parameters_[free].scale = scale;
  }
  int size() const override { return problem_->size(); }
  std::span<const Parameter> parameters() const override { return parameters_; }
  Vector scales() const override { return problem_->scales(); }
  bool metric(In v, Out Mv) const override { return problem_->metric(v, Mv); }
  std::unique_ptr<Evaluator> evaluator() const override { return problem_->evaluator(); }
  bool cheap_residual() const override { return problem_->cheap_residual(); }
  std::unique_ptr<LinearSolver> linear_solver() const override { return problem_->linear_solver(); }

 private:
  std::shared_ptr<const Problem> problem_;
  std::vector<Parameter> parameters_;
};

}  // namespace

std::shared_ptr<const Problem> scaled_to_window(std::shared_ptr<const Problem> problem, int free,
                                                double lower, double upper) {
  const auto index = static_cast<std::size_t>(free);
  if (!problem || free < 0 || index >= problem->parameters().size()) return problem;  // refused elsewhere
  const Parameter& parameter = problem->parameters()[index];
  if (parameter.scale != 0) return problem;
  const double width = std::min(upper, parameter.upper) - std::max(lower, parameter.lower);
  return std::make_shared<const ScaledProblem>(std::move(problem), index,
                                               std::clamp(width, smallest_width, largest_width));
}

}  // namespace arcslip::continuation
