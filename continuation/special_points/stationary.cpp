#include <arcslip/continuation/special_points/stationary.hpp>

#include <arcslip/continuation/normal_forms/codimension_two.hpp>
#include <arcslip/continuation/special_points/augmented_evaluator.hpp>
#include <arcslip/continuation/special_points/curve_place.hpp>
#include <arcslip/continuation/special_points/on_curve.hpp>

#include <cmath>
#include <exception>
#include <stdexcept>
#include <utility>

namespace arcslip::continuation {
namespace {

struct StationaryDefinition {
  InnerProblem inner;
  StationaryQuantity quantity;

  // dq/dx, n + 1
  void gradient(const Site& at, Out q_x) const {
    const Eigen::Index n = q_x.size() - 1;
    quantity.gradient(at.at(), at.u(), at.p(), q_x.head(n));
    q_x[n] = derivative(at, inner.along);
  }
  double derivative(const Site& at, int k) const {
    return quantity.parameter_derivative(at.at(), at.u(), at.p(), k);
  }
};

class StationaryEvaluator final : public AugmentedEvaluator,
                                  public Operator,
                                  public OnCurveOfStationaryPoints {
 public:
  explicit StationaryEvaluator(std::shared_ptr<const StationaryDefinition> definition)
      : AugmentedEvaluator({definition, &definition->inner}, 1),
        definition_(std::move(definition)),
        factors_(*inner_),
        tangent_(inner_->scales()),
        q_x_(n_ + 1),
        z_(n_ + 1),
        G_x_(n_ + 1),
        G_p_(inner_->problem->parameters().size()),
        r_(Vector::Zero(G_p_.size())),
        dp_(G_p_.size()),
        work_(n_ + 1),
        change_(n_ + 1) {
    jacobian_ = static_cast<const Operator*>(this);
  }

  Evaluated move_to(In x, In p, Needs needs) override {
    const Evaluated result = here_.move_to(x, p);
    if (result != Evaluated::ok) return result;
    definition_->gradient(here_, q_x_);
    if (!q_x_.allFinite() || !tangent()) return Evaluated::failed;
    if (first_) {
      first_ = false;
      tangent_.take_border();
      if (!tangent()) return Evaluated::failed;
    }
    R_.head(n_) = here_.at().residual();
    R_[n_] = q_x_.dot(t());
    if (needs == Needs::residual) return std::isfinite(R_[n_]) ? Evaluated::ok : Evaluated::failed;
    z_ = q_x_;
    transposed_ = factors_.now()->solve_transposed(z_);
    tangent_.take_border();
    if (transposed_) transposed_ = gradient();
    return Evaluated::ok;  // without a gradient, at the end of a piece, the linear solver fails
  }

  ByDifferences by_differences() const override {
    const bool differences = !(F_given_ && q_given_);
    return {differences, differences};
  }

  // B at the last point.
  const std::shared_ptr<LinearSolver>& factors() const { return factors_.now(); }
  const Vector& tangent_of_branch() const { return t(); }
  bool has_gradient() const { return transposed_; }
  const Vector& gradient_of_G() const { return G_x_; }

  // Directional derivative of G in x, by a forward solve with B.
  double along(In d, const LinearSolver& B) const try {
    return nearby_.along(here_, d) ? change_of_G(B) : std::nan("");
  } catch (const std::exception&) {
    return std::nan("");
  }
  double cusp_function(In) const override {
    return transposed_ ? G_x_.dot(t()) : along(t(), *factors_.now());
  }
  double left_times_right() const override { return transposed_ ? z_.head(n_).dot(t().head(n_)) : 1; }

 private:
  const Vector& t() const { return *tangent_; }

  // At the point of here_.
  bool tangent() { return tangent_.compute(factors_, here_.at().jacobian(), here_.F_pa()); }

  void further_derivative(int k, Out dG) const override {
    if (!transposed_)
      dG[0] = nearby_.over(here_, k) ? change_of_G(*factors_.now()) : std::nan("");
    else
      dG[0] = by_symmetry(k);
  }

  // G_x = d(dq/dx) . t - w . dA t, by the symmetry of second derivatives: along t. False: no transposed
  // products.
  bool gradient() {
    const auto w = z_.head(n_);
    F_given_ = here_.second_derivative(w, t(), G_x_, G_p_);
    q_given_ = static_cast<bool>(definition_->quantity.second_derivative);
    if (!(F_given_ && q_given_) && !nearby_.along(here_, t())) {
      G_x_.setConstant(std::nan(""));
      return true;
    }
    if (!F_given_ && !nearby_.transposed_derivative(w, G_x_)) return false;
    G_x_ = -G_x_;
    G_p_ = -G_p_;
    if (q_given_) {
      r_[inner_->along] = t()[n_];
      definition_->quantity.second_derivative(here_.at(), here_.u(), here_.p(), t().head(n_), r_,
                                              work_.head(n_), dp_);
      work_[n_] = dp_[inner_->along];
      G_x_ += work_;
    } else {
      nearby_.sum([&](const Site& place, double weight) {
        definition_->gradient(place, work_);
        G_x_ += weight * work_;
      });
    }
    return true;
  }

  double by_symmetry(int k) const {
    double result = F_given_ ? G_p_[k] : -nearby_.parameter_derivative(z_.head(n_), k);
    if (q_given_)
      result += dp_[k];
    else
      nearby_.sum(
          [&](const Site& place, double weight) { result += weight * definition_->derivative(place, k); });
    return result;
  }

  // d(dq/dx) . t - dq/dx . B^-1 (dA t, 0), at the neighbouring points.
  double change_of_G(const LinearSolver& B) const {
    nearby_.derivative(t(), work_.head(n_));
    work_[n_] = 0;
    B.solve(work_);
    double result = -q_x_.dot(work_);
    nearby_.sum([&](const Site& place, double weight) {
      definition_->gradient(place, change_);
      result += weight * change_.dot(t());
    });
    return result;
  }

  void apply(In d, Out y) const override {
    here_.apply(d, y.head(n_));
    y[n_] = transposed_ ? G_x_.dot(d) : along(d, *factors_.now());
  }

  std::shared_ptr<const StationaryDefinition> definition_;
  SharedFactors factors_;
  BorderedTangent tangent_;
  Vector q_x_, z_, G_x_, G_p_, r_, dp_;
  mutable Vector work_, change_;
  bool first_ = true, transposed_ = false, F_given_ = false, q_given_ = false;
};

// Solver of [A F_p; G_x G_p; r_x r_p]: x = B^-1 (y, zeta) leaves as many equations as there are entries in
// zeta and free parameters.
class StationarySolver final : public AugmentedSolver<StationaryEvaluator> {
 public:
  void solve(Out x) const override {
    const Eigen::Index n = t_.size() - 1, m = X_.cols();
    y_ << x.head(n), 0;
    B_->solve(y_);
    rhs_[0] = x[n] - dG(y_);
    rhs_.tail(m) = x.tail(m);
    rhs_.tail(m).noalias() -= rows_.transpose() * y_;
    small_x_.resize(rhs_.size());
    small_.solve(rhs_, small_x_);
    x.head(n + 1) = y_ + small_x_[0] * t_;
    x.head(n + 1).noalias() -= X_ * small_x_.tail(m);
    x.tail(m) = small_x_.tail(m);
  }

 private:
  void eliminate(const Borders& borders) override {
    t_ = at_->tangent_of_branch();
    G_x_ = at_->gradient_of_G();
    has_gradient_ = at_->has_gradient();
    const Eigen::Index n = t_.size() - 1, m = borders.width();
    X_.resize(n + 1, m);
    y_.resize(n + 1);
    S_.resize(1 + m, 1 + m);
    rhs_.resize(1 + m);
    S_(0, 0) = dG(t_);
    S_.block(1, 0, m, 1).noalias() = rows_.transpose() * t_;
    for (Eigen::Index j = 0; j < m; ++j) {
      y_ << borders.columns.col(j).head(n), 0;
      B_->solve(y_);
      X_.col(j) = y_;
      S_(0, 1 + j) = borders.columns(n, j) - dG(y_);
      S_.col(1 + j).tail(m) = borders.corner.col(j);
      S_.col(1 + j).tail(m).noalias() -= rows_.transpose() * y_;
    }
  }

  double dG(In d) const {
    if (has_gradient_) return G_x_.dot(d);
    return d.isZero(0) ? 0 : at_->along(d, *B_);
  }

  Vector t_, G_x_;
  bool has_gradient_ = false;
  Matrix X_;
};

const OnCurveOfStationaryPoints& on_curve(const Accepted& now) {
  const auto* at = dynamic_cast<const OnCurveOfStationaryPoints*>(&now.at);
  if (!at) throw std::invalid_argument("this monitor is for curves of folds and of stationary points");
  return *at;
}

}  // namespace

std::shared_ptr<const Problem> stationary_points(std::shared_ptr<const Problem> problem, int along,
                                                 StationaryQuantity quantity, MakeLinearSolver make_solver) {
  const auto definition = std::make_shared<const StationaryDefinition>(
      StationaryDefinition{{std::move(problem), along, std::move(make_solver)}, std::move(quantity)});
  return augmented(
      {definition, &definition->inner}, {},
      [definition] { return std::make_unique<StationaryEvaluator>(definition); },
      [] { return std::make_unique<StationarySolver>(); });
}

Monitor cusp_monitor() {
  Monitor monitor;
  monitor.name = cusp_event;
  monitor.value = [](const Accepted& now) { return on_curve(now).cusp_function(now.tangent); };
  monitor.is_event = [](const Accepted& now) { return on_curve(now).is_cusp(now.tangent); };
  monitor.describe = [](const Accepted& now) -> EventData {
    Vector right, left;
    if (!on_curve(now).null_vectors(right, left)) return {};
    const PlaceOnCurve place(now);
    return cusp_form(place.at(), place.place(), right, left);
  };
  return monitor;
}

Monitor bogdanov_takens_monitor() {
  Monitor monitor;
  monitor.name = "bogdanov_takens";
  monitor.value = [](const Accepted& now) { return on_curve(now).left_times_right(); };
  monitor.describe = [](const Accepted& now) -> EventData {
    const PlaceOnCurve place(now);
    return bogdanov_takens_form(place.at(), place.place());
  };
  return monitor;
}

Vector with_parameter(const Point& point) {
  Vector x(point.u.size() + 1);
  x << point.u, point.parameter;
  return x;
}

}  // namespace arcslip::continuation
