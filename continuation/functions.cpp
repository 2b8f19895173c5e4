#include <arcslip/continuation/functions.hpp>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace arcslip::continuation {
namespace {

struct Functions {
  int size;
  std::vector<Parameter> parameters;
  ResidualFunction residual;
  JacobianFunction jacobian;
  ParameterFunction derivative;
  Vector scales;
};

double difference_step(double x, double scale) {
  return std::cbrt(2.2e-16) * std::max(std::abs(x), scale);
}

class FunctionEvaluator final : public Evaluator {
 public:
  explicit FunctionEvaluator(std::shared_ptr<const Functions> f)
      : f_(std::move(f)),
        u_(f_->size),
        p_(f_->parameters.size()),
        F_(f_->size),
        plus_(f_->size),
        minus_(f_->size),
        J_(f_->size, f_->size) {}

  Evaluated move_to(In u, In p, Needs needs) override {
    u_ = u;
    p_ = p;
    f_->residual(u_, p_, F_);
    if (!F_.allFinite()) return Evaluated::outside_domain;
    if (needs == Needs::residual) return Evaluated::ok;
    if (f_->jacobian) {
      f_->jacobian(u_, p_, J_);
    } else {
      for (Eigen::Index i = 0; i < u_.size(); ++i) difference(u_[i], f_->scales[i], J_.col(i));
    }
    return J_.allFinite() ? Evaluated::ok : Evaluated::outside_domain;
  }

  const Vector& residual() const override { return F_; }
  const Jacobian& jacobian() const override { return J_; }

  void parameter_derivative(int k, Out dF) const override {
    if (f_->derivative)
      f_->derivative(u_, p_, k, dF);
    else
      difference(p_[k], f_->parameters[static_cast<std::size_t>(k)].scale, dF);
  }

 private:
  // d F / d x by central differences, where x is one of the entries of u_ or p_.
  void difference(double& x, double scale, Out dF) const {
    const double at = x, h = difference_step(at, scale);
    x = at + h;
    f_->residual(u_, p_, plus_);
    x = at - h;
    f_->residual(u_, p_, minus_);
    x = at;
    dF = (plus_ - minus_) / (2 * h);
  }

  std::shared_ptr<const Functions> f_;
  mutable Vector u_, p_;
  Vector F_;
  mutable Vector plus_, minus_;
  Jacobian J_;
};

class FunctionProblem final : public Problem {
 public:
  explicit FunctionProblem(Functions f) : f_(std::make_shared<const Functions>(std::move(f))) {}
  int size() const override { return f_->size; }
  std::span<const Parameter> parameters() const override { return f_->parameters; }
  Vector scales() const override { return f_->scales; }
  std::unique_ptr<Evaluator> evaluator() const override { return std::make_unique<FunctionEvaluator>(f_); }

 private:
  std::shared_ptr<const Functions> f_;
};

}  // namespace

std::shared_ptr<const Problem> from_functions(int size, std::vector<Parameter> parameters,
                                              ResidualFunction residual, JacobianFunction jacobian,
                                              ParameterFunction derivative, Vector scales) {
  if (size < 1) throw std::invalid_argument("a problem has at least 1 unknown, not " + std::to_string(size));
  if (!residual) throw std::invalid_argument("a problem needs a residual function");
  if (scales.size() == 0) scales = Vector::Ones(size);
  if (scales.size() != size)
    throw std::invalid_argument(std::to_string(scales.size()) + " scales for " + std::to_string(size) +
                                " unknowns");
  return std::make_shared<FunctionProblem>(Functions{size, std::move(parameters), std::move(residual),
                                                     std::move(jacobian), std::move(derivative),
                                                     std::move(scales)});
}

}  // namespace arcslip::continuation
