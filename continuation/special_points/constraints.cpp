#include <arcslip/continuation/special_points/constraints.hpp>

#include <arcslip/continuation/linear/linear_solvers.hpp>
#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/continuation/special_points/augmented_problem.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace arcslip::continuation {
namespace {

struct Constrained {
  std::shared_ptr<const Problem> problem;
  std::vector<Constraint> constraints;
  std::vector<int> freed;             // indices among `parameters`
  std::vector<Parameter> parameters;  // of the problem, and the levels
  Vector scales;                      // of the problem
  MakeLinearSolver make_solver;

  Eigen::Index n() const { return scales.size(); }
  Eigen::Index m() const { return static_cast<Eigen::Index>(constraints.size()); }
  int of_problem() const { return static_cast<int>(parameters.size() - constraints.size()); }
  const Parameter& parameter(int k) const { return parameters[static_cast<std::size_t>(k)]; }
  bool is_freed(int k) const { return std::find(freed.begin(), freed.end(), k) != freed.end(); }
};

// dg/dx of a function that sees x: a central difference, or a one-sided one at the end of the domain of g.
template <class F>
double difference(double& x, double scale, F&& g) {
  const double at = x, h = std::cbrt(2.2e-16) * std::max(std::abs(x), scale);
  const auto value_at = [&](double moved) {
    x = moved;
    double value = std::numeric_limits<double>::quiet_NaN();
    try {
      value = g();
    } catch (const std::exception&) {  // outside the domain, as it says
    }
    x = at;
    return value;
  };
  double above = at + h, below = at - h, g_above = value_at(above), g_below = value_at(below);
  if (!std::isfinite(g_above)) above = at, g_above = value_at(at);
  if (!std::isfinite(g_below)) below = at, g_below = value_at(at);
  return (g_above - g_below) / (above - below);
}

class ConstrainedEvaluator final : public Evaluator, public Operator {
 public:
  explicit ConstrainedEvaluator(std::shared_ptr<const Constrained> of)
      : of_(std::move(of)),
        inner_(of_->problem->evaluator()),
        u_(of_->n()),
        p_(of_->of_problem()),
        levels_(of_->m()),
        R_(of_->n() + of_->m()),
        F_q_(Matrix::Zero(of_->n(), of_->m())),
        g_u_(of_->n(), of_->m()),
        g_q_(of_->m(), of_->m()),
        jacobian_(static_cast<const Operator*>(this)) {}

  Evaluated move_to(In x, In p, Needs needs) override {
    take(x, p);
    const Evaluated result = inner_->move_to(u_, p_, needs);
    if (result != Evaluated::ok) return result;
    if (inner_->residual().size() != of_->n()) return Evaluated::failed;
    R_.head(of_->n()) = inner_->residual();
    for (Eigen::Index k = 0; k < of_->m(); ++k) R_[of_->n() + k] = value(k) - levels_[k];
    if (!R_.tail(of_->m()).allFinite()) return Evaluated::outside_domain;
    return needs == Needs::jacobian ? linearize() : Evaluated::ok;
  }

  const Vector& residual() const override { return R_; }
  const Jacobian& jacobian() const override { return jacobian_; }

  void parameter_derivative(int k, Out dR) const override {
    dR.setZero();
    if (of_->is_freed(k)) return;
    if (k < of_->of_problem()) inner_->parameter_derivative(k, dR.head(of_->n()));
    for (Eigen::Index i = 0; i < of_->m(); ++i) dR[of_->n() + i] = derivative(i, k);
  }

  ByDifferences by_differences() const override { return inner_->by_differences(); }
  std::uint64_t piece() const override { return inner_->piece(); }
  void set_state(In state) override { inner_->set_state(state); }
  void next_state(Out state) const override { inner_->next_state(state); }

  Evaluated test_piece(In x, In p, std::uint64_t piece, PieceTest test, bool& inside) override {
    take(x, p);
    return inner_->test_piece(u_, p_, piece, test, inside);
  }

  void apply(In x, Out y) const override {
    const Eigen::Index n = of_->n(), m = of_->m();
    continuation::apply(inner_->jacobian(), x.head(n), y.head(n));
    y.head(n).noalias() += F_q_ * x.tail(m);
    y.tail(m).noalias() = g_u_.transpose() * x.head(n) + g_q_ * x.tail(m);
  }

  bool apply_transposed(In x, Out y) const override {
    const Eigen::Index n = of_->n(), m = of_->m();
    if (!continuation::apply_transposed(inner_->jacobian(), x.head(n), y.head(n))) return false;
    y.head(n).noalias() += g_u_ * x.tail(m);
    y.tail(m).noalias() = F_q_.transpose() * x.head(n) + g_q_.transpose() * x.tail(m);
    return true;
  }

  const Constrained& of() const { return *of_; }
  const Jacobian& inner_jacobian() const { return inner_->jacobian(); }

  /// The borders of the inner J: these equations, and further ones.
  void border(const Borders& further, Borders& all) const {
    const Eigen::Index n = of_->n(), m = of_->m(), w = further.width();
    all.columns.leftCols(m) = F_q_;
    all.columns.rightCols(w) = further.columns.topRows(n);
    all.rows.leftCols(m) = g_u_;
    all.rows.rightCols(w) = further.rows.topRows(n);
    all.corner.topLeftCorner(m, m) = g_q_;
    all.corner.topRightCorner(m, w) = further.columns.bottomRows(m);
    all.corner.bottomLeftCorner(w, m) = further.rows.bottomRows(m).transpose();
    all.corner.bottomRightCorner(w, w) = further.corner;
  }

 private:
  const Constraint& constraint(Eigen::Index k) const { return of_->constraints[static_cast<std::size_t>(k)]; }
  double value(Eigen::Index k) const { return constraint(k).value(u_, p_); }

  // u_, p_ and the levels, of which those that are freed are in x.
  void take(In x, In p) {
    u_ = x.head(of_->n());
    p_ = p.head(p_.size());
    levels_ = p.tail(of_->m());
    for (Eigen::Index j = 0; j < of_->m(); ++j) {
      const Eigen::Index k = of_->freed[static_cast<std::size_t>(j)];
      (k < p_.size() ? p_[k] : levels_[k - p_.size()]) = x[of_->n() + j];
    }
  }

  // d(g_i - c_i)/dp_k.
  double derivative(Eigen::Index i, int k) const {
    if (k >= p_.size()) return k - p_.size() == i ? -1 : 0;
    if (constraint(i).derivative) return constraint(i).derivative(u_, p_, k);
    return difference(p_[k], of_->parameter(k).change(), [&] { return value(i); });
  }

  Evaluated linearize() {
    for (Eigen::Index j = 0; j < of_->m(); ++j) {
      const int k = of_->freed[static_cast<std::size_t>(j)];
      if (k < p_.size()) inner_->parameter_derivative(k, F_q_.col(j));
      for (Eigen::Index i = 0; i < of_->m(); ++i) g_q_(i, j) = derivative(i, k);
      if (constraint(j).gradient) {
        constraint(j).gradient(u_, p_, g_u_.col(j));
        continue;
      }
      for (Eigen::Index i = 0; i < of_->n(); ++i)
        g_u_(i, j) = difference(u_[i], of_->scales[i], [&] { return value(j); });
    }
    return F_q_.allFinite() && g_u_.allFinite() && g_q_.allFinite() ? Evaluated::ok
                                                                    : Evaluated::outside_domain;
  }

  std::shared_ptr<const Constrained> of_;
  std::unique_ptr<Evaluator> inner_;
  mutable Vector u_, p_;
  Vector levels_, R_;
  Matrix F_q_, g_u_, g_q_;  // dF/dq, transposed dg/du, dg/dq
  Jacobian jacobian_;
};

// The inner problem's solver, for which the constraints are further borders of J.
class ConstrainedSolver final : public LinearSolver {
 public:
  const char* name() const override { return solver_ ? solver_->name() : "borders"; }

  bool factorize(const Jacobian& J, const Borders& borders) override {
    const auto* const* op = std::get_if<const Operator*>(&J);
    const auto* at = op ? dynamic_cast<const ConstrainedEvaluator*>(*op) : nullptr;
    if (!at) throw std::invalid_argument("the Jacobian is not that of a problem with constraints");
    const Constrained& of = at->of();
    if (!solver_) {
      solver_ = of.make_solver ? of.make_solver() : of.problem->linear_solver();
      if (!solver_) solver_ = suitable_solver(at->inner_jacobian());
    }
    const int n = static_cast<int>(of.n()), width = static_cast<int>(of.m()) + borders.width();
    if (!all_ || all_->width() != width) all_.emplace(n, width);
    at->border(borders, *all_);
    return solver_->factorize(at->inner_jacobian(), *all_);
  }

  void solve(Out x) const override { solver_->solve(x); }
  bool solve_transposed(Out x) const override { return solver_->solve_transposed(x); }
  bool keeps_pivots() const override { return solver_ && solver_->keeps_pivots(); }
  void forget_pivots() override {
    if (solver_) solver_->forget_pivots();
  }
  std::optional<int> determinant_sign() const override { return solver_->determinant_sign(); }

 private:
  std::unique_ptr<LinearSolver> solver_;
  std::optional<Borders> all_;
};

class ConstrainedProblem final : public Problem {
 public:
  explicit ConstrainedProblem(std::shared_ptr<const Constrained> of) : of_(std::move(of)) {}
  int size() const override { return static_cast<int>(of_->n() + of_->m()); }
  std::span<const Parameter> parameters() const override { return of_->parameters; }
  Vector scales() const override {
    Vector scales(size());
    scales.head(of_->n()) = of_->scales;
    for (Eigen::Index j = 0; j < of_->m(); ++j) scales[of_->n() + j] = scale_of_freed(j);
    return scales;
  }
  bool metric(In v, Out Mv) const override {
    for (Eigen::Index j = 0; j < of_->m(); ++j) {
      const double scale = scale_of_freed(j);
      Mv[of_->n() + j] = v[of_->n() + j] / (scale * scale);
    }
    return of_->problem->metric(v.head(of_->n()), Mv.head(of_->n()));
  }
  std::unique_ptr<Evaluator> evaluator() const override {
    return std::make_unique<ConstrainedEvaluator>(of_);
  }
  Vector initial_state() const override { return of_->problem->initial_state(); }
  bool is_unknown(int k) const override {
    return of_->is_freed(k) || (k < of_->of_problem() && of_->problem->is_unknown(k));
  }
  bool cheap_residual() const override { return of_->problem->cheap_residual(); }
  bool chord_pays() const override { return of_->problem->chord_pays(); }
  bool smooth() const override { return of_->problem->smooth(); }
  std::unique_ptr<LinearSolver> linear_solver() const override {
    return std::make_unique<ConstrainedSolver>();
  }
  std::shared_ptr<const Problem> with_scale(int k, double scale) const override {
    auto scaled = std::make_shared<Constrained>(*of_);
    scaled->parameters[static_cast<std::size_t>(k)].scale = scale;
    if (k < of_->of_problem())
      if (auto inner = of_->problem->with_scale(k, scale)) scaled->problem = std::move(inner);
    return std::make_shared<const ConstrainedProblem>(std::move(scaled));
  }

 private:
  double scale_of_freed(Eigen::Index j) const {
    return of_->parameter(of_->freed[static_cast<std::size_t>(j)]).change();
  }

  std::shared_ptr<const Constrained> of_;
};

}  // namespace

Constraint weighted_sum(Parameter level, Vector weights, Vector reference) {
  if (reference.size() != 0 && reference.size() != weights.size())
    throw std::invalid_argument(text("the constraint \"", level.name, "\" has ", weights.size(),
                                     " weights, its reference ", reference.size(), " unknowns"));
  if (reference.size() == 0) reference.setZero(weights.size());
  return {.level = std::move(level),
          .value =
              [weights, reference](In u, In) {
                if (u.size() != weights.size())
                  throw std::invalid_argument(
                      text("a weighted sum of ", weights.size(), " unknowns of ", u.size()));
                return weights.dot(u - reference);
              },
          .gradient = [weights](In, In, Out gradient) { gradient = weights; },
          .derivative = [](In, In, int) { return 0.0; }};
}

std::shared_ptr<const Problem> with_constraints(std::shared_ptr<const Problem> problem,
                                                std::vector<Constraint> constraints,
                                                const std::vector<std::string>& freed,
                                                MakeLinearSolver make_solver) {
  auto of = std::make_shared<Constrained>();
  of->problem = given(std::move(problem));
  if (constraints.empty() || freed.size() != constraints.size())
    throw std::invalid_argument(text(freed.size(), " parameters are freed for ", constraints.size(),
                                     " constraints: as many as these, and one at least"));
  const auto all = of->problem->parameters();
  of->parameters.assign(all.begin(), all.end());
  for (const Constraint& each : constraints) {
    if (!each.value)
      throw std::invalid_argument(text("the constraint \"", each.level.name, "\" has no value function"));
    of->parameters.push_back(each.level);
  }
  check_parameters(of->parameters);
  of->scales = of->problem->scales();
  of->constraints = std::move(constraints);
  of->make_solver = std::move(make_solver);
  const ConstrainedProblem named(of);
  for (const std::string& name : freed) {
    const int k = parameter_index(named, name);
    if (named.is_unknown(k))
      throw std::invalid_argument(text("the parameter \"", name, "\" is freed, and is an unknown already"));
    of->freed.push_back(k);
  }
  return std::make_shared<const ConstrainedProblem>(std::move(of));
}

}  // namespace arcslip::continuation
