#include <arcslip/continuation/special_points/test_functions.hpp>

#include <arcslip/continuation/problem/difference.hpp>
#include <arcslip/continuation/special_points/augmented_evaluator.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double well_within = 1e-2;  // a piece: of the distance over which it reaches

struct ZeroDefinition {
  InnerProblem inner;
  TestFunctions functions;

  Eigen::Index further() const { return functions.scales.size(); }
};

// A place of F and g, without the Jacobian of F.
class Place {
 public:
  explicit Place(const ZeroDefinition& definition)
      : along_(definition.inner.along),
        n_(definition.inner.size()),
        evaluator_(definition.inner.problem->evaluator()),
        p_(definition.inner.problem->parameters().size()),
        u_(n_) {}

  // x: (u, p_a, k).
  Evaluated move_to(In x, In p, Needs needs) {
    u_ = x.head(n_);
    p_ = p;
    p_[along_] = x[n_];
    return evaluator_->move_to(u_, p_, needs);
  }

  Evaluator& at() const { return *evaluator_; }
  const Vector& u() const { return u_; }
  const Vector& p() const { return p_; }

 private:
  int along_;
  Eigen::Index n_;
  std::unique_ptr<Evaluator> evaluator_;
  Vector p_, u_;
};

class ZeroEvaluator final : public Evaluator, public Operator {
 public:
  explicit ZeroEvaluator(std::shared_ptr<const ZeroDefinition> definition)
      : definition_(std::move(definition)),
        n_(definition_->inner.size()),
        m_(1 + definition_->further()),
        g_of_(definition_->functions.make()),
        here_(*definition_),
        nearby_{Place(*definition_), Place(*definition_)},
        factors_(definition_->inner),
        scales_(n_ + m_),
        tangent_(definition_->inner.scales()),
        F_pa_(n_),
        R_(n_ + m_),
        x_(n_ + m_),
        y_(n_ + m_),
        p_(definition_->inner.problem->parameters().size()),
        q_(p_.size()),
        g_(m_),
        g_nearby_{Vector(m_), Vector(m_)},
        jacobian_(static_cast<const Operator*>(this)) {
    scales_ << definition_->inner.scales(), definition_->functions.scales;
  }

  Evaluated move_to(In x, In p, Needs needs) override {
    x_ = x;
    p_ = p;
    const Evaluated result = here_.move_to(x, p, needs);
    if (result != Evaluated::ok) return result;
    if (!g_of_(here_.at(), here_.u(), here_.p(), x.tail(m_ - 1), g_)) return Evaluated::failed;
    R_ << here_.at().residual(), g_;
    if (!g_.allFinite()) return Evaluated::failed;
    if (needs == Needs::residual) return Evaluated::ok;
    here_.at().parameter_derivative(definition_->inner.along, F_pa_);
    if (!tangent()) return Evaluated::failed;
    tangent_.take_border();
    if (!std::exchange(has_tangent_, true)) {
      if (!tangent()) return Evaluated::failed;
      tangent_.take_border();
    }
    return Evaluated::ok;  // without derivatives, at the end of a piece, the linear solver fails
  }

  const Vector& residual() const override { return R_; }
  const Jacobian& jacobian() const override { return jacobian_; }

  void parameter_derivative(int k, Out dR) const override {
    dR.setZero();
    if (k == definition_->inner.along) return;
    here_.at().parameter_derivative(k, dR.head(n_));
    const double scale = definition_->inner.parameter(k).change();
    const double h = difference_step * std::max(std::abs(p_[k]), scale);
    q_ = p_;
    y_ = x_;
    difference(h, [&](double distance) { q_[k] = p_[k] + distance; }, dR.tail(m_));
  }

  std::uint64_t piece() const override { return here_.at().piece(); }
  ByDifferences by_differences() const override { return {true, true}; }

  Eigen::Index functions() const { return m_; }
  // B at the last point with a Jacobian.
  const std::shared_ptr<LinearSolver>& factors() const { return factors_.now(); }
  const Vector& tangent_of_branch() const { return *tangent_; }

  // The derivative of g along d, n + m, at the last point; NaN where it is not known.
  void along(In d, Out dg) const {
    const double length = d.cwiseQuotient(scales_).norm();
    dg.setZero();
    if (length == 0) return;
    const double h = difference_step * std::max(1.0, x_.cwiseQuotient(scales_).norm()) / length;
    q_ = p_;
    difference(h, [&](double distance) { y_ = x_ + distance * d; }, dg);
  }

 private:
  // dg of g over the distance that `move` moves (y_, q_) by.
  template <class Move>
  void difference(double h, Move&& move, Out dg) const {
    const auto go = [&](std::size_t i, double distance) {
      move(distance);
      Place& place = nearby_[i];
      try {
        return place.move_to(y_, q_, Needs::residual) == Evaluated::ok &&
               place.at().piece() == here_.at().piece() &&
               g_of_(place.at(), place.u(), place.p(), y_.tail(m_ - 1), g_nearby_[i]);
      } catch (const std::exception&) {  // outside the domain, as it says
        return false;
      }
    };
    auto found = difference_within_piece(h, go);
    // Next to the end of a piece g may grow as the root of the distance from it.
    if (found && std::abs(found->distance[0]) < h)
      found = difference_within_piece(well_within * std::abs(found->distance[0]), go);
    if (!found) {
      dg.setConstant(std::nan(""));
      return;
    }
    dg = found->here * g_;
    for (std::size_t i = 0; i < 2; ++i) dg += found->weight[i] * g_nearby_[i];
  }

  // At the point of here_.
  bool tangent() { return tangent_.compute(factors_, here_.at().jacobian(), F_pa_); }

  void apply(In d, Out y) const override {
    continuation::apply(here_.at().jacobian(), d.head(n_), y.head(n_));
    y.head(n_) += d[n_] * F_pa_;
    along(d, y.tail(m_));
  }

  std::shared_ptr<const ZeroDefinition> definition_;
  Eigen::Index n_, m_;
  TestFunction g_of_;
  Place here_;
  mutable std::array<Place, 2> nearby_;
  SharedFactors factors_;
  Vector scales_;
  BorderedTangent tangent_;
  Vector F_pa_, R_, x_;
  mutable Vector y_;
  Vector p_;
  mutable Vector q_;
  Vector g_;
  mutable std::array<Vector, 2> g_nearby_;
  bool has_tangent_ = false;
  Jacobian jacobian_;
};

// x = (y, 0) + zeta (t, 0) + (0, dk) - (X, 0) mu leaves as many equations as there are functions and borders.
class ZeroSolver final : public AugmentedSolver<ZeroEvaluator> {
 public:
  void solve(Out x) const override {
    const Eigen::Index w = rows_.cols(), m = S_.rows() - w, n = directions_.rows() - m;
    y_.setZero();
    y_.head(n) = x.head(n);
    B_->solve(y_.head(n + 1));
    if (y_.allFinite())
      at_->along(y_, rhs_.head(m));
    else
      rhs_.head(m).setConstant(std::nan(""));
    rhs_.head(m) = x.segment(n, m) - rhs_.head(m);
    rhs_.tail(w) = x.tail(w);
    rhs_.tail(w).noalias() -= rows_.transpose() * y_;
    small_.solve(rhs_, small_x_);
    x.head(n + m) = y_;
    x.head(n + m).noalias() += directions_ * small_x_;
    x.tail(w) = small_x_.tail(w);
  }

 private:
  void eliminate(const Borders& borders) override {
    const Vector& t = at_->tangent_of_branch();
    const Eigen::Index n = t.size() - 1, m = at_->functions(), w = borders.width();
    directions_.setZero(n + m, m + w);
    directions_.col(0).head(n + 1) = t;
    for (Eigen::Index i = 1; i < m; ++i) directions_(n + i, i) = 1;
    y_.setZero(n + m);
    for (Eigen::Index j = 0; j < w; ++j) {
      y_.head(n) = borders.columns.col(j).head(n);
      y_[n] = 0;
      B_->solve(y_.head(n + 1));
      directions_.col(m + j) = -y_;
    }
    S_.resize(m + w, m + w);
    rhs_.resize(m + w);
    small_x_.resize(m + w);
    for (Eigen::Index i = 0; i < m + w; ++i) {
      at_->along(directions_.col(i), S_.col(i).head(m));
      S_.col(i).tail(w).noalias() = rows_.transpose() * directions_.col(i);
    }
    S_.topRightCorner(m, w) += borders.columns.bottomRows(m);
    S_.bottomRightCorner(w, w) += borders.corner;
  }

  Matrix directions_;
};

}  // namespace

std::shared_ptr<const Problem> test_function_zeros(std::shared_ptr<const Problem> problem, int along,
                                                   TestFunctions functions, MakeLinearSolver make_solver) {
  if (!(functions.scales.array() > 0).all() || !functions.scales.allFinite())
    throw std::invalid_argument("the scales of the further unknowns must be positive");
  const auto definition = std::make_shared<const ZeroDefinition>(
      ZeroDefinition{{std::move(problem), along, std::move(make_solver)}, std::move(functions)});
  return augmented(
      {definition, &definition->inner}, definition->functions.scales,
      [definition] { return std::make_unique<ZeroEvaluator>(definition); },
      [] { return std::make_unique<ZeroSolver>(); });
}

}  // namespace arcslip::continuation
