#include <arcslip/continuation/problem/problem_from_functions.hpp>

#include <arcslip/continuation/problem/difference.hpp>
#include <arcslip/continuation/problem/linear_solver.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double same_size = 0.1;         // of two lengths, shorter over longer: one step serves both
constexpr double finest_at_zero = 1e-12;  // of the first step, where p = 0
constexpr double step_ratio = 1.0 / 32;   // q, of one step to the next

double central_step(double x, double scale) {
  return std::cbrt(2.2e-16) * std::max(std::abs(x), scale);
}

// The shortest step that may be needed at |p|: of the shorter of the two lengths that are known.
double finest_step(double p, const Parameter& parameter) {
  if (p == 0) return central_step(0, finest_at_zero * parameter.change());
  return central_step(0, parameter.scale > 0 ? std::min(p, parameter.scale) : p);
}

bool finite(const SparseMatrix& J) {
  return J.nonZeros() == 0 || Eigen::Map<const Vector>(J.valuePtr(), J.nonZeros()).allFinite();
}

// The derivative of a vector by differences with ever shorter steps, row by row.
//
// Chooses among central differences D_0, D_1, ... with steps in the ratio q. The change from one to
// the next is the error of truncation of the former, which falls like q^2, or that of rounding of the
// latter, which grows like 1/q. So each row takes the first D that the next one confirms, or else those
// between which it changed least. A row that no two steps agree on is noise, which grows from D_0 on, or a
// zero as of p^3 at 0, of which D falls: it takes the smallest D.
class StepSearch {
 public:
  explicit StepSearch(Eigen::Index n)
      : smallest_(n), before_(n), last_(n), best_(n), change_(n), settled_(n) {}

  void begin(In D) {
    smallest_ = before_ = last_ = best_ = D;
    change_.setConstant(1);
    settled_.setConstant(false);
  }

  // False: all rows are settled, a further D would change nothing.
  bool add(In D) {
    for (Eigen::Index i = 0; i < D.size(); ++i)
      if (!settled_[i]) judge(i, D[i]);
    before_ = last_;
    last_ = D;
    return !settled_.all();
  }

  const Vector& best() const { return best_; }

 private:
  static constexpr double confirmed = 1e-8;     // relative change
  static constexpr double resolved = 0.1;       // more: steps longer than what F shows there, or noise
  static constexpr double rounding_growth = 4;  // of the change: more is the growth of rounding alone
  static constexpr double truncation_decay = 1 / (step_ratio * step_ratio);

  void judge(Eigen::Index i, double now) {
    const double size = std::max(std::abs(now), std::abs(last_[i]));
    const double change = size > 0 ? std::abs(now - last_[i]) / size : 0;
    if (std::abs(now) < std::abs(smallest_[i])) smallest_[i] = now;
    const bool grows = change_[i] < resolved && !(change < change_[i]);
    settled_[i] = grows || change <= confirmed;
    const bool truncation = change_[i] < 1 && change * truncation_decay <= 2 * change_[i];
    if (change <= confirmed)
      best_[i] = truncation ? now : last_[i];
    else if (grows)
      best_[i] = change < rounding_growth * change_[i] ? last_[i] : before_[i];
    else
      best_[i] = change < resolved ? now : smallest_[i];
    change_[i] = change;
  }

  Vector smallest_, before_, last_, best_, change_;
  Eigen::Array<bool, Eigen::Dynamic, 1> settled_;
};

using Parameters = std::shared_ptr<const std::vector<Parameter>>;

class FunctionEvaluator final : public Evaluator, private Operator {
 public:
  // state, next: of a problem with a state, whose functions see it.
  FunctionEvaluator(std::shared_ptr<const Functions> f, Parameters parameters,
                    std::shared_ptr<Vector> state = {}, std::shared_ptr<const StateFunctions> of = {})
      : f_(std::move(f)),
        state_(std::move(state)),
        of_(std::move(of)),
        parameters_(std::move(parameters)),
        u_(f_->size),
        p_(parameters_->size()),
        F_(f_->size),
        nearby_{Vector(f_->size), Vector(f_->size)},
        dF_(f_->size),
        search_(f_->size) {
    if (f_->sparse_jacobian || f_->choosing.sparse_jacobian)
      J_ = SparseMatrix(f_->size, f_->size);
    else if (f_->apply_jacobian)
      J_ = static_cast<const Operator*>(this);
    else
      J_ = Matrix(f_->size, f_->size);
  }

  Evaluated move_to(In u, In p, Needs needs) override {
    u_ = u;
    p_ = p;
    choices_.anew();
    residual_at_point(F_);
    if (F_.size() != f_->size) return Evaluated::failed;
    if (!F_.allFinite()) return Evaluated::outside_domain;
    if (needs == Needs::residual) return Evaluated::ok;
    if (auto* sparse = std::get_if<SparseMatrix>(&J_)) return fill(*sparse);
    if (auto* dense = std::get_if<Matrix>(&J_)) return fill(*dense);
    u_of_J_ = u_;
    p_of_J_ = p_;
    return Evaluated::ok;
  }

  const Vector& residual() const override { return F_; }
  const Jacobian& jacobian() const override { return J_; }

  void parameter_derivative(int k, Out dF) const override {
    choices_.keep();
    if (f_->choosing.derivative)
      f_->choosing.derivative(u_, p_, choices_, k, dF);
    else if (f_->derivative)
      f_->derivative(u_, p_, k, dF);
    else
      parameter_difference(p_[k], (*parameters_)[static_cast<std::size_t>(k)], dF);
  }

  bool second_derivative(In w, In v, In q, Out du, Out dp) const override {
    if (f_->second) f_->second(u_, p_, w, v, q, du, dp);
    return static_cast<bool>(f_->second);
  }

  bool directional_derivative(int order, In v, In q, Out d) const override {
    if (f_->directional) f_->directional(order, u_, p_, v, q, d);
    return static_cast<bool>(f_->directional);
  }

  void set_state(In state) override {
    if (state_) *state_ = state;
  }
  void next_state(Out state) const override {
    if (state_) of_->next(u_, p_, *state_, state);
  }

  ByDifferences by_differences() const override {
    const bool given = f_->jacobian || f_->sparse_jacobian || f_->apply_jacobian || f_->choosing.jacobian ||
                       f_->choosing.sparse_jacobian;
    return {!given, !(f_->derivative || f_->choosing.derivative)};
  }

  std::uint64_t piece() const override {
    if (f_->choosing.residual) return choices_.piece();
    return f_->piece ? f_->piece(u_, p_) : 0;
  }

  Evaluated test_piece(In u, In p, std::uint64_t piece, PieceTest test, bool& inside) override {
    if (f_->choosing.residual) return Evaluator::test_piece(u, p, piece, test, inside);
    inside = !f_->piece || f_->piece(u, p) == piece;
    return Evaluated::ok;
  }

 private:
  void apply(In x, Out y) const override { f_->apply_jacobian(u_of_J_, p_of_J_, x, y); }
  bool apply_transposed(In x, Out y) const override {
    if (f_->apply_transposed_jacobian) f_->apply_transposed_jacobian(u_of_J_, p_of_J_, x, y);
    return static_cast<bool>(f_->apply_transposed_jacobian);
  }

  // F at (u_, p_), by the choices as they are: begun anew or kept.
  void residual_at_point(Vector& F) const {
    if (f_->choosing.residual)
      f_->choosing.residual(u_, p_, choices_, F);
    else
      f_->residual(u_, p_, F);
  }

  Evaluated fill(SparseMatrix& J) {
    choices_.keep();
    if (f_->choosing.sparse_jacobian)
      f_->choosing.sparse_jacobian(u_, p_, choices_, J);
    else
      f_->sparse_jacobian(u_, p_, J);
    if (J.rows() != f_->size || J.cols() != f_->size)
      throw std::runtime_error("the sparse Jacobian is " + std::to_string(J.rows()) + " x " +
                               std::to_string(J.cols()) + " for " + std::to_string(f_->size) + " unknowns");
    if (!J.isCompressed()) J.makeCompressed();
    return finite(J) ? Evaluated::ok : Evaluated::outside_domain;
  }

  Evaluated fill(Matrix& J) {
    choices_.keep();
    if (f_->choosing.jacobian) {
      f_->choosing.jacobian(u_, p_, choices_, J);
    } else if (f_->jacobian) {
      f_->jacobian(u_, p_, J);
    } else {
      const auto here = piece_of_differences();
      for (Eigen::Index i = 0; i < u_.size(); ++i)
        difference(u_[i], central_step(u_[i], f_->scales[i]), here, J.col(i));
    }
    return J.allFinite() ? Evaluated::ok : Evaluated::outside_domain;
  }

  // The piece that differences at the point stay in. None without `piece`, or where it throws: what it throws
  // is determined by piece().
  std::optional<std::uint64_t> piece_of_differences() const {
    if (!f_->piece) return {};
    try {
      return f_->piece(u_, p_);
    } catch (...) {
      return {};
    }
  }

  // dF/dp: problem_from_functions.hpp says by which step. p: the entry of p_.
  void parameter_difference(double& p, const Parameter& parameter, Out dF) const {
    const auto here = piece_of_differences();
    const double at = std::abs(p);
    const double first = central_step(at, parameter.change()), finest = finest_step(at, parameter);
    const auto quotient = difference(p, first, here, dF);
    if (finest >= same_size * first || (quotient && is_straight(*quotient, at))) return;
    search_.begin(dF);
    for (double h = first; h > finest;) {
      h *= step_ratio;
      const double step = (p + h) - p;
      if (step == 0) break;
      difference(p, step, here, dF_);
      if (!dF_.allFinite() || !search_.add(dF_)) break;
    }
    dF = search_.best();
  }

  // Whether the bend b = h F_pp/2F_p between the two sides of a difference, which are nearby_, promises an
  // error of 1e-8. The error h^2 F_ppp/6F_p is 2 b^2/3 if F bends over one length, as an exponential does,
  // and b h/3|p| if it is odd in p. At p = 0 such an F has no bend.
  bool is_straight(const DifferenceQuotient& quotient, double p) const {
    if (!quotient.central() || p == 0) return false;
    const double largest_bend = std::min(1e-4, 3e-8 * p / quotient.distance[0]);
    for (Eigen::Index i = 0; i < F_.size(); ++i)
      if (!(std::abs((nearby_[0][i] - F_[i]) + (nearby_[1][i] - F_[i])) <=
            largest_bend * std::abs(nearby_[0][i] - nearby_[1][i])))
        return false;
    return true;
  }

  // dF/dx by a difference of step h or shorter, x an entry of u_ or p_: of the piece `here` of F, if any, and
  // within the domain. Where choices are kept F is smooth across the ends of its piece. A piece without room,
  // as a number of its own for the corner itself, has the derivative of what is around it.
  std::optional<DifferenceQuotient> difference(double& x, double h, std::optional<std::uint64_t> here,
                                               Out dF) const {
    const double at = x;
    std::exception_ptr thrown;
    bool within = here.has_value();
    const auto go = [&](std::size_t i, double distance) {
      bool usable = false;
      x = at + distance;
      choices_.keep();
      try {
        if (!within || f_->piece(u_, p_) == *here) {
          residual_at_point(nearby_[i]);
          usable = nearby_[i].allFinite();
        }
      } catch (...) {
        thrown = std::current_exception();
      }
      x = at;
      return usable;
    };
    auto quotient = difference_within_piece(h, go, AtEnd::one_sided);
    if (!quotient && std::exchange(within, false))
      quotient = difference_within_piece(h, go, AtEnd::one_sided);
    if (!quotient) {
      if (thrown) std::rethrow_exception(thrown);
      dF.setConstant(std::numeric_limits<double>::quiet_NaN());
    } else if (quotient->central()) {
      dF = (nearby_[0] - nearby_[1]) / (2 * quotient->distance[0]);
    } else {
      dF = quotient->weight[0] * (nearby_[0] - F_) + quotient->weight[1] * (nearby_[1] - F_);
    }
    return quotient;
  }

  std::shared_ptr<const Functions> f_;
  std::shared_ptr<Vector> state_;  // none: null
  std::shared_ptr<const StateFunctions> of_;
  Parameters parameters_;
  mutable Vector u_, p_;
  Vector u_of_J_, p_of_J_;  // the point of the operator, fixed while residuals are evaluated elsewhere
  Vector F_;
  mutable std::array<Vector, 2> nearby_;
  mutable Vector dF_;
  mutable Choices choices_;
  mutable StepSearch search_;
  Jacobian J_;
};

class FunctionProblem : public Problem {
 public:
  FunctionProblem(std::shared_ptr<const Functions> f, Parameters parameters)
      : f_(std::move(f)), parameters_(std::move(parameters)) {}
  int size() const override { return f_->size; }
  std::span<const Parameter> parameters() const override { return *parameters_; }
  Vector scales() const override { return f_->scales; }
  std::unique_ptr<Evaluator> evaluator() const override {
    return std::make_unique<FunctionEvaluator>(f_, parameters_);
  }
  bool smooth() const override { return !f_->piece && !f_->choosing.residual; }
  std::shared_ptr<const Problem> with_scale(int k, double scale) const override {
    return std::make_shared<const FunctionProblem>(f_, scaled(k, scale));
  }
  std::unique_ptr<LinearSolver> linear_solver() const override {
    return f_->linear_solver ? f_->linear_solver() : nullptr;
  }

 protected:
  Parameters scaled(int k, double scale) const {
    auto parameters = std::make_shared<std::vector<Parameter>>(*parameters_);
    (*parameters)[static_cast<std::size_t>(k)].scale = scale;
    return parameters;
  }

  std::shared_ptr<const Functions> f_;
  Parameters parameters_;
};

// Throws unless there is one residual, and at most one Jacobian.
void check_functions(const Functions& f) {
  const ChoosingFunctions& choosing = f.choosing;
  if (!f.residual && !choosing.residual) throw std::invalid_argument("a problem needs a residual function");
  if (f.residual && choosing.residual)
    throw std::invalid_argument("a problem has one residual function: with choices or without");
  if (f.piece && choosing.residual)
    throw std::invalid_argument("a residual with choices has its pieces by them: no `piece` besides");
  if (!choosing.residual && (choosing.jacobian || choosing.sparse_jacobian || choosing.derivative))
    throw std::invalid_argument("derivatives with choices require a residual that makes them");
  if (!!f.jacobian + !!f.sparse_jacobian + !!f.apply_jacobian + !!choosing.jacobian +
          !!choosing.sparse_jacobian >
      1)
    throw std::invalid_argument("a problem has at most one Jacobian: dense, sparse or matrix-free");
  if (f.derivative && choosing.derivative)
    throw std::invalid_argument("a problem has at most one dF/dp: with choices or without");
  if (f.apply_transposed_jacobian && !f.apply_jacobian)
    throw std::invalid_argument("apply_transposed_jacobian requires apply_jacobian");
}

// Complete with the defaults, or throws.
std::shared_ptr<const Functions> checked(Functions f) {
  if (f.size < 1)
    throw std::invalid_argument("a problem has at least 1 unknown, not " + std::to_string(f.size));
  check_functions(f);
  if (f.scales.size() == 0) f.scales = Vector::Ones(f.size);
  if (f.scales.size() != f.size)
    throw std::invalid_argument(std::to_string(f.scales.size()) + " scales for " + std::to_string(f.size) +
                                " unknowns");
  if (!(f.scales.minCoeff() > 0) || !f.scales.allFinite())
    throw std::invalid_argument("scales must be positive and finite");
  check_parameters(f.parameters);
  return std::make_shared<const Functions>(std::move(f));
}

Parameters parameters_of(const Functions& f) {
  return std::make_shared<const std::vector<Parameter>>(f.parameters);
}

std::shared_ptr<const Functions> in_state(const StateFunctions& of, std::shared_ptr<const Vector> state) {
  return checked(of.functions(AcceptedState(std::move(state))));
}

// Each evaluator has functions of its own, which see the state that it is in.
class StateProblem final : public FunctionProblem {
 public:
  StateProblem(std::shared_ptr<const StateFunctions> of, std::shared_ptr<const Functions> f,
               Parameters parameters)
      : FunctionProblem(std::move(f), std::move(parameters)), of_(std::move(of)) {}
  std::unique_ptr<Evaluator> evaluator() const override {
    const auto state = std::make_shared<Vector>(of_->initial);
    return std::make_unique<FunctionEvaluator>(in_state(*of_, state), parameters_, state, of_);
  }
  Vector initial_state() const override { return of_->initial; }
  std::shared_ptr<const Problem> with_scale(int k, double scale) const override {
    return std::make_shared<const StateProblem>(of_, f_, scaled(k, scale));
  }

 private:
  std::shared_ptr<const StateFunctions> of_;
};

}  // namespace

std::shared_ptr<const Problem> from_functions(Functions functions) {
  auto f = checked(std::move(functions));
  auto parameters = parameters_of(*f);
  return std::make_shared<const FunctionProblem>(std::move(f), std::move(parameters));
}

std::shared_ptr<const Problem> from_functions(StateFunctions of) {
  if (of.initial.size() == 0 || !of.initial.allFinite())
    throw std::invalid_argument("a problem with a state needs an initial one, of finite numbers");
  if (!of.functions || !of.next)
    throw std::invalid_argument("a problem with a state needs its functions, and the next state");
  auto f = in_state(of, std::make_shared<const Vector>(of.initial));
  auto parameters = parameters_of(*f);
  return std::make_shared<const StateProblem>(std::make_shared<const StateFunctions>(std::move(of)),
                                              std::move(f), std::move(parameters));
}

std::shared_ptr<const Problem> from_functions(int size, std::vector<Parameter> parameters,
                                              ResidualFunction residual, JacobianFunction jacobian,
                                              ParameterFunction derivative, Vector scales) {
  Functions f;
  f.size = size;
  f.parameters = std::move(parameters);
  f.residual = std::move(residual);
  f.jacobian = std::move(jacobian);
  f.derivative = std::move(derivative);
  f.scales = std::move(scales);
  return from_functions(std::move(f));
}

}  // namespace arcslip::continuation
