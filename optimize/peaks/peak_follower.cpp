#include <arcslip/optimize/peaks/peak_follower.hpp>

#include <utility>

namespace arcslip::optimize {
namespace {

using namespace continuation;

// The equations at a design. Their one parameter does nothing: the corrector keeps it fixed.
class AtDesign final : public Evaluator {
 public:
  AtDesign(std::shared_ptr<const DesignPoint> point, std::unique_ptr<Evaluator> equations)
      : point_(std::move(point)), equations_(std::move(equations)) {}

  Evaluated move_to(In x, In, Needs needs) override { return equations_->move_to(x, point_->p, needs); }
  const Vector& residual() const override { return equations_->residual(); }
  const Jacobian& jacobian() const override { return equations_->jacobian(); }
  void parameter_derivative(int, Out dE) const override { dE.setZero(); }
  std::uint64_t piece() const override { return equations_->piece(); }
  Evaluator& equations() { return *equations_; }

 private:
  std::shared_ptr<const DesignPoint> point_;
  std::unique_ptr<Evaluator> equations_;
};

class DesignProblem final : public Problem {
 public:
  DesignProblem(std::shared_ptr<const DesignPoint> point, std::shared_ptr<const Problem> equations)
      : point_(std::move(point)), equations_(std::move(equations)) {}

  int size() const override { return equations_->size(); }
  std::span<const Parameter> parameters() const override { return {&fixed_, 1}; }
  Vector scales() const override { return equations_->scales(); }
  bool metric(In v, Out Mv) const override { return equations_->metric(v, Mv); }
  std::unique_ptr<Evaluator> evaluator() const override {
    return std::make_unique<AtDesign>(point_, equations_->evaluator());
  }
  bool cheap_residual() const override { return equations_->cheap_residual(); }
  bool chord_pays() const override { return equations_->chord_pays(); }
  std::unique_ptr<LinearSolver> linear_solver() const override { return equations_->linear_solver(); }

 private:
  std::shared_ptr<const DesignPoint> point_;
  std::shared_ptr<const Problem> equations_;
  Parameter fixed_{"design", "-"};
};

}  // namespace

PeakFollower::PeakFollower(std::shared_ptr<const Problem> equations, std::vector<int> over,
                           const Vector& base)
    : point_(std::make_shared<DesignPoint>(DesignPoint{std::move(over), base})),
      problem_(std::make_shared<DesignProblem>(point_, std::move(equations))),
      corrector_(*problem_, Vector::Zero(1), 0, {}, counts_),
      v_(Vector::Zero(problem_->size() + 1)),
      row_(Vector::Unit(problem_->size() + 1, problem_->size())) {}

void PeakFollower::move(std::span<const double> design) {
  for (std::size_t k = 0; k < design.size(); ++k) point_->p[point_->over[k]] = design[k];
}

bool PeakFollower::correct(Vector& x, std::span<const double> design) {
  move(design);
  v_.head(x.size()) = x;
  v_[x.size()] = 0;
  factorized_ = corrector_.correct(v_, row_, false).converged;
  if (factorized_) x = v_.head(x.size());
  return factorized_;
}

bool PeakFollower::linearize(const Vector& x, std::span<const double> design) {
  move(design);
  v_.head(x.size()) = x;
  v_[x.size()] = 0;
  return factorized_ = corrector_.linearize(v_, row_);
}

bool PeakFollower::is_at(const Vector& x, std::span<const double> design) const {
  if (!factorized_ || v_.head(x.size()) != x) return false;
  for (std::size_t k = 0; k < design.size(); ++k)
    if (point_->p[point_->over[k]] != design[k]) return false;
  return true;
}

Vector PeakFollower::tangent(std::size_t k) {
  const Eigen::Index n = v_.size() - 1;
  Vector t = Vector::Zero(n + 1);
  at().parameter_derivative(point_->over[k], t.head(n));
  t = -t;
  corrector_.factors().solve(t);
  return t.head(n);
}

Evaluator& PeakFollower::at() {
  return static_cast<AtDesign&>(corrector_.evaluator()).equations();
}

}  // namespace arcslip::optimize
