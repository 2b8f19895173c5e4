// Curves of folds: F = 0, g = 0 with the bordered J (stationary.hpp).

#include <arcslip/continuation/linear/linear_solvers.hpp>
#include <arcslip/continuation/special_points/augmented_evaluator.hpp>
#include <arcslip/continuation/special_points/on_curve.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

namespace arcslip::continuation {
namespace {

// Of v in the direction of the curve. At a cusp it is 1, above the first; below the second the curve is far
// from any, and below the third the share is zero by a symmetry.
constexpr Eigen::Index largest_with_own_sign = 500;  // of M that is factorized once more for its sign alone
constexpr double share_of_v_at_cusp = 0.5, least_share_of_v = 0.05, no_share_of_v = 1e-9;
constexpr double outgrown = 4;  // times the size of the border b: J has become larger by more

double generic_entry(Eigen::Index i) {
  return 1 + 0.3 * std::sin(7.0 * static_cast<double>(i));
}

class FoldEvaluator final : public AugmentedEvaluator, public Operator, public OnCurveOfStationaryPoints {
 public:
  explicit FoldEvaluator(std::shared_ptr<const InnerProblem> inner)
      : AugmentedEvaluator(std::move(inner), 1),
        factors_(*inner_),
        scale_(inner_->scales()),
        borders_(static_cast<int>(n_), 1),
        b_(n_),
        c_(n_),
        v_(Vector::Zero(n_ + 1)),
        z_(n_ + 1),
        g_x_(n_ + 1),
        g_p_(inner_->problem->parameters().size()),
        Jd_(n_),
        work_(n_ + 1) {
    jacobian_ = static_cast<const Operator*>(this);
    // Generic borders until there are null vectors, orthogonal to them by no symmetry.
    for (Eigen::Index i = 0; i < n_; ++i) {
      b_[i] = generic_entry(i);
      c_[i] = generic_entry(i) / scale_[i];
    }
    b_.normalize();
  }

  Evaluated move_to(In x, In p, Needs needs) override {
    const Evaluated result = here_.move_to(x, p);
    if (result != Evaluated::ok) return result;
    if (!right_vector()) return Evaluated::failed;
    if (first_) {
      first_ = false;
      left_vector();
      take_borders();
      if (!right_vector()) return Evaluated::failed;
    }
    R_ << here_.at().residual(), g_;
    if (needs == Needs::residual) return std::isfinite(g_) ? Evaluated::ok : Evaluated::failed;
    left_vector();
    take_borders();
    if (transposed_) transposed_ = gradient();
    return Evaluated::ok;  // without a gradient, at the end of a piece, the linear solver fails
  }

  ByDifferences by_differences() const override { return {!given_, !given_}; }

  // M at the last point, and what is known there.
  const std::shared_ptr<LinearSolver>& factors() const { return factors_.now(); }
  const Vector& F_pa() const { return here_.F_pa(); }
  const Vector& right() const { return v_; }  // (v, 0)
  double g() const { return g_; }
  double orientation() const { return orientation_; }
  bool has_gradient() const { return transposed_; }
  const Vector& gradient_of_g() const { return g_x_; }

  // The derivative of g along d, n + 1, by a forward solve with M.
  double along(In d, const LinearSolver& M) const try {
    return nearby_.along(here_, d) ? change_of_g(M) : std::nan("");
  } catch (const std::exception&) {
    return std::nan("");
  }

  // w . F_uu v v changes its sign at a cusp, but also with the sign of (w, v), which no function of the point
  // can choose without a jump: closed curves may have an odd number of cusps. A factor that goes with the
  // sign of v, and is not zero near cusps, is the share of v in the direction of the curve, which is (v, 0)
  // there. Far from them the product is taken for zero, so that its change of sign is located at once, and
  // keeps its sign where there is no share.
  double cusp_function(In tangent) const override {
    if (!sign_known_) return std::nan("");
    const double size = v_.cwiseQuotient(scale_).squaredNorm() * (transposed_ ? z_.head(n_).norm() : 1);
    const double second = (transposed_ ? g_x_.dot(v_) : along(v_, *factors_.now())) / size;
    const double share = share_of_v(tangent);
    if (std::abs(share) < no_share_of_v) return least_share_of_v * std::abs(second);
    return std::abs(share) < least_share_of_v ? 0 : share * second;
  }
  bool is_cusp(In tangent) const override { return std::abs(share_of_v(tangent)) > share_of_v_at_cusp; }

  bool null_vectors(Vector& right, Vector& left) const override {
    right = v_.head(n_);
    left = z_.head(n_);
    return transposed_;
  }

  double left_times_right() const override {
    if (!transposed_) return 1;
    if (!sign_known_) return std::nan("");
    const auto w = z_.head(n_), v = v_.head(n_);
    return w.dot(v) / (w.norm() * v.norm());
  }

 private:
  void further_derivative(int k, Out dG) const override {
    if (!transposed_)
      dG[0] = nearby_.over(here_, k) ? change_of_g(*factors_.now()) : std::nan("");
    else
      dG[0] = given_ ? g_p_[k] : -nearby_.parameter_derivative(z_.head(n_), k);
  }

  // (v, g) with M = [J b; c^T 0]: M (v, g) = e_{n+1}.
  bool right_vector() {
    borders_.columns.col(0) = b_;
    borders_.rows.col(0) = c_;
    borders_.corner(0, 0) = 0;
    if (!factors_.factorize(here_.at().jacobian(), borders_)) return false;
    orientation_ = sign_of_determinant();
    v_.setZero();
    v_[n_] = 1;
    factors_.now()->solve(v_);
    g_ = orientation_ * v_[n_];
    v_[n_] = 0;
    return v_.allFinite();
  }

  // Of M. Where its linear solver does not know it, another one does, up to some size.
  double sign_of_determinant() {
    auto sign = factors_.now()->determinant_sign();
    const Jacobian& J = here_.at().jacobian();
    if (!sign && n_ <= largest_with_own_sign && !std::holds_alternative<const Operator*>(J)) {
      if (!signed_) signed_ = suitable_solver(J);
      if (signed_->factorize(J, borders_)) sign = signed_->determinant_sign();
    }
    sign_known_ = sign.has_value();
    return sign.value_or(1);
  }

  // M^T (w, g) = e_{n+1}; z has the sign of the determinant, with which the product of w and v has one of its
  // own.
  void left_vector() {
    z_.setZero();
    z_[n_] = orientation_;
    transposed_ = factors_.now()->solve_transposed(z_) && z_.allFinite();
  }

  // The next borders are these null vectors, the best choice for the conditioning of M.
  void take_borders() {
    const double length = v_.head(n_).cwiseQuotient(scale_.head(n_)).squaredNorm();
    if (length > 0 && std::isfinite(length))
      c_ = v_.head(n_).cwiseQuotient(scale_.head(n_)).cwiseQuotient(scale_.head(n_)) / std::sqrt(length);
    if (!transposed_) return;
    for (Eigen::Index i = 0; i < n_; ++i) work_[i] = generic_entry(i) * scale_[i];
    continuation::apply(here_.at().jacobian(), work_.head(n_), Jd_);
    const double size = std::max(Jd_.norm(), scale_[n_] * here_.F_pa().norm());
    if (size > outgrown * size_of_b_ || size_of_b_ == 0) size_of_b_ = size;
    const double w = orientation_ * z_.head(n_).norm();
    if (w != 0) b_ = z_.head(n_) * ((size_of_b_ > 0 ? size_of_b_ : 1) / w);
  }

  // g_x = -w . dJ v, by the symmetry of second derivatives: along (v, 0). False: no transposed products.
  bool gradient() {
    const auto w = z_.head(n_);
    given_ = here_.second_derivative(w, v_, g_x_, g_p_);
    if (!given_) {
      if (!nearby_.along(here_, v_)) {
        g_x_.setConstant(std::nan(""));
        return true;
      }
      if (!nearby_.transposed_derivative(w, g_x_)) return false;
    }
    g_x_ = -g_x_;
    g_p_ = -g_p_;
    return true;
  }

  // The last entry of -M^-1 (dJ v, 0), at the neighbouring points.
  double change_of_g(const LinearSolver& M) const {
    nearby_.derivative(v_, work_.head(n_));
    work_[n_] = 0;
    M.solve(work_);
    return -orientation_ * work_[n_];
  }

  double share_of_v(In tangent) const {
    const auto x = tangent.head(n_ + 1).cwiseQuotient(scale_);
    const auto v = v_.cwiseQuotient(scale_);
    const double size = x.norm() * v.norm();
    return size > 0 ? x.dot(v) / size : 0;
  }

  void apply(In d, Out y) const override {
    here_.apply(d, y.head(n_));
    y[n_] = transposed_ ? g_x_.dot(d) : along(d, *factors_.now());
  }

  SharedFactors factors_;
  Vector scale_;
  Borders borders_;
  Vector b_, c_, v_, z_, g_x_, g_p_, Jd_;
  mutable Vector work_;
  double g_ = 0, orientation_ = 1, size_of_b_ = 0;
  bool sign_known_ = true;
  std::unique_ptr<LinearSolver> signed_;
  bool first_ = true, transposed_ = false, given_ = false;
};

// x = M^-1 (y, 0) + kappa (v, 0) - (M^-1 (F_pa, 0) - e) dp_a - M^-1 (C, 0) mu, of which the entry next to v
// has to vanish, leaves two equations more than there are borders.
class FoldSolver final : public AugmentedSolver<FoldEvaluator> {
 public:
  void solve(Out x) const override {
    const Eigen::Index n = directions_.rows() - 1, m = rows_.cols();
    y_ << x.head(n), 0;
    B_->solve(y_);
    rhs_[0] = -y_[n];
    y_[n] = 0;
    rhs_[1] = x[n] - (y_.allFinite() ? change(y_) : std::nan(""));
    rhs_.tail(m) = x.tail(m);
    rhs_.tail(m).noalias() -= rows_.transpose() * y_;
    small_.solve(rhs_, small_x_);
    x.head(n + 1) = y_;
    x.head(n + 1).noalias() += directions_ * small_x_;
    x.tail(m) = small_x_.tail(m);
  }

 private:
  void eliminate(const Borders& borders) override {
    g_x_ = at_->gradient_of_g();
    has_gradient_ = at_->has_gradient();
    orientation_ = at_->orientation();
    const Eigen::Index n = g_x_.size() - 1, m = borders.width();
    directions_.resize(n + 1, 2 + m);
    S_.resize(2 + m, 2 + m);
    y_.resize(n + 1);
    rhs_.resize(2 + m);
    small_x_.resize(2 + m);
    directions_.col(0) = at_->right();
    S_(0, 0) = orientation_ * at_->g();
    for (Eigen::Index j = 0; j <= m; ++j) {
      if (j == 0)
        y_.head(n) = at_->F_pa();
      else
        y_.head(n) = borders.columns.col(j - 1).head(n);
      y_[n] = 0;
      B_->solve(y_);
      S_(0, 1 + j) = -y_[n];
      directions_.col(1 + j) = -y_;
      directions_(n, 1 + j) = j == 0 ? 1 : 0;
    }
    for (Eigen::Index j = 0; j < 2 + m; ++j) {
      S_(1, j) = change(directions_.col(j)) + (j < 2 ? 0 : borders.columns(n, j - 2));
      S_.col(j).tail(m).noalias() = rows_.transpose() * directions_.col(j);
    }
    S_.bottomRightCorner(m, m) += borders.corner;
  }

  double change(In d) const {
    if (has_gradient_) return g_x_.dot(d);
    return d.isZero(0) ? 0 : at_->along(d, *B_);
  }

  Vector g_x_;
  bool has_gradient_ = false;
  double orientation_ = 1;
  Matrix directions_;
};

}  // namespace

std::shared_ptr<const Problem> folds(std::shared_ptr<const Problem> problem, int along,
                                     MakeLinearSolver make_solver) {
  const auto inner = std::make_shared<const InnerProblem>(std::move(problem), along, std::move(make_solver));
  return augmented(
      inner, {}, [inner] { return std::make_unique<FoldEvaluator>(inner); },
      [] { return std::make_unique<FoldSolver>(); });
}

}  // namespace arcslip::continuation
