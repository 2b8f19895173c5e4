#include <arcslip/continuation/special_points/augmented_problem.hpp>

#include <arcslip/continuation/linear/linear_solvers.hpp>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace arcslip::continuation {

std::shared_ptr<const Problem> given(std::shared_ptr<const Problem> problem) {
  if (!problem) throw std::invalid_argument("no problem is given");
  return problem;
}

InnerProblem::InnerProblem(std::shared_ptr<const Problem> which, int index, MakeLinearSolver make)
    : problem(given(std::move(which))), along(index), make_solver(std::move(make)) {
  const auto count = problem->parameters().size();
  if (along < 0 || static_cast<std::size_t>(along) >= count)
    throw std::out_of_range("there is no parameter " + std::to_string(along) + " among " +
                            std::to_string(count));
  if (problem->is_unknown(along))
    throw std::invalid_argument("the parameter \"" + parameter(along).name +
                                "\" is among the unknowns of the problem already");
  if (problem->initial_state().size() != 0)
    throw std::invalid_argument(
        "a curve of special points is of a problem without a state: other parameters leave another state, "
        "which the points of the curve do not pass");
}

Vector InnerProblem::scales() const {
  Vector scales(size() + 1);
  scales << problem->scales(), parameter(along).change();
  return scales;
}

Site::Site(const InnerProblem& inner)
    : along_(inner.along),
      evaluator_(inner.problem->evaluator()),
      x_(inner.size() + 1),
      p_(inner.problem->parameters().size()),
      F_pa_(inner.size()),
      q_(Vector::Zero(p_.size())) {}

Evaluated Site::move_to(In x, In p) {
  x_ = x;
  p_ = p;
  p_[along_] = x[x.size() - 1];
  const Evaluated result = evaluator_->move_to(u(), p_, Needs::jacobian);
  if (result != Evaluated::ok) return result;
  evaluator_->parameter_derivative(along_, F_pa_);
  return F_pa_.allFinite() ? Evaluated::ok : Evaluated::failed;
}

void Site::apply(In d, Out y) const {
  const Eigen::Index n = F_pa_.size();
  continuation::apply(evaluator_->jacobian(), d.head(n), y);
  y += d[n] * F_pa_;
}

bool Site::apply_transposed(In w, Out y) const {
  const Eigen::Index n = F_pa_.size();
  y[n] = F_pa_.dot(w);
  return continuation::apply_transposed(evaluator_->jacobian(), w, y.head(n));
}

bool Site::second_derivative(In w, In d, Out dx, Out dp) {
  const Eigen::Index n = F_pa_.size();
  q_[along_] = d[n];
  if (!evaluator_->second_derivative(w, d.head(n), q_, dx.head(n), dp)) return false;
  dx[n] = dp[along_];
  return true;
}

bool SharedFactors::factorize(const Jacobian& J, const Borders& borders) {
  if (now_.use_count() > 1) std::swap(now_, spare_);
  if (!now_) {
    auto made = inner_.make_solver ? inner_.make_solver() : inner_.problem->linear_solver();
    now_ = made ? std::move(made) : suitable_solver(J);
  }
  return now_->factorize(J, borders);
}

BorderedTangent::BorderedTangent(Vector scales)
    : scales_(std::move(scales)),
      c_(scales_.size()),
      t_(scales_.size()),
      border_(static_cast<int>(scales_.size()) - 1, 1) {
  for (Eigen::Index i = 0; i < c_.size(); ++i)
    c_[i] = (1 + 0.3 * std::sin(7.0 * static_cast<double>(i))) / scales_[i];
}

bool BorderedTangent::compute(SharedFactors& factors, const Jacobian& J, const Vector& F_pa) {
  const Eigen::Index n = t_.size() - 1;
  border_.columns.col(0) = F_pa;
  border_.rows.col(0) = c_.head(n);
  border_.corner(0, 0) = c_[n];
  if (!factors.factorize(J, border_)) return false;
  t_.setZero();
  t_[n] = 1;
  factors.now()->solve(t_);
  return t_.allFinite();
}

void BorderedTangent::take_border() {
  const double length = t_.cwiseQuotient(scales_).squaredNorm();
  if (length > 0 && std::isfinite(length))
    c_ = t_.cwiseQuotient(scales_).cwiseQuotient(scales_) / std::sqrt(length);
}

namespace {

class AugmentedProblem final : public Problem {
 public:
  AugmentedProblem(std::shared_ptr<const InnerProblem> inner, Vector scales,
                   std::function<std::unique_ptr<Evaluator>()> evaluator, MakeLinearSolver linear_solver)
      : inner_(std::move(inner)),
        further_(std::move(scales)),
        evaluator_(std::move(evaluator)),
        linear_solver_(std::move(linear_solver)) {}

  int size() const override { return inner_->size() + 1 + static_cast<int>(further_.size()); }
  std::span<const Parameter> parameters() const override { return inner_->problem->parameters(); }
  Vector scales() const override {
    Vector scales(size());
    scales << inner_->scales(), further_;
    return scales;
  }
  bool metric(In v, Out Mv) const override {
    const Eigen::Index n = inner_->size();
    const double scale = inner_->parameter(inner_->along).change();
    Mv[n] = v[n] / (scale * scale);
    Mv.tail(further_.size()) = v.tail(further_.size()).cwiseQuotient(further_.cwiseAbs2());
    return inner_->problem->metric(v.head(n), Mv.head(n));
  }
  std::unique_ptr<Evaluator> evaluator() const override { return evaluator_(); }
  std::unique_ptr<LinearSolver> linear_solver() const override {
    return linear_solver_ ? linear_solver_() : nullptr;
  }
  bool cheap_residual() const override { return false; }
  bool is_unknown(int k) const override { return k == inner_->along || inner_->problem->is_unknown(k); }
  const Problem* made_of(PlaceOfProblem& place) const override {
    const Eigen::Index n = inner_->size();
    place.p[inner_->along] = place.u[n];
    place.u.conservativeResize(n);
    place.changing.push_back(inner_->along);
    return inner_->problem.get();
  }

 private:
  std::shared_ptr<const InnerProblem> inner_;
  Vector further_;
  std::function<std::unique_ptr<Evaluator>()> evaluator_;
  MakeLinearSolver linear_solver_;
};

}  // namespace

std::shared_ptr<const Problem> augmented(std::shared_ptr<const InnerProblem> inner, Vector scales,
                                         std::function<std::unique_ptr<Evaluator>()> evaluator,
                                         MakeLinearSolver linear_solver) {
  return std::make_shared<AugmentedProblem>(std::move(inner), std::move(scales), std::move(evaluator),
                                            std::move(linear_solver));
}

}  // namespace arcslip::continuation
