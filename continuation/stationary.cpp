#include <arcslip/continuation/stationary.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double difference = 6e-6;         // of central differences, relative
constexpr double smaller_difference = 0.1;  // where a kink lies within
constexpr int smaller_differences = 4;

struct Definition {
  std::shared_ptr<const Problem> problem;
  int along;
  Quantity quantity;
  MakeLinearSolver make_solver;
};

// The inner problem at one x = (u, p_a), and dq/dx there.
class Site {
 public:
  explicit Site(const Definition& definition)
      : definition_(definition),
        evaluator_(definition.problem->evaluator()),
        q_x(definition.problem->size() + 1),
        F_p(definition.problem->size()) {}

  Evaluated move_to(const Vector& x, In p, Needs needs) {
    const Eigen::Index n = x.size() - 1;
    p_ = p;
    p_[definition_.along] = x[n];
    const Evaluated result = evaluator_->move_to(x.head(n), p_, needs);
    if (result != Evaluated::ok || needs == Needs::residual) return result;
    evaluator_->parameter_derivative(definition_.along, F_p);
    definition_.quantity.gradient(*evaluator_, x.head(n), p_, q_x.head(n));
    q_x[n] = definition_.quantity.parameter_derivative(*evaluator_, x.head(n), p_, definition_.along);
    u_ = x.head(n);
    return F_p.allFinite() && q_x.allFinite() ? Evaluated::ok : Evaluated::failed;
  }

  double quantity_derivative(int k) const {
    return definition_.quantity.parameter_derivative(*evaluator_, u_, p_, k);
  }
  // y = A d
  void apply(const Vector& d, Out y) const {
    const Eigen::Index n = d.size() - 1;
    continuation::apply(evaluator_->jacobian(), d.head(n), y);
    y += d[n] * F_p;
  }
  // y = A^T w
  bool apply_transposed(const Vector& w, Vector& y) const {
    const Eigen::Index n = w.size();
    if (!continuation::apply_transposed(evaluator_->jacobian(), w, y.head(n))) return false;
    y[n] = F_p.dot(w);
    return true;
  }
  Evaluator& at() const { return *evaluator_; }

 private:
  const Definition& definition_;
  std::unique_ptr<Evaluator> evaluator_;
  Vector p_, u_;

 public:
  Vector q_x, F_p;  // dq/dx, n + 1; dF/dp_a, n
};

class StationaryEvaluator final : public Evaluator, public Operator {
 public:
  explicit StationaryEvaluator(std::shared_ptr<const Definition> definition)
      : definition_(std::move(definition)),
        n_(definition_->problem->size()),
        here_(*definition_),
        ahead_(*definition_),
        behind_(*definition_),
        scale_(n_ + 1),
        border_(static_cast<int>(n_), 1),
        c_(n_ + 1),
        R_(n_ + 1),
        t_(n_ + 1),
        z_(n_ + 1),
        G_x_(n_ + 1),
        x_(n_ + 1),
        work_(n_ + 1),
        work_n_(n_),
        jacobian_(static_cast<const Operator*>(this)) {
    scale_ << definition_->problem->scales(),
        definition_->problem->parameters()[static_cast<std::size_t>(definition_->along)].scale;
    // Until there is a tangent, a border row that no symmetry makes orthogonal to it.
    for (Eigen::Index i = 0; i <= n_; ++i)
      c_[i] = (1 + 0.3 * std::sin(7.0 * static_cast<double>(i))) / scale_[i];
  }

  Evaluated move_to(In x, In p, Needs needs) override {
    x_ = x;
    p_ = p;
    const Evaluated result = here_.move_to(x_, p, Needs::jacobian);
    if (result != Evaluated::ok) return result;
    if (!tangent()) return Evaluated::failed;
    if (first_) {
      first_ = false;
      take_border();
      if (!tangent()) return Evaluated::failed;
    }
    R_.head(n_) = here_.at().residual();
    R_[n_] = here_.q_x.dot(t_);
    if (needs == Needs::residual) return std::isfinite(R_[n_]) ? Evaluated::ok : Evaluated::failed;
    z_ = here_.q_x;
    transposed_ = solver_->solve_transposed(z_);
    take_border();
    return differentiate(t_) && (!transposed_ || gradient()) ? Evaluated::ok : Evaluated::failed;
  }

  const Vector& residual() const override { return R_; }
  const Jacobian& jacobian() const override { return jacobian_; }

  void parameter_derivative(int k, Out dR) const override {
    if (k == definition_->along) {
      dR.setZero();
      return;
    }
    here_.at().parameter_derivative(k, dR.head(n_));
    dR[n_] = transposed_ ? derivative_by_symmetry(k) : derivative_by_differences(k);
  }

  std::uint64_t piece() const override { return here_.at().piece(); }

  // B at the last place. As long as somebody holds it, the next place is factorized elsewhere.
  const std::shared_ptr<LinearSolver>& factors() const { return solver_; }
  const Vector& tangent_of_branch() const { return t_; }
  bool has_gradient() const { return transposed_; }
  const Vector& gradient_of_G() const { return G_x_; }

  // dG in a direction of x, by a forward solve with B.
  double along(const Vector& d, const LinearSolver& B) const {
    if (!differentiate(d)) return std::nan("");
    return change_of_G(B);
  }
  double second_derivative_of_q() const { return transposed_ ? G_x_.dot(t_) : along(t_, *solver_); }
  double left_times_right() const { return transposed_ ? z_.head(n_).dot(t_.head(n_)) : 1; }

 private:
  std::unique_ptr<LinearSolver> make_solver() const {
    auto solver =
        definition_->make_solver ? definition_->make_solver() : definition_->problem->linear_solver();
    return solver ? std::move(solver) : suitable_solver(here_.at().jacobian());
  }

  // t of the place of here_.
  bool tangent() {
    border_.columns.col(0) = here_.F_p;
    border_.rows.col(0) = c_.head(n_);
    border_.corner(0, 0) = c_[n_];
    if (solver_.use_count() > 1) std::swap(solver_, spare_);
    if (!solver_) solver_ = make_solver();
    if (!solver_->factorize(here_.at().jacobian(), border_)) return false;
    t_.setZero();
    t_[n_] = 1;
    solver_->solve(t_);
    return t_.allFinite();
  }

  // The next border row is this tangent, as is best for the conditioning of B.
  void take_border() {
    const double length = t_.cwiseQuotient(scale_).squaredNorm();
    if (length > 0 && std::isfinite(length))
      c_ = t_.cwiseQuotient(scale_).cwiseQuotient(scale_) / std::sqrt(length);
  }

  // Moves ahead_ and behind_ to x + h d and x - h d, within the smooth piece of x if there is room.
  bool differentiate(const Vector& d) const {
    const double length = d.cwiseQuotient(scale_).norm();
    if (!(length > 0)) return false;
    h_ = difference * std::max(1.0, x_.cwiseQuotient(scale_).norm()) / length;
    for (int k = 0;; ++k, h_ *= smaller_difference) {
      work_ = x_ + h_ * d;
      if (ahead_.move_to(work_, p_, Needs::jacobian) != Evaluated::ok) return false;
      work_ = x_ - h_ * d;
      if (behind_.move_to(work_, p_, Needs::jacobian) != Evaluated::ok) return false;
      const std::uint64_t piece = here_.at().piece();
      if (k == smaller_differences || (ahead_.at().piece() == piece && behind_.at().piece() == piece))
        return true;
    }
  }

  // G_x = [dq/dx - A^T w] from x - h t to x + h t, by the symmetry of second derivatives.
  bool gradient() {
    const Vector w = z_.head(n_);
    if (!ahead_.apply_transposed(w, G_x_) || !behind_.apply_transposed(w, work_)) return false;
    G_x_ = (ahead_.q_x - behind_.q_x - (G_x_ - work_)) / (2 * h_);
    return G_x_.allFinite();
  }

  double derivative_by_symmetry(int k) const {
    ahead_.at().parameter_derivative(k, work_n_);
    double change = ahead_.quantity_derivative(k) - z_.head(n_).dot(work_n_);
    behind_.at().parameter_derivative(k, work_n_);
    change -= behind_.quantity_derivative(k) - z_.head(n_).dot(work_n_);
    return change / (2 * h_);
  }

  double derivative_by_differences(int k) const {
    const double scale = definition_->problem->parameters()[static_cast<std::size_t>(k)].scale;
    h_ = difference * std::max(std::abs(p_[k]), scale);
    Vector p = p_;
    p[k] = p_[k] + h_;
    if (ahead_.move_to(x_, p, Needs::jacobian) != Evaluated::ok) return std::nan("");
    p[k] = p_[k] - h_;
    if (behind_.move_to(x_, p, Needs::jacobian) != Evaluated::ok) return std::nan("");
    return change_of_G(*solver_);
  }

  // From behind_ to ahead_: (d(dq/dx) . t - dq/dx . B^-1 (dA t, 0)).
  double change_of_G(const LinearSolver& B) const {
    ahead_.apply(t_, work_n_);
    work_.head(n_) = work_n_;
    behind_.apply(t_, work_n_);
    work_.head(n_) -= work_n_;
    work_[n_] = 0;
    B.solve(work_);
    return ((ahead_.q_x - behind_.q_x).dot(t_) - here_.q_x.dot(work_)) / (2 * h_);
  }

  void apply(In d, Out y) const override {
    work_ = d;
    here_.apply(work_, y.head(n_));
    y[n_] = transposed_ ? G_x_.dot(d) : along(d, *solver_);
  }

  std::shared_ptr<const Definition> definition_;
  Eigen::Index n_;
  Site here_;
  mutable Site ahead_, behind_;
  Vector scale_;
  Borders border_;
  std::shared_ptr<LinearSolver> solver_, spare_;
  Vector c_, R_, t_, z_, G_x_, x_, p_;
  mutable Vector work_, work_n_;
  mutable double h_ = 1;
  bool first_ = true, transposed_ = false;
  Jacobian jacobian_;
};

// Of [A F_p; G_x G_p; r_x r_p]: with x = B^-1 (y, zeta) there remain as many equations as zeta and the free
// parameters.
class StationarySolver final : public LinearSolver {
 public:
  const char* name() const override { return "block elimination in the branch's factors"; }

  bool factorize(const Jacobian& jacobian, const Borders& borders) override {
    const auto* const* op = std::get_if<const Operator*>(&jacobian);
    if (!op) return false;
    at_ = dynamic_cast<const StationaryEvaluator*>(*op);
    if (!at_) return false;
    t_ = at_->tangent_of_branch();
    G_x_ = at_->gradient_of_G();
    has_gradient_ = at_->has_gradient();
    B_ = at_->factors();
    const Eigen::Index n = t_.size() - 1, m = borders.width();
    rows_ = borders.rows;
    X_.resize(n + 1, m);
    for (Eigen::Index j = 0; j < m; ++j) {
      y_.resize(n + 1);
      y_ << borders.columns.col(j).head(n), 0;
      B_->solve(y_);
      X_.col(j) = y_;
    }
    Matrix S(1 + m, 1 + m);
    S(0, 0) = dG(t_);
    for (Eigen::Index j = 0; j < m; ++j) S(0, 1 + j) = borders.columns(n, j) - dG(X_.col(j));
    S.block(1, 0, m, 1) = rows_.transpose() * t_;
    S.block(1, 1, m, m) = borders.corner - rows_.transpose() * X_;
    if (!S.allFinite()) return false;
    small_.compute(S);
    rhs_.resize(1 + m);
    determinant_ = small_.determinant();
    return determinant_ != 0 && std::isfinite(determinant_);
  }

  void solve(Out x) const override {
    const Eigen::Index n = t_.size() - 1, m = X_.cols();
    y_ << x.head(n), 0;
    B_->solve(y_);
    rhs_[0] = x[n] - dG(y_);
    rhs_.tail(m) = x.tail(m) - rows_.transpose() * y_;
    rhs_ = small_.solve(rhs_).eval();
    x.head(n + 1) = y_ + rhs_[0] * t_ - X_ * rhs_.tail(m);
    x.tail(m) = rhs_.tail(m);
  }

  std::optional<int> determinant_sign() const override {
    const auto sign = B_->determinant_sign();
    if (!sign) return sign;
    return determinant_ > 0 ? *sign : -*sign;
  }

 private:
  double dG(const Vector& d) const {
    if (has_gradient_) return G_x_.dot(d);
    return d.isZero(0) ? 0 : at_->along(d, *B_);
  }

  const StationaryEvaluator* at_ = nullptr;
  std::shared_ptr<LinearSolver> B_;
  Vector t_, G_x_;
  bool has_gradient_ = false;
  Matrix rows_, X_;
  Eigen::PartialPivLU<Matrix> small_;
  double determinant_ = 1;
  mutable Vector y_, rhs_;
};

class StationaryProblem final : public Problem {
 public:
  explicit StationaryProblem(Definition definition)
      : definition_(std::make_shared<const Definition>(std::move(definition))) {}

  int size() const override { return definition_->problem->size() + 1; }
  std::span<const Parameter> parameters() const override { return definition_->problem->parameters(); }
  Vector scales() const override {
    Vector scale(size());
    scale << definition_->problem->scales(), along().scale;
    return scale;
  }
  bool metric(In v, Out Mv) const override {
    const Eigen::Index n = v.size() - 1;
    Mv[n] = v[n] / (along().scale * along().scale);
    return definition_->problem->metric(v.head(n), Mv.head(n));
  }
  std::unique_ptr<Evaluator> evaluator() const override {
    return std::make_unique<StationaryEvaluator>(definition_);
  }
  std::unique_ptr<LinearSolver> linear_solver() const override {
    return std::make_unique<StationarySolver>();
  }
  bool cheap_residual() const override { return false; }

 private:
  const Parameter& along() const {
    return definition_->problem->parameters()[static_cast<std::size_t>(definition_->along)];
  }
  std::shared_ptr<const Definition> definition_;
};

const StationaryEvaluator& stationary(const Accepted& now) {
  const auto* at = dynamic_cast<const StationaryEvaluator*>(&now.at);
  if (!at) throw std::invalid_argument("this monitor is for curves of folds and of stationary points");
  return *at;
}

}  // namespace

std::shared_ptr<const Problem> stationary_points(std::shared_ptr<const Problem> problem, int along,
                                                 Quantity quantity, MakeLinearSolver make_solver) {
  const auto count = problem->parameters().size();
  if (along < 0 || static_cast<std::size_t>(along) >= count)
    throw std::out_of_range("there is no parameter " + std::to_string(along) + " among " +
                            std::to_string(count));
  return std::make_shared<StationaryProblem>(
      Definition{std::move(problem), along, std::move(quantity), std::move(make_solver)});
}

std::shared_ptr<const Problem> folds(std::shared_ptr<const Problem> problem, int along,
                                     MakeLinearSolver make_solver) {
  Quantity parameter;
  parameter.gradient = [](Evaluator&, In, In, Out dq_du) { dq_du.setZero(); };
  parameter.parameter_derivative = [along](Evaluator&, In, In, int k) { return k == along ? 1.0 : 0.0; };
  return stationary_points(std::move(problem), along, std::move(parameter), std::move(make_solver));
}

Monitor cusp_monitor() {
  return {"cusp", [](const Accepted& now) { return stationary(now).second_derivative_of_q(); }};
}

Monitor bogdanov_takens_monitor() {
  return {"bogdanov_takens", [](const Accepted& now) { return stationary(now).left_times_right(); }};
}

Vector with_parameter(const Point& point) {
  Vector x(point.u.size() + 1);
  x << point.u, point.parameter;
  return x;
}

}  // namespace arcslip::continuation
