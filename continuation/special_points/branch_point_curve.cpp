#include <arcslip/continuation/special_points/branch_point_curve.hpp>

#include <arcslip/continuation/special_points/augmented_evaluator.hpp>

#include <cmath>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace arcslip::continuation {
namespace {

struct BranchPointDefinition {
  InnerProblem inner;
  Vector unfolding;
};

// A generic vector with a broad spectrum, orthogonal to no symmetry or mode of vibration.
Vector generic_vector(Eigen::Index size, double phase) {
  Vector c(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto x = static_cast<double>(i);
    c[i] = std::sin(0.7 * x * x + phase) + (i == 0 ? 0.1 : 0);
  }
  return c.normalized();
}

class BranchPointEvaluator final : public AugmentedEvaluator, public Operator {
 public:
  explicit BranchPointEvaluator(std::shared_ptr<const BranchPointDefinition> definition)
      : AugmentedEvaluator({definition, &definition->inner}, 2),
        definition_(std::move(definition)),
        factors_(*inner_),
        scale_(inner_->scales()),
        border_(static_cast<int>(n_), 2),
        C_(n_ + 1, 2),
        V_(n_ + 1, 2),
        trial_V_(n_ + 1, 2),
        G_(n_ + 1, 2),
        g_(2),
        w_(n_ + 2),
        b_(generic_vector(n_, 1.0)),
        dp_(inner_->problem->parameters().size()),
        dg_dp_(dp_.size(), 2),
        work_(n_ + 2) {
    jacobian_ = static_cast<const Operator*>(this);
    C_ << generic_vector(n_ + 1, 0.5).cwiseQuotient(scale_),
        generic_vector(n_ + 1, 2.0).cwiseQuotient(scale_);
  }

  // Borders are updated to the null space with each Jacobian and fixed in between: residuals near a
  // linearization are those of the same equations.
  Evaluated move_to(In x, In p, Needs needs) override {
    const Evaluated result = here_.move_to(x.head(n_ + 1), p);
    if (result != Evaluated::ok) return result;
    if (needs == Needs::residual && adapted_) {
      if (!null_vectors(trial_V_)) return Evaluated::failed;
    } else {
      if (!adapted_) {
        take_border();
        if (!null_vectors(V_) || !left_vector()) return Evaluated::failed;
        next_border();
        adapted_ = true;
      }
      take_border();
      if (!null_vectors(V_)) return Evaluated::failed;
    }
    R_.head(n_) = here_.at().residual() + x[n_ + 1] * definition_->unfolding;
    R_.tail(2) = g_;
    if (needs == Needs::residual) return R_.allFinite() ? Evaluated::ok : Evaluated::failed;
    if (!left_vector()) return Evaluated::failed;
    next_border();
    if (transposed_) transposed_ = gradients();
    return R_.allFinite() && (!transposed_ || G_.allFinite()) ? Evaluated::ok : Evaluated::failed;
  }

  // M at the last point.
  const std::shared_ptr<LinearSolver>& factors() const { return factors_.now(); }
  const Matrix& right() const { return V_; }
  const Vector& g() const { return g_; }
  const Vector& unfolding() const { return definition_->unfolding; }

  // Directional derivative of g in x: from the gradients, or by forward solves with M.
  void derivative(In d, const LinearSolver& M, Out dg) const {
    if (transposed_)
      dg.noalias() = G_.transpose() * d;
    else if (d.norm() == 0)  // or below what can be squared
      dg.setZero();
    else if (nearby_.along(here_, d))
      change_of_g(M, dg);
    else
      dg.setConstant(std::nan(""));
  }

  NullSpace null_space() const {
    NullSpace found{V_, {}, border_.columns.col(1), Matrix(2, 2)};
    if (has_left_) found.left = w_.head(n_);
    Vector dg(2);
    for (int j = 0; j < 2; ++j) {
      derivative(V_.col(j), *factors_.now(), dg);
      found.form.col(j) = -dg;
    }
    found.form = 0.5 * (found.form + found.form.transpose()).eval();
    return found;
  }

 private:
  void further_derivative(int k, Out dG) const override {
    if (transposed_ && second_given_)
      dG = dg_dp_.row(k).transpose();
    else if (nearby_.over(here_, k))
      change_of_g(*factors_.now(), dG);
    else
      dG.setConstant(std::nan(""));
  }

  void take_border() {
    border_.columns.col(1) = b_;
    border_.rows = C_.topRows(n_);
    border_.corner.col(0) = C_.row(n_).transpose();
    border_.corner.col(1).setZero();
  }

  // M of the place of here_, V and g.
  bool null_vectors(Matrix& V) {
    border_.columns.col(0) = here_.F_pa();
    if (!factors_.factorize(here_.at().jacobian(), border_)) return false;
    for (int j = 0; j < 2; ++j) {
      work_.setZero();
      work_[n_ + j] = 1;
      factors_.now()->solve(work_);
      V.col(j) = work_.head(n_ + 1);
      g_[j] = work_[n_ + 1];
    }
    return V.allFinite() && g_.allFinite();
  }

  bool left_vector() {
    w_.setZero();
    w_[n_ + 1] = 1;
    transposed_ = has_left_ = factors_.now()->solve_transposed(w_);
    return w_.allFinite();
  }

  // C = V, orthonormal in scales, and b = w, the best choice for the conditioning of M.
  void next_border() {
    C_ = scale_.cwiseInverse().asDiagonal() * V_;
    C_.col(0).normalize();
    C_.col(1) -= C_.col(0).dot(C_.col(1)) * C_.col(0);
    C_.col(1).normalize();
    C_ = scale_.cwiseInverse().asDiagonal() * C_;
    if (has_left_) b_ = w_.head(n_).normalized();
  }

  // G_j = -d(A^T w) along V_j. False: no transposed products.
  bool gradients() {
    const auto w = w_.head(n_);
    second_given_ = true;
    for (int j = 0; j < 2; ++j) {
      second_given_ = second_given_ && here_.second_derivative(w, V_.col(j), G_.col(j), dp_);
      if (second_given_)
        dg_dp_.col(j) = -dp_;
      else if (!nearby_.along(here_, V_.col(j)))
        G_.col(j).setConstant(std::nan(""));
      else if (!nearby_.transposed_derivative(w, G_.col(j)))
        return false;
      G_.col(j) *= -1;
    }
    return true;
  }

  // dg_j = -w . dA V_j at the neighbouring points, where M (y, w . dA V_j) = (dA V_j, 0).
  void change_of_g(const LinearSolver& M, Out dg) const {
    for (int j = 0; j < 2; ++j) {
      work_.tail(2).setZero();
      nearby_.derivative(V_.col(j), work_.head(n_));
      M.solve(work_);
      dg[j] = -work_[n_ + 1];
    }
  }

  void apply(In d, Out y) const override {
    here_.apply(d.head(n_ + 1), y.head(n_));
    y.head(n_) += d[n_ + 1] * definition_->unfolding;
    derivative(d.head(n_ + 1), *factors_.now(), y.tail(2));
  }

  std::shared_ptr<const BranchPointDefinition> definition_;
  SharedFactors factors_;
  Vector scale_;
  Borders border_;              // of the last Jacobian
  Matrix C_, V_, trial_V_, G_;  // C: of the next Jacobian
  Vector g_, w_, b_, dp_;
  Matrix dg_dp_;
  mutable Vector work_;
  bool adapted_ = false, has_left_ = false, transposed_ = false, second_given_ = false;
};

// Of the Jacobian with borders P, R, D:
//
//   [ A    b_0  P   ] [dx]   [r_1]
//   [ G^T  0    P_g ] [db] = [r_2]
//   [ R    R_b  D   ] [dq]   [r_3].
//
// Where M (X, s) = (Y, 0) for Y = r_1, b_0, P, dx = X_1 + V z - X_0 db - X_P dq solves the first rows if
// s_1 + g . z - s_0 db - s_P dq = 0. With the other rows there remain 3 + m equations in z, db and dq, whose
// matrix S has det [...] = -det M det S.
class BranchPointSolver final : public AugmentedSolver<BranchPointEvaluator> {
 public:
  void solve(Out x) const override {
    const Eigen::Index n = V_.rows() - 1, m = rows_.cols();
    y_ << x.head(n), 0, 0;
    B_->solve(y_);
    at_->derivative(y_.head(n + 1), *B_, dg_);
    rhs_[0] = -y_[n + 1];
    rhs_.segment(1, 2) = x.segment(n, 2) - dg_;
    rhs_.tail(m) = x.tail(m);
    rhs_.tail(m).noalias() -= rows_.topRows(n + 1).transpose() * y_.head(n + 1);
    small_x_.resize(rhs_.size());
    small_.solve(rhs_, small_x_);
    x.head(n + 1) = y_.head(n + 1);
    x.head(n + 1).noalias() += V_ * small_x_.head(2);
    x.head(n + 1).noalias() -= X_ * small_x_.tail(1 + m);
    x.tail(1 + m) = small_x_.tail(1 + m);
  }

  std::optional<int> determinant_sign() const override {
    const auto sign = AugmentedSolver::determinant_sign();
    return sign ? std::optional(-*sign) : sign;
  }

 private:
  void eliminate(const Borders& borders) override {
    V_ = at_->right();
    const Eigen::Index n = V_.rows() - 1, m = borders.width();
    y_.resize(n + 2);
    dg_.resize(2);
    rhs_.resize(3 + m);
    X_.resize(n + 1, 1 + m);
    S_.resize(3 + m, 3 + m);
    S_.row(0).head(2) = at_->g().transpose();
    S_.bottomLeftCorner(m, 2).noalias() = rows_.topRows(n + 1).transpose() * V_;
    for (int j = 0; j < 2; ++j) {
      at_->derivative(V_.col(j), *B_, dg_);
      S_.col(j).segment(1, 2) = dg_;
    }
    for (Eigen::Index j = 0; j <= m; ++j) {
      y_.head(n) = j == 0 ? at_->unfolding() : borders.columns.col(j - 1).head(n);
      y_.tail(2).setZero();
      B_->solve(y_);
      X_.col(j) = y_.head(n + 1);
      at_->derivative(X_.col(j), *B_, dg_);
      S_(0, 2 + j) = -y_[n + 1];
      S_.col(2 + j).segment(1, 2) = -dg_;
      if (j > 0) S_.col(2 + j).segment(1, 2) += borders.columns.col(j - 1).tail(2);
      if (m == 0) continue;  // no border has a row
      S_.col(2 + j).tail(m) = -rows_.topRows(n + 1).transpose() * X_.col(j);
      if (j == 0)
        S_.col(2).tail(m) += rows_.row(n + 1).transpose();
      else
        S_.col(2 + j).tail(m) += borders.corner.col(j - 1);
    }
  }

  Matrix V_, X_;
  mutable Vector dg_;
};

}  // namespace

std::shared_ptr<const Problem> branch_points(std::shared_ptr<const Problem> problem, int along,
                                             Vector unfolding, MakeLinearSolver make_solver) {
  if (unfolding.size() != given(problem)->size())
    throw std::invalid_argument("the direction of unfolding has " + std::to_string(unfolding.size()) +
                                " entries for " + std::to_string(problem->size()) + " equations");
  const auto definition = std::make_shared<const BranchPointDefinition>(
      BranchPointDefinition{{std::move(problem), along, std::move(make_solver)}, std::move(unfolding)});
  return augmented(
      {definition, &definition->inner}, Vector::Ones(1),
      [definition] { return std::make_unique<BranchPointEvaluator>(definition); },
      [] { return std::make_unique<BranchPointSolver>(); });
}

NullSpace null_space(const Evaluator& at) {
  const auto* known = dynamic_cast<const BranchPointEvaluator*>(&at);
  if (!known) throw std::invalid_argument("this evaluator is not one of branch_points()");
  return known->null_space();
}

}  // namespace arcslip::continuation
