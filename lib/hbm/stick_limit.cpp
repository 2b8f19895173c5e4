#include <arcslip/hbm/stick_limit.hpp>

#include <cmath>
#include <limits>

namespace arcslip::hbm {
namespace {

using continuation::Evaluated;
using continuation::Needs;

constexpr double beside = 1e-11;  // of mu F_n: so far from h = 0 the sides are looked at

class StickLimitEvaluator final : public continuation::Evaluator {
 public:
  StickLimitEvaluator(std::shared_ptr<const HbmProblem> problem, int element)
      : problem_(std::move(problem)),
        n_(problem_->size()),
        inner_(problem_->hbm_evaluator()),
        limit_(*problem_, element),
        R_(n_ + 1),
        dh_(n_),
        jacobian_(Eigen::MatrixXd(n_ + 1, n_ + 1)) {}

  Evaluated move_to(continuation::In x, continuation::In p, Needs needs) override {
    p_ = p;
    p_[model::frequency] = x[n_];
    const Evaluated result = inner_->move_to(x.head(n_), p_, needs);
    if (result != Evaluated::ok) return result;
    const auto h = limit_.at(x.head(n_), p_, dh_);
    if (!h) return Evaluated::outside_domain;
    R_ << inner_->residual(), *h;
    if (needs == Needs::residual) return result;
    auto& J = std::get<Eigen::MatrixXd>(jacobian_);
    J.topLeftCorner(n_, n_) = std::get<Eigen::MatrixXd>(inner_->jacobian());
    inner_->parameter_derivative(model::frequency, J.col(n_).head(n_));
    J.row(n_).head(n_) = dh_.transpose();
    J(n_, n_) = 0;
    return result;
  }
  const Vector& residual() const override { return R_; }
  const continuation::Jacobian& jacobian() const override { return jacobian_; }
  void parameter_derivative(int k, continuation::Out dR) const override {
    dR.setZero();
    if (k == model::frequency) return;
    inner_->parameter_derivative(k, dR.head(n_));
    dR[n_] = limit_.parameter_derivative(k);
  }

 private:
  std::shared_ptr<const HbmProblem> problem_;
  Eigen::Index n_;
  std::unique_ptr<HbmEvaluator> inner_;
  StickLimit limit_;
  Vector p_, R_, dh_;
  continuation::Jacobian jacobian_;
};

class StickLimitProblem final : public continuation::Problem {
 public:
  StickLimitProblem(std::shared_ptr<const HbmProblem> problem, int element)
      : problem_(std::move(problem)), element_(element) {}
  int size() const override { return problem_->size() + 1; }
  std::span<const continuation::Parameter> parameters() const override { return problem_->parameters(); }
  Vector scales() const override {
    Vector scales(size());
    scales << problem_->scales(), problem_->parameters()[model::frequency].scale;
    return scales;
  }
  std::unique_ptr<continuation::Evaluator> evaluator() const override {
    return std::make_unique<StickLimitEvaluator>(problem_, element_);
  }

 private:
  std::shared_ptr<const HbmProblem> problem_;
  int element_;
};

}  // namespace

StickLimit::StickLimit(const HbmProblem& problem, int element)
    : harmonics_(problem.harmonics()),
      parameters_(problem.model().elements[static_cast<std::size_t>(element)].parameters),
      reversals_(harmonics_),
      motion_(harmonics_.size()),
      phi_(harmonics_.size()) {
  const int r = problem.coordinates().unknowns;
  const Vector d = problem.coordinates().P.leftCols(r).transpose() *
                   problem.model().elements[static_cast<std::size_t>(element)].direction;
  for (int i = 0; i < r; ++i)
    if (std::abs(d[i]) > 1e-12 * d.norm()) direction_.emplace_back(i, d[i]);
}

std::optional<double> StickLimit::at(In u, In p, Out dh) {
  stiffness_ = p[parameters_[0]];
  friction_ = p[parameters_[1]];
  load_ = p[parameters_[2]];
  const int c = harmonics_.size();
  motion_.setZero();
  for (const auto& [i, weight] : direction_) motion_ += weight * u.segment(i * c, c);
  const auto& turns = reversals_.find(motion_);
  if (turns.empty()) return {};
  elements::Reversal highest = turns.front(), lowest = turns.front();
  for (const auto& turn : turns) {
    if (turn.x > highest.x) highest = turn;
    if (turn.x < lowest.x) lowest = turn;
  }
  dh.setZero();
  const auto add = [&](const elements::Reversal& turn, double sign) {
    elements::series_basis(harmonics_, turn.theta, phi_);
    for (const auto& [i, weight] : direction_)
      dh.segment(i * c, c) += 0.5 * stiffness_ * sign * weight * phi_;
  };
  if (harmonics_.odd) {  // half a period: the other half is the negative
    const bool up = highest.x > -lowest.x;
    range_ = 2 * (up ? highest.x : -lowest.x);
    add(up ? highest : lowest, up ? 2 : -2);
  } else {
    range_ = highest.x - lowest.x;
    add(highest, 1);
    add(lowest, -1);
  }
  return 0.5 * stiffness_ * range_ - limit();
}

double StickLimit::parameter_derivative(int k) const {
  double sum = 0;
  if (parameters_[0] == k) sum += 0.5 * range_;
  if (parameters_[1] == k) sum -= load_;
  if (parameters_[2] == k) sum -= friction_;
  return sum;
}

std::shared_ptr<const continuation::Problem> stick_limit_points(std::shared_ptr<const HbmProblem> problem,
                                                                int element) {
  return std::make_shared<StickLimitProblem>(std::move(problem), element);
}

Corner::Corner(std::shared_ptr<const HbmProblem> problem, int element, continuation::Quantity quantity)
    : problem_(std::move(problem)),
      limit_(*problem_, element),
      quantity_(std::move(quantity)),
      evaluator_(problem_->hbm_evaluator()),
      border_(problem_->size(), 1),
      dh_(problem_->size()),
      dq_(problem_->size()),
      t_(problem_->size() + 1),
      scales_(problem_->size() + 1) {
  scales_ << problem_->scales(), problem_->parameters()[model::frequency].scale;
}

CornerSlopes Corner::slopes(In x, In p) {
  const Eigen::Index n = problem_->size();
  const double none = std::numeric_limits<double>::quiet_NaN();
  u_ = x.head(n);
  p_ = p;
  p_[model::frequency] = x[n];
  CornerSlopes slopes{none, none, 0};
  if (!limit_.at(u_, p_, dh_)) return slopes;
  slopes.slip = slope(1, slopes.direction);
  slopes.stick = slope(-1, slopes.direction);
  return slopes;
}

// The border row is grad h: the solution points to growing h, and the sign of the determinant says whether
// that is the orientation.
double Corner::slope(double side, int& direction) {
  const Eigen::Index n = problem_->size();
  const double none = std::numeric_limits<double>::quiet_NaN();
  beside_ = u_ + side * beside * limit_.limit() / dh_.squaredNorm() * dh_;
  if (evaluator_->move_to(beside_, p_, Needs::jacobian) != Evaluated::ok) return none;
  evaluator_->parameter_derivative(model::frequency, border_.columns.col(0));
  border_.rows.col(0) = dh_;
  border_.corner(0, 0) = 0;
  if (!solver_) solver_ = continuation::suitable_solver(evaluator_->jacobian());
  if (!solver_->factorize(evaluator_->jacobian(), border_)) return none;
  t_ = Vector::Unit(n + 1, n);
  solver_->solve(t_);
  direction = solver_->determinant_sign().value_or(1);
  t_ *= direction / t_.cwiseQuotient(scales_).norm();
  quantity_.gradient(*evaluator_, beside_, p_, dq_);
  return dq_.dot(t_.head(n)) +
         quantity_.parameter_derivative(*evaluator_, beside_, p_, model::frequency) * t_[n];
}

}  // namespace arcslip::hbm
